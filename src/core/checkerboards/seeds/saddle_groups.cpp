#include "saddle_groups.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "checkerboards/corners/grey_samples.h"
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

/** Pairs of steps from one point. */
struct Steps
{
  static constexpr std::size_t SIZE = 8;

  std::array<float, SIZE> ux, uy, vx, vy;
};

/** Where a square beside the point has its middle, in steps, and whether it is as light as the first one. */
struct Square
{
  float u, v;
  bool is_like_first;
};
constexpr std::array<Square, 7> SQUARES = {{{0.5F, 0.5F, true},
                                            {-0.5F, 0.5F, false},
                                            {-0.5F, -0.5F, true},
                                            {0.5F, -0.5F, false},
                                            {1.5F, 0.5F, false},
                                            {0.5F, 1.5F, false},
                                            {1.5F, 1.5F, true}}};

/** Grey levels by which the seven squares around the point alternate, for each of the pairs. */
OMR_VECTORIZED void measureGaps(const cv::Mat& grey, const cv::Point2f& center, const Steps& steps,
                                std::array<float, Steps::SIZE>& gaps)
{
  constexpr std::size_t SIZE = Steps::SIZE;
  SamplePlaces<SQUARES.size() * SIZE> places;  // by squares
  const float x = center.x;
  const float y = center.y;
  for (std::size_t k = 0; k < SQUARES.size(); ++k)
  {
    const float u = SQUARES[k].u;
    const float v = SQUARES[k].v;
    for (std::size_t i = 0; i < SIZE; ++i)
    {
      places.x[k * SIZE + i] = x + u * steps.ux[i] + v * steps.vx[i];
      places.y[k * SIZE + i] = y + u * steps.uy[i] + v * steps.vy[i];
    }
  }
  std::array<float, SQUARES.size() * SIZE> values;
  sampleGreys(grey, places, values);
  std::array<float, SIZE> light;  // the darkest of the light squares, as seen with the sign of the first two
  std::array<float, SIZE> dark;
  std::array<float, SIZE> sign;
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    sign[i] = values[i] > values[SIZE + i] ? 1.F : -1.F;
    light[i] = sign[i] * values[i];
    dark[i] = sign[i] * values[SIZE + i];
  }
  for (std::size_t k = 2; k < SQUARES.size(); ++k)
  {
    for (std::size_t i = 0; i < SIZE; ++i)
    {
      const float value = sign[i] * values[k * SIZE + i];
      light[i] = SQUARES[k].is_like_first ? std::min(light[i], value) : light[i];
      dark[i] = SQUARES[k].is_like_first ? dark[i] : std::max(dark[i], value);
    }
  }
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    gaps[i] = light[i] - dark[i];
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
    std::array<float, Steps::SIZE> gaps;
    measureGaps(grey_, center_, steps_, gaps);
    const auto end = gaps.begin() + count_;
    count_ = 0;
    const auto gap = std::find_if(gaps.begin(), end, [this](float value) { return value >= least_gap_; });
    if (gap != end)
    {
      const std::size_t i = gap - gaps.begin();
      seed = {{center_, {steps_.ux[i], steps_.uy[i]}, {steps_.vx[i], steps_.vy[i]}}, true, static_cast<int>(*gap)};
      return true;
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
