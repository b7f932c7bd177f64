#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "targets/edges/lane_list.h"

namespace
{
TEST(LaneList, ListsEverySetOfLanes)
{
  constexpr std::uint16_t FIRST = 40;
  for (unsigned bits = 0; bits < 256; ++bits)
  {
    std::array<std::int32_t, omr::LaneList::LANES> values{};
    std::vector<std::uint16_t> expected;
    for (std::uint16_t lane = 0; lane < omr::LaneList::LANES; ++lane)
    {
      if ((bits >> lane & 1U) != 0)
      {
        values[lane] = -1;
        expected.push_back(FIRST + lane);
      }
    }
    EXPECT_EQ(bits, omr::LaneList::bitsOf(values.data()));
    std::array<std::uint16_t, omr::LaneList::LANES> places{};
    const std::size_t count = omr::LaneList::write(bits, FIRST, places.data());
    EXPECT_EQ(expected, std::vector<std::uint16_t>(places.begin(), places.begin() + count)) << bits;
  }
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
