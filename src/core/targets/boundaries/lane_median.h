#ifndef OUTDOOR_OMR_CORE_LANE_MEDIAN_H
#define OUTDOOR_OMR_CORE_LANE_MEDIAN_H

#include <array>
#include <cstddef>

namespace omr
{
constexpr std::size_t MEDIAN_LANES = 8;
constexpr std::size_t MEDIAN_COUNT = 64;

/** One value of each lane. */
using LaneRow = std::array<float, MEDIAN_LANES>;

/**
 * Of each lane the value with half of the others below it, as std::nth_element() finds it: the upper one of the two in
 * the middle. A network of comparisons for all lanes at once, at a quarter of the time.
 *
 * @param rows are sorted partly.
 */
void upperMedians(std::array<LaneRow, MEDIAN_COUNT>& rows, LaneRow& medians);

}  // namespace omr

#endif
