#include "lane_median.h"

#include <limits>
#include <opencv2/core/hal/intrin.hpp>

namespace omr
{
namespace
{
constexpr std::size_t HALF = MEDIAN_COUNT / 2;

constexpr std::size_t VECTOR = 4;  // lanes

void order(LaneRow& first, LaneRow& second)
{
  for (std::size_t lane = 0; lane < MEDIAN_LANES; lane += VECTOR)
  {
    const cv::v_float32x4 a = cv::v_load(&first[lane]);
    const cv::v_float32x4 b = cv::v_load(&second[lane]);
    cv::v_store(&first[lane], cv::v_min(a, b));
    cv::v_store(&second[lane], cv::v_max(a, b));
  }
}

/** Two rows to be put in order. */
struct Comparison
{
  std::size_t first, second;
};

constexpr std::size_t COMPARISONS = 191;  // of a network for HALF rows

/** Batcher's odd-even merge sort (Knuth, The Art of Computer Programming 3, algorithm 5.2.2M) of half of the rows. */
constexpr std::array<Comparison, COMPARISONS> mergeSort()
{
  std::array<Comparison, COMPARISONS> network{};
  std::size_t count = 0;
  for (std::size_t p = 1; p < HALF; p *= 2)
  {
    for (std::size_t k = p; k >= 1; k /= 2)
    {
      for (std::size_t j = k % p; j + k < HALF; j += 2 * k)
      {
        for (std::size_t i = j; i < j + k && i + k < HALF; ++i)
        {
          if (i / (2 * p) == (i + k) / (2 * p))
          {
            network[count++] = {i, i + k};
          }
        }
      }
    }
  }
  return network;
}

constexpr std::array<Comparison, COMPARISONS> NETWORK = mergeSort();

void sortHalf(LaneRow* rows)
{
  for (const Comparison& comparison : NETWORK)
  {
    order(rows[comparison.first], rows[comparison.second]);
  }
}
}  // namespace

void upperMedians(std::array<LaneRow, MEDIAN_COUNT>& rows, LaneRow& medians)
{
  sortHalf(rows.data());
  sortHalf(rows.data() + HALF);
  // Of two sorted halves, the larger of each pair from opposite ends are the upper half of all.
  for (std::size_t lane = 0; lane < MEDIAN_LANES; lane += VECTOR)
  {
    cv::v_float32x4 least = cv::v_setall_f32(std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < HALF; ++i)
    {
      const cv::v_float32x4 low = cv::v_load(&rows[i][lane]);
      const cv::v_float32x4 high = cv::v_load(&rows[MEDIAN_COUNT - 1 - i][lane]);
      least = cv::v_min(least, cv::v_max(low, high));
    }
    cv::v_store(&medians[lane], least);
  }
}

}  // namespace omr
