#include "arc_seeds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace omr
{
namespace
{
constexpr int MIN_AREA = 20;  // of a piece [px]
constexpr int MIN_SIDE = 8;   // of its box [px]
constexpr int MAX_SIDE = 600;
constexpr double MAX_ASPECT = 3.2;
constexpr int MAX_TILES = 8;     // along a side of the piece, whose edgels vote
constexpr int MAX_EDGELS = 128;  // that vote
constexpr int MIN_EDGELS = 20;
constexpr int MIN_DRAWS = 20;
constexpr int MAX_DRAWS = 160;
constexpr double MAX_SINE = .1;      // between gradient and radius: an inlier
constexpr double MIN_SCORE = .22;    // of the edgels, weighted by the root of the share of directions they cover
constexpr double MAX_STRAIGHT = .8;  // share of the edgels in two directions: the piece has straight edges
constexpr int DIRECTIONS = 24;       // of the histogram over half a turn

using Row = cv::Vec<double, 5>;

/**
 * A family's circles are the level sets of (p - c)^T S (p - c), so the gradient n at p is parallel to S p - d with
 * d = S c: one linear equation in (s11, s12, s22, d1, d2).
 */
Row equation(const Edgel& edgel, const cv::Point2d& origin, double scale)
{
  const double x = (edgel.x - origin.x) / scale;
  const double y = (edgel.y - origin.y) / scale;
  return {-edgel.ny * x, edgel.nx * x - edgel.ny * y, edgel.nx * y, edgel.ny, -edgel.nx};
}

bool toFamily(Row solution, const cv::Point2d& origin, double scale, RingFamily& family)
{
  if (solution[0] < 0)
  {
    solution *= -1;
  }
  const double s11 = solution[0];
  const double s12 = solution[1];
  const double s22 = solution[2];
  const double det = s11 * s22 - s12 * s12;
  if (!(det > 1e-12))
  {
    return false;
  }
  const cv::Point2d center((s22 * solution[3] - s12 * solution[4]) / det,
                           (s11 * solution[4] - s12 * solution[3]) / det);
  return familyFromMoments(origin + scale * center, s22 / det, -s12 / det, s11 / det, family) &&
         family.aspect() < MAX_ASPECT;
}

/** The vector that four equations leave free. */
bool nullVector(std::array<Row, 4>& rows, Row& solution)
{
  std::array<int, 4> pivots{};
  std::array<bool, 5> used{};
  for (int i = 0; i < 4; ++i)
  {
    int best_row = -1;
    int best_col = -1;
    double largest = 1e-9;
    for (int row = i; row < 4; ++row)
    {
      for (int col = 0; col < 5; ++col)
      {
        if (!used[col] && std::abs(rows[row][col]) > largest)
        {
          largest = std::abs(rows[row][col]);
          best_row = row;
          best_col = col;
        }
      }
    }
    if (best_row < 0)
    {
      return false;
    }
    std::swap(rows[i], rows[best_row]);
    used[best_col] = true;
    pivots[i] = best_col;
    rows[i] *= 1 / rows[i][best_col];
    for (int row = 0; row < 4; ++row)
    {
      if (row != i)
      {
        rows[row] -= rows[row][best_col] * rows[i];
      }
    }
  }
  const int free = static_cast<int>(std::find(used.begin(), used.end(), false) - used.begin());
  solution[free] = 1;
  for (int i = 0; i < 4; ++i)
  {
    solution[pivots[i]] = -rows[i][free];
  }
  return true;
}

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

/** Sine of the angle between an edgel's gradient and the family's radius; direction receives the radius' sector. */
double sineToRadius(const RingFamily& family, const Edgel& edgel, int& sector)
{
  const double x = edgel.x - family.center.x;
  const double y = edgel.y - family.center.y;
  const double qx = family.d * x - family.b * y;
  const double qy = family.a * y - family.b * x;
  const double gx = family.d * qx - family.b * qy;
  const double gy = family.a * qy - family.b * qx;
  sector = (qx > 0 ? 1 : 0) + (qy > 0 ? 2 : 0) + (std::abs(qx) > std::abs(qy) ? 4 : 0);
  const double minor = std::min(std::abs(qx), std::abs(qy));
  sector += minor > .414 * std::max(std::abs(qx), std::abs(qy)) ? 8 : 0;
  return std::abs(edgel.nx * gy - edgel.ny * gx) / std::max(1e-9, std::sqrt(gx * gx + gy * gy));
}

/** Votes for a family: inliers, weighted by the root of the share of directions that they cover. */
struct Votes
{
  int inliers = 0;
  unsigned sectors = 0;

  void add(const RingFamily& family, const Edgel& edgel)
  {
    int sector = 0;
    if (sineToRadius(family, edgel, sector) < MAX_SINE)
    {
      ++inliers;
      sectors |= 1U << sector;
    }
  }

  double score() const
  {
    return inliers * std::sqrt(__builtin_popcount(sectors) / 16.);
  }
};

Votes countVotes(const RingFamily& family, const std::vector<Edgel>& edgels, const Votes& best)
{
  Votes votes;
  const std::size_t preview = edgels.size() / 4;
  for (std::size_t i = 0; i < edgels.size(); ++i)
  {
    // A family that does far worse on the first quarter will not win.
    if (i == preview && votes.inliers < best.inliers / 8)
    {
      return {};
    }
    votes.add(family, edgels[i]);
  }
  return votes;
}

/** Weighted least squares over the edgels that fit already. */
bool refineFamilyShape(const std::vector<Edgel>& edgels, const cv::Point2d& origin, double scale, RingFamily& family)
{
  cv::Matx<double, 5, 5> normal = cv::Matx<double, 5, 5>::zeros();
  for (const Edgel& edgel : edgels)
  {
    int sector = 0;
    const double t = sineToRadius(family, edgel, sector) / MAX_SINE;
    if (t < 1)
    {
      const Row row = equation(edgel, origin, scale);
      normal += (1 - t * t) * (1 - t * t) * (row * row.t());
    }
  }
  cv::Mat values;
  cv::Mat vectors;
  cv::eigen(normal, values, vectors);
  Row solution;
  for (int i = 0; i < 5; ++i)
  {
    solution[i] = vectors.at<double>(4, i);
  }
  return toFamily(solution, origin, scale, family);
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
  const double side = std::max(piece.box.width, piece.box.height);
  const double margin = std::max(4., .25 * side);
  std::vector<Edgel> edgels;
  map.visit(
      piece.box.x - margin, piece.box.y - margin, piece.box.x + piece.box.width - 1 + margin,
      piece.box.y + piece.box.height - 1 + margin, [&](const Edgel& edgel) { edgels.push_back(edgel); }, MAX_TILES);
  if (edgels.size() < MIN_EDGELS || isStraight(edgels))
  {
    return false;
  }
  Random random;
  std::vector<Edgel> voters = edgels;
  if (voters.size() > MAX_EDGELS)
  {
    for (std::size_t i = 0; i < MAX_EDGELS; ++i)
    {
      std::swap(voters[i], voters[i + random.below(voters.size() - i)]);
    }
    voters.resize(MAX_EDGELS);
  }
  const cv::Point2d origin(piece.box.x + (piece.box.width - 1) / 2., piece.box.y + (piece.box.height - 1) / 2.);
  const double scale = side / 2 + 1;
  const double farthest = side * 2.5 + 10;
  Votes best;
  int draws = MAX_DRAWS;
  for (int draw = 0; draw < draws; ++draw)
  {
    std::array<Row, 4> rows;
    for (Row& row : rows)
    {
      row = equation(voters[random.below(voters.size())], origin, scale);
    }
    Row solution;
    RingFamily family;
    if (nullVector(rows, solution) && toFamily(solution, origin, scale, family) &&
        cv::norm(family.center - origin) < farthest)
    {
      const Votes support = countVotes(family, voters, best);
      if (support.score() > best.score())
      {
        best = support;
        seed.family = family;
        // Enough to have drawn four inliers once with a probability of 95 %.
        const double share = support.inliers / static_cast<double>(voters.size());
        const double needed = std::log(.05) / std::log(1 - std::min(.99, share * share * share * share));
        draws = static_cast<int>(std::clamp<double>(needed, MIN_DRAWS, MAX_DRAWS));
      }
    }
  }
  votes = best.score() / static_cast<double>(voters.size());
  if (votes < MIN_SCORE)
  {
    return false;
  }
  for (int round = 0; round < 2; ++round)
  {
    RingFamily refined = seed.family;
    if (!refineFamilyShape(edgels, origin, scale, refined) || cv::norm(refined.center - origin) > 1.2 * farthest)
    {
      break;
    }
    seed.family = refined;
  }
  seed.radius = 0;
  for (const cv::Point2d& corner : {cv::Point2d(piece.box.tl()), cv::Point2d(piece.box.br()),
                                    cv::Point2d(piece.box.x, piece.box.y + piece.box.height),
                                    cv::Point2d(piece.box.x + piece.box.width, piece.box.y)})
  {
    seed.radius = std::max(seed.radius, cv::norm(seed.family.toPlane(corner)));
  }
  return true;
}

}  // namespace omr
