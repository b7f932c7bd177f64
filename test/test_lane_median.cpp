#include "targets/boundaries/lane_median.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

using omr::LaneRow;
using omr::MEDIAN_COUNT;
using omr::MEDIAN_LANES;

TEST(LaneMedian, isTheUpperOneOfTheTwoInTheMiddle)
{
  std::mt19937 random(7);
  std::normal_distribution<float> many(0, 1);
  std::uniform_int_distribution<int> few(-2, 2);
  for (int round = 0; round < 200; ++round)
  {
    std::array<LaneRow, MEDIAN_COUNT> rows;
    for (LaneRow& row : rows)
    {
      for (float& value : row)
      {
        value = round % 2 == 0 ? many(random) : static_cast<float>(few(random));
      }
    }
    const std::array<LaneRow, MEDIAN_COUNT> before = rows;
    LaneRow medians;
    omr::upperMedians(rows, medians);
    for (std::size_t lane = 0; lane < MEDIAN_LANES; ++lane)
    {
      std::vector<float> values;
      for (const LaneRow& row : before)
      {
        values.push_back(row[lane]);
      }
      const auto middle = values.begin() + MEDIAN_COUNT / 2;
      std::nth_element(values.begin(), middle, values.end());
      EXPECT_EQ(*middle, medians[lane]);
    }
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
