#include "saddle_groups.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grey_samples.h"
#include "point_grid.h"
#include "saddle_points.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int MAX_POINTS = 5000;  // the strongest; three boards of the largest size have 1200
constexpr int MAX_FAINT_POINTS = 2000;
static_assert(MAX_POINTS <= PointGrid::MAX_POINTS);
constexpr int PARTS = 8;        // of the points, shared by the threads; the seeds do not depend on how many there are
constexpr float CLEAR_GAP = 5;  // grey levels between light and dark squares
constexpr float FAINT_GAP = 3;

/** Grey levels by which the seven squares around the corner alternate, or 0 if by less than the least gap. */
float alternation(const cv::Mat& grey, const LocalFrame& frame, float least_gap)
{
  struct Square
  {
    float u, v;
    bool is_like_first;
  };
  constexpr std::array<Square, 5> OTHERS = {
      {{-0.5F, -0.5F, true}, {0.5F, -0.5F, false}, {1.5F, 0.5F, false}, {0.5F, 1.5F, false}, {1.5F, 1.5F, true}}};
  const auto sample = [&](float u, float v) {
    const cv::Point2f point = frame.at(u, v);
    return sampleGrey(grey, point.x, point.y);
  };
  const float first = sample(0.5F, 0.5F);
  const float second = sample(-0.5F, 0.5F);
  const float sign = first > second ? 1 : -1;
  float light = sign * first;  // the darkest of the light squares, as seen with that sign
  float dark = sign * second;
  // In texture the first two squares tell already.
  for (auto square = OTHERS.begin(); light - dark >= least_gap; ++square)
  {
    if (square == OTHERS.end())
    {
      return light - dark;
    }
    const float value = sign * sample(square->u, square->v);
    light = square->is_like_first ? std::min(light, value) : light;
    dark = square->is_like_first ? dark : std::max(dark, value);
  }
  return 0;
}

/** Pairs of steps from one point. */
struct Steps
{
  static constexpr std::size_t SIZE = 8;

  std::array<float, SIZE> ux, uy, vx, vy;
};

/** Which of the pairs' four squares around the point alternate: alternation() of their frames may be more than 0. */
OMR_VECTORIZED void judgeSquares(const cv::Mat& grey, const cv::Point2f& center, const Steps& steps, float least_gap,
                                 std::array<int, Steps::SIZE>& alternate)
{
  constexpr std::size_t SIZE = Steps::SIZE;
  SamplePlaces<4 * SIZE> places;  // by squares
  const float x = center.x;
  const float y = center.y;
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    const float ux = .5F * steps.ux[i];
    const float uy = .5F * steps.uy[i];
    const float vx = .5F * steps.vx[i];
    const float vy = .5F * steps.vy[i];
    places.x[i] = x + ux + vx;
    places.y[i] = y + uy + vy;
    places.x[SIZE + i] = x - ux + vx;
    places.y[SIZE + i] = y - uy + vy;
    places.x[2 * SIZE + i] = x - ux - vx;
    places.y[2 * SIZE + i] = y - uy - vy;
    places.x[3 * SIZE + i] = x + ux - vx;
    places.y[3 * SIZE + i] = y + uy - vy;
  }
  std::array<float, 4 * SIZE> values;
  sampleGreys(grey, places, values);
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    const float sign = values[i] > values[SIZE + i] ? 1 : -1;
    const float light = std::min(sign * values[i], sign * values[2 * SIZE + i]);
    const float dark = std::max(sign * values[SIZE + i], sign * values[3 * SIZE + i]);
    alternate[i] = light - dark >= least_gap ? 1 : 0;
  }
}

/** Looks for the first frame in which the squares alternate, eight at a time: most are in texture, where none is. */
class FrameSearch
{
 public:
  FrameSearch(const cv::Mat& grey, const cv::Point2f& center, float least_gap)
      : grey_(grey), center_(center), least_gap_(least_gap)
  {
  }

  /** @param is_frame whether these steps are one; else nothing is added. @return whether a frame was found. */
  bool add(const cv::Point2f& u, const cv::Point2f& v, bool is_frame, Seed& seed)
  {
    steps_.ux[count_] = u.x;
    steps_.uy[count_] = u.y;
    steps_.vx[count_] = v.x;
    steps_.vy[count_] = v.y;
    count_ += is_frame ? 1 : 0;  // without a branch: it could not be foreseen
    return count_ == Steps::SIZE && judge(seed);
  }

  /** Looks at those added since the last look. */
  bool judge(Seed& seed)
  {
    std::array<int, Steps::SIZE> alternate;
    judgeSquares(grey_, center_, steps_, least_gap_, alternate);
    const std::size_t count = count_;
    count_ = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const LocalFrame frame{center_, {steps_.ux[i], steps_.uy[i]}, {steps_.vx[i], steps_.vy[i]}};
      const float gap = alternate[i] != 0 ? alternation(grey_, frame, least_gap_) : 0;
      if (gap >= least_gap_)
      {
        seed = {frame, true, static_cast<int>(gap)};
        return true;
      }
    }
    return false;
  }

 private:
  const cv::Mat& grey_;
  cv::Point2f center_;
  float least_gap_;
  Steps steps_{};
  std::size_t count_ = 0;
};

/** The first frame, nearest neighbours first, in which the squares alternate. */
bool frameFromNeighbours(const cv::Mat& grey, const cv::Point& center,
                         const std::vector<PointGrid::Neighbour>& neighbours, float least_gap, Seed& seed)
{
  constexpr float MIN_SINE = 0.4F;
  constexpr float MAX_STEP_RATIO = 2.5F;
  FrameSearch search(grey, center, least_gap);
  std::array<float, PointGrid::MAX_NEIGHBOURS> distances;
  std::transform(neighbours.begin(), neighbours.end(), distances.begin(),
                 [](const auto& neighbour) { return std::sqrt(static_cast<float>(neighbour.squared)); });
  for (std::size_t a = 0; a < neighbours.size(); ++a)
  {
    for (std::size_t b = a + 1; b < neighbours.size() && distances[b] <= MAX_STEP_RATIO * distances[a]; ++b)
    {
      const std::array<cv::Point2f, 2> steps = {neighbours[a].offset, neighbours[b].offset};
      const float area = cross(steps[0], steps[1]);
      const std::size_t first = area < 0 ? 1 : 0;  // an index: a branch on the side could not be foreseen
      if (search.add(steps[first], steps[1 - first], std::abs(area) >= MIN_SINE * distances[a] * distances[b], seed))
      {
        return true;
      }
    }
  }
  return search.judge(seed);
}
}  // namespace

std::vector<Seed> groupSaddlePoints(const Frame& frame, int level, bool faint, const SearchMap& open)
{
  const cv::Mat& grey = frame.grey[level];
  const auto scale = static_cast<float>(1 << level);
  const std::vector<cv::Point> points = findSaddlePoints(grey, faint, faint ? MAX_FAINT_POINTS : MAX_POINTS);
  const PointGrid grid(points, grey.size());
  std::array<std::vector<Seed>, PARTS> parts;
  const auto count = static_cast<int>(points.size());
  cv::parallel_for_(cv::Range(0, PARTS), [&](const cv::Range& range) {
    std::vector<PointGrid::Neighbour> neighbours;
    for (int part = range.start; part < range.end; ++part)
    {
      for (int i = count * part / PARTS; i < count * (part + 1) / PARTS; ++i)
      {
        if (!open.isOpen(scale * cv::Point2f(points[i])))
        {
          continue;
        }
        grid.neighbours(points[i], neighbours);
        Seed seed;
        if (frameFromNeighbours(grey, points[i], neighbours, faint ? FAINT_GAP : CLEAR_GAP, seed))
        {
          seed.frame.node *= scale;
          seed.frame.u *= scale;
          seed.frame.v *= scale;
          parts[part].push_back(seed);
        }
      }
    }
  });
  std::vector<Seed> seeds;
  for (const std::vector<Seed>& part : parts)
  {
    seeds.insert(seeds.end(), part.begin(), part.end());
  }
  std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.rank > b.rank; });
  return seeds;
}

}  // namespace omr
