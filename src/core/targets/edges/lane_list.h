#ifndef OUTDOOR_OMR_CORE_LANE_LIST_H
#define OUTDOOR_OMR_CORE_LANE_LIST_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/hal/intrin.hpp>

namespace omr
{
/** Lists which of eight values side by side are wanted, without a branch, which could not be foreseen. */
class LaneList
{
 public:
  static constexpr std::size_t LANES = 8;

  /** A bit for each of the values that are not 0 but -1. */
  static unsigned bitsOf(const std::int32_t* values)
  {
    const int low = cv::v_signmask(cv::v_load(values));
    const int high = cv::v_signmask(cv::v_load(values + LANES / 2));
    return static_cast<unsigned>(low | high << (LANES / 2));
  }

  /**
   * Writes the places of the bits, from the lowest on; what follows them is garbage.
   *
   * @param first  of the eight places.
   * @param places room for all eight.
   * @return       how many there are.
   */
  static std::size_t write(unsigned bits, std::uint16_t first, std::uint16_t* places)
  {
    cv::v_store(places, cv::v_load(TABLE[bits].lanes.data()) + cv::v_setall_u16(first));
    return TABLE[bits].count;
  }

 private:
  static constexpr std::size_t SETS = 1U << LANES;

  struct Entry
  {
    std::array<std::uint16_t, LANES> lanes;
    std::size_t count;
  };

  static constexpr std::array<Entry, SETS> makeTable()
  {
    std::array<Entry, SETS> table{};
    for (std::size_t bits = 0; bits < SETS; ++bits)
    {
      Entry& entry = table[bits];
      for (std::uint16_t lane = 0; lane < LANES; ++lane)
      {
        if ((bits >> lane & 1U) != 0)
        {
          entry.lanes[entry.count++] = lane;
        }
      }
    }
    return table;
  }

  static const std::array<Entry, SETS> TABLE;
};

inline constexpr std::array<LaneList::Entry, LaneList::SETS> LaneList::TABLE = LaneList::makeTable();

}  // namespace omr

#endif
