#include "saturated_islands.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <opencv2/core/hal/intrin.hpp>

namespace omr
{
namespace
{
constexpr int LANES = 16;
constexpr int MAX_WIDTH = 200;            // px of an island
constexpr std::size_t MAX_RUNS = 100000;  // bounds the time on noise

/** Pixels of a row from white to white: the first, and the white one behind. */
struct Run
{
  int y, from, to;
};

/** Calls the action for each place of a row where white begins or ends. */
template <typename Action>
void forEachChange(const uchar* row, int width, int white, const Action& action)
{
  const cv::v_uint8x16 least = cv::v_setall_u8(static_cast<uchar>(white));
  unsigned last = 0;  // whether the pixel before is white
  int x = 0;
  for (; x + LANES <= width; x += LANES)
  {
    const auto mask = static_cast<unsigned>(cv::v_signmask(cv::v_load(row + x) >= least));
    for (unsigned changes = (mask ^ (mask << 1U | last)) & 0xffffU; changes != 0; changes &= changes - 1)
    {
      action(x + __builtin_ctz(changes));
    }
    last = mask >> (LANES - 1U);
  }
  for (; x < width; ++x)
  {
    const unsigned is_white = row[x] >= white ? 1 : 0;
    if (is_white != last)
    {
      action(x);
    }
    last = is_white;
  }
}

/** Runs of all rows, those of a row from left to right; the border of the picture bounds some. */
std::vector<Run> findRuns(const cv::Mat& grey, int white)
{
  std::vector<Run> runs;
  for (int y = 0; y < grey.rows && runs.size() < MAX_RUNS; ++y)
  {
    const auto* row = grey.ptr<uchar>(y);
    int from = -1;  // of the run that is open to the left
    bool is_white = false;
    forEachChange(row, grey.cols, white, [&](int x) {
      is_white = !is_white;
      if (is_white)
      {
        if (x > 0)
        {
          runs.push_back({y, from, x});
        }
      }
      else
      {
        from = x;
      }
    });
    if (!is_white)
    {
      runs.push_back({y, from, grey.cols + 1});
    }
  }
  return runs;
}

int rootOf(std::vector<int>& parents, int run)
{
  while (parents[run] != run)
  {
    run = parents[run] = parents[parents[run]];
  }
  return run;
}
}  // namespace

std::vector<Island> findIslands(const cv::Mat& grey, int white)
{
  const std::vector<Run> runs = findRuns(grey, white);
  const auto count = static_cast<int>(runs.size());
  std::vector<int> parents(runs.size());
  std::iota(parents.begin(), parents.end(), 0);
  int above = 0;
  for (int i = 0; i < count; ++i)
  {
    while (runs[above].y < runs[i].y - 1 || (runs[above].y == runs[i].y - 1 && runs[above].to <= runs[i].from))
    {
      ++above;
    }
    for (int j = above; j < i && runs[j].y == runs[i].y - 1 && runs[j].from < runs[i].to; ++j)
    {
      parents[rootOf(parents, j)] = rootOf(parents, i);
    }
  }
  struct Sum
  {
    std::int64_t x = 0, y = 0;
    int area = 0;
    bool open = false;
  };
  std::vector<Sum> sums(runs.size());
  for (int i = 0; i < count; ++i)
  {
    const Run& run = runs[i];
    Sum& sum = sums[rootOf(parents, i)];
    const int length = run.to - run.from;
    sum.open =
        sum.open || run.from < 0 || run.to > grey.cols || length > MAX_WIDTH || run.y == 0 || run.y == grey.rows - 1;
    sum.area += length;
    sum.x += static_cast<std::int64_t>(run.from + run.to - 1) * length;
    sum.y += static_cast<std::int64_t>(run.y) * length;
  }
  std::vector<Island> islands;
  for (const Sum& sum : sums)
  {
    if (sum.area > 0 && !sum.open)
    {
      const auto area = static_cast<float>(sum.area);
      islands.push_back({{static_cast<float>(sum.x) / (2 * area), static_cast<float>(sum.y) / area}, sum.area});
    }
  }
  return islands;
}

}  // namespace omr
