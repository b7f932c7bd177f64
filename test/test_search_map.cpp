#include "checkerboards/seeds/search_map.h"

#include <gtest/gtest.h>

using omr::SearchMap;

TEST(SearchMap, twoFailuresCloseAPlaceAndNoOther)
{
  SearchMap map({100, 80});
  map.addFailure({50, 40}, 10);
  EXPECT_TRUE(map.isOpen({50, 40}));
  map.addFailure({50, 40}, 10);
  EXPECT_FALSE(map.isOpen({50, 40}));
  EXPECT_FALSE(map.isOpen({52, 40}));
  EXPECT_TRUE(map.isOpen({60, 40}));
}

TEST(SearchMap, aBoardClosesItsArea)
{
  SearchMap map({100, 80});
  map.close({{20, 20}, {60, 20}, {60, 50}, {20, 50}});
  EXPECT_FALSE(map.isOpen({40, 35}));
  EXPECT_TRUE(map.isOpen({80, 35}));
}

TEST(SearchMap, aFailureOutsideTheImageIsNoMistake)
{
  SearchMap map({60, 40});
  for (const cv::Point2f& point :
       {cv::Point2f(-50, 20), cv::Point2f(30, -50), cv::Point2f(500, 20), cv::Point2f(30, 500)})
  {
    EXPECT_NO_THROW(map.addFailure(point, 10, 2));
    EXPECT_FALSE(map.isOpen(point));
  }
  EXPECT_TRUE(map.isOpen({30, 20}));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
