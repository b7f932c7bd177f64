#include "arc_seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "edgel_family.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int MIN_AREA = 20;  // of a piece [px]
constexpr int MIN_SIDE = 8;   // of its box [px]
constexpr int MAX_SIDE = 80;
constexpr int MAX_EDGELS = 128;  // that vote
constexpr int MIN_EDGELS = 20;
constexpr int MIN_DRAWS = 20;
constexpr int MAX_DRAWS = 160;
constexpr double MIN_SCORE = .22;    // of the edgels, weighted by the root of the share of directions they cover
constexpr double MAX_STRAIGHT = .8;  // share of the edgels in two directions: the piece has straight edges
constexpr int DIRECTIONS = 24;       // of the histogram over half a turn

/** Small deterministic generator (xorshift): the same image gives the same targets. */
class Random
{
 public:
  std::size_t below(std::size_t limit)
  {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_ % limit;
  }

 private:
  std::uint32_t state_ = 12345;
};

/** Whether two directions hold most of the edgels, as in squares, bars and letters. */
bool isStraight(const std::vector<Edgel>& edgels)
{
  std::array<int, DIRECTIONS> histogram{};
  for (const Edgel& edgel : edgels)
  {
    const float angle = cv::fastAtan2(edgel.ny, edgel.nx);
    ++histogram[static_cast<std::size_t>(angle * (2 * DIRECTIONS / 360.F)) % DIRECTIONS];
  }
  int held = 0;
  for (int round = 0; round < 2; ++round)
  {
    int best = -1;
    int best_sum = -1;
    for (int i = 0; i < DIRECTIONS; ++i)
    {
      const int sum = histogram[i] + histogram[(i + 1) % DIRECTIONS] + histogram[(i + DIRECTIONS - 1) % DIRECTIONS];
      best = sum > best_sum ? i : best;
      best_sum = std::max(best_sum, sum);
    }
    held += best_sum;
    for (const int i : {best, (best + 1) % DIRECTIONS, (best + DIRECTIONS - 1) % DIRECTIONS})
    {
      histogram[i] = 0;
    }
  }
  return held > MAX_STRAIGHT * static_cast<double>(edgels.size());
}

/** Edgels that vote, each of their values side by side. */
struct Voters
{
  explicit Voters(const std::vector<Edgel>& edgels) : size(edgels.size())
  {
    for (std::size_t i = 0; i < size; ++i)
    {
      x[i] = edgels[i].x;
      y[i] = edgels[i].y;
      nx[i] = edgels[i].nx;
      ny[i] = edgels[i].ny;
    }
  }

  std::size_t size;
  std::array<double, MAX_EDGELS> x, y, nx, ny;
};

/** Votes for a family: inliers, weighted by the root of the share of directions that they cover. */
struct Votes
{
  std::int64_t inliers = 0;
  std::int64_t sectors = 0;

  double score() const
  {
    return static_cast<double>(inliers) * std::sqrt(__builtin_popcount(static_cast<unsigned>(sectors)) / 16.);
  }
};

/** Adds the votes of the voters [from, to): of those whose gradient runs along the family's radius. */
OMR_VECTORIZED void addVotes(const RingFamily& family, const Voters& voters, std::size_t from, std::size_t to,
                             Votes& votes)
{
  const cv::Point2d center = family.center;
  const double a = family.a;
  const double b = family.b;
  const double d = family.d;
  std::int64_t inliers = 0;
  std::int64_t sectors = 0;
  for (std::size_t i = from; i < to; ++i)
  {
    const double x = voters.x[i] - center.x;
    const double y = voters.y[i] - center.y;
    const double qx = d * x - b * y;
    const double qy = a * y - b * x;
    const double gx = d * qx - b * qy;
    const double gy = a * qy - b * qx;
    const double ax = std::abs(qx);
    const double ay = std::abs(qy);
    // One of sixteen directions.
    const bool is_diagonal = (ax < ay ? ax : ay) > .414 * (ax < ay ? ay : ax);
    const std::int64_t sector = (qx > 0 ? 1 : 0) + (qy > 0 ? 2 : 0) + (ax > ay ? 4 : 0) + (is_diagonal ? 8 : 0);
    const double across = voters.nx[i] * gy - voters.ny[i] * gx;
    const std::int64_t is_inlier = across * across < MAX_SINE * MAX_SINE * (gx * gx + gy * gy) ? 1 : 0;
    inliers += is_inlier;
    sectors |= is_inlier << sector;
  }
  votes.inliers += inliers;
  votes.sectors |= sectors;
}

Votes countVotes(const RingFamily& family, const Voters& voters, const Votes& best)
{
  Votes votes;
  const std::size_t preview = voters.size / 4;
  addVotes(family, voters, 0, preview, votes);
  // A family that does far worse on the first quarter will not win.
  if (votes.inliers < best.inliers / 8)
  {
    return {};
  }
  addVotes(family, voters, preview, voters.size, votes);
  return votes;
}

/** A piece's surroundings as the search for a family sees them. */
struct Surroundings
{
  explicit Surroundings(const Region& piece)
      : side(std::max(piece.box.width, piece.box.height)),
        origin(piece.box.x + (piece.box.width - 1) / 2., piece.box.y + (piece.box.height - 1) / 2.),
        farthest(side * 2.5 + 10)
  {
  }

  double side;         // of the piece's box [px]
  cv::Point2d origin;  // its middle
  double farthest;     // distance of a family's centre from there [px]
};

std::vector<Edgel> edgelsAround(EdgelMap& map, const cv::Rect& box, double side)
{
  const double margin = std::max(4., .25 * side);
  std::vector<Edgel> edgels;
  map.visit(box.x - margin, box.y - margin, box.x + box.width - 1 + margin, box.y + box.height - 1 + margin,
            [&](const Edgel& edgel) { edgels.push_back(edgel); });
  return edgels;
}

/** MAX_EDGELS of them at most, drawn by chance. */
std::vector<Edgel> drawVoters(std::vector<Edgel> edgels, Random& random)
{
  if (edgels.size() > MAX_EDGELS)
  {
    for (std::size_t i = 0; i < MAX_EDGELS; ++i)
    {
      std::swap(edgels[i], edgels[i + random.below(edgels.size() - i)]);
    }
    edgels.resize(MAX_EDGELS);
  }
  return edgels;
}

/** Draws four edgels again and again, and keeps the family that most vote for; returns their score. */
double drawFamily(const std::vector<Edgel>& voters, const Surroundings& around, Random& random, RingFamily& best_family)
{
  const Voters side_by_side(voters);
  Votes best;
  int draws = MAX_DRAWS;
  for (int draw = 0; draw < draws; ++draw)
  {
    std::array<Edgel, 4> drawn;
    for (Edgel& edgel : drawn)
    {
      edgel = voters[random.below(voters.size())];
    }
    RingFamily family;
    if (!familyOf(drawn, around.origin, around.side / 2 + 1, family) ||
        cv::norm(family.center - around.origin) >= around.farthest)
    {
      continue;
    }
    const Votes votes = countVotes(family, side_by_side, best);
    if (votes.score() > best.score())
    {
      best = votes;
      best_family = family;
      // Enough to have drawn four inliers once with a probability of 95 %.
      const double share = static_cast<double>(votes.inliers) / static_cast<double>(voters.size());
      const double needed = std::log(.05) / std::log(1 - std::min(.99, share * share * share * share));
      draws = static_cast<int>(std::clamp<double>(needed, MIN_DRAWS, MAX_DRAWS));
    }
  }
  return best.score();
}

void refineFamily(const std::vector<Edgel>& edgels, const Surroundings& around, RingFamily& family)
{
  for (int round = 0; round < 2; ++round)
  {
    RingFamily refined = family;
    if (!refineFamilyShape(edgels, around.origin, around.side / 2 + 1, refined) ||
        cv::norm(refined.center - around.origin) > 1.2 * around.farthest)
    {
      return;
    }
    family = refined;
  }
}

/** Radius, in the family's plane, of the circle around a box. */
double radiusAround(const cv::Rect& box, const RingFamily& family)
{
  double radius = 0;
  for (const cv::Point& corner : {box.tl(), box.br(), cv::Point(box.x, box.br().y), cv::Point(box.br().x, box.y)})
  {
    radius = std::max(radius, cv::norm(family.toPlane(cv::Point2d(corner))));
  }
  return radius;
}
}  // namespace

std::vector<const Region*> findPieces(const std::vector<Region>& regions)
{
  std::vector<const Region*> pieces;
  for (const Region& region : regions)
  {
    const int side = std::max(region.box.width, region.box.height);
    if (region.area >= MIN_AREA && side >= MIN_SIDE && side <= MAX_SIDE && !isParallelogram(region))
    {
      pieces.push_back(&region);
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Region* left, const Region* right) { return left->area > right->area; });
  return pieces;
}

bool findArcSeed(EdgelMap& map, const Region& piece, RingSeed& seed, double& votes)
{
  const Surroundings around(piece);
  const std::vector<Edgel> edgels = edgelsAround(map, piece.box, around.side);
  if (edgels.size() < MIN_EDGELS || isStraight(edgels))
  {
    return false;
  }
  Random random;
  const std::vector<Edgel> voters = drawVoters(edgels, random);
  votes = drawFamily(voters, around, random, seed.family) / static_cast<double>(voters.size());
  if (votes < MIN_SCORE)
  {
    return false;
  }
  refineFamily(edgels, around, seed.family);
  seed.radius = radiusAround(piece.box, seed.family);
  return true;
}

}  // namespace omr
