#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <stdexcept>

#include "outdoor_omr/regularity.h"
#include "render.h"

using omr::Region;
using omr::RegionMap;
using omr::Regularity;

namespace
{
constexpr int ROWS = 5;
constexpr int COLS = 7;

cv::Matx33d board()
{
  return omr::test::boardHomography(ROWS, COLS, {200, 150}, 30, 15, 35);
}

std::vector<cv::Point2f> quads()
{
  std::vector<cv::Point2f> corners;
  for (int i = 0; i < ROWS; ++i)
  {
    for (int j = 0; j < COLS; ++j)
    {
      for (const cv::Point& at : {cv::Point(j, i), cv::Point(j + 1, i), cv::Point(j + 1, i + 1), cv::Point(j, i + 1)})
      {
        corners.emplace_back(omr::test::project(board(), at.x, at.y));
      }
    }
  }
  return corners;
}

Region regionAt(double col, double row, int area = 600)
{
  Region region;
  region.center = omr::test::project(board(), col + 0.5, row + 0.5);
  region.area = area;
  return region;
}

RegionMap allSquares()
{
  RegionMap map;
  for (int i = 0; i < ROWS; ++i)
  {
    for (int j = 0; j < COLS; ++j)
    {
      map.regions.push_back(regionAt(j, i));
    }
  }
  return map;
}
}  // namespace

TEST(Regularity, outerSquaresAreTheSharpestVerticesOfTheHull)
{
  std::vector<cv::Point2f> centers;
  for (const Region& region : allSquares().regions)
  {
    centers.emplace_back(region.center);
  }
  const std::vector<cv::Point2f> outer = omr::findOuterSquares(centers);
  ASSERT_EQ(4u, outer.size());
  for (const cv::Point& corner : {cv::Point(0, 0), cv::Point(6, 0), cv::Point(6, 4), cv::Point(0, 4)})
  {
    const cv::Point2f truth = omr::test::project(board(), corner.x + 0.5, corner.y + 0.5);
    EXPECT_TRUE(
        std::any_of(outer.begin(), outer.end(), [&](const auto& found) { return cv::norm(found - truth) < 1; }));
  }
}

TEST(Regularity, tooFewCentersOrATriangleHaveNoOuterSquares)
{
  EXPECT_TRUE(omr::findOuterSquares({}).empty());
  EXPECT_TRUE(omr::findOuterSquares({{0, 0}, {1, 0}, {0, 1}}).empty());
  EXPECT_TRUE(omr::findOuterSquares({{0, 0}, {50, 0}, {100, 0}, {0, 80}, {20, 20}}).empty());
  // A kite: its opposite angles differ by more than perspective makes them.
  EXPECT_TRUE(omr::findOuterSquares({{0, 0}, {20, -20}, {100, 0}, {20, 20}}).empty());
}

TEST(Regularity, forecastsTheSquaresUnderPerspective)
{
  std::vector<cv::Point2f> outer;
  for (const cv::Point& corner : {cv::Point(0, 0), cv::Point(6, 0), cv::Point(6, 4), cv::Point(0, 4)})
  {
    outer.emplace_back(omr::test::project(board(), corner.x + 0.5, corner.y + 0.5));
  }
  const std::vector<cv::Point2f> forecast = omr::forecastSquares(outer, ROWS, COLS);
  ASSERT_EQ(35u, forecast.size());
  EXPECT_LT(cv::norm(forecast[2 * COLS + 3] - cv::Point2f(omr::test::project(board(), 3.5, 2.5))), 0.05);
  EXPECT_THROW(omr::forecastSquares(outer, 1, 7), std::invalid_argument);
  EXPECT_THROW(omr::forecastSquares({}, 5, 7), std::invalid_argument);
}

TEST(Regularity, countsWhatIsThereAndAcceptsHoles)
{
  RegionMap map = allSquares();
  EXPECT_DOUBLE_EQ(1, omr::checkRegularity(quads(), map).share);
  map.regions.erase(map.regions.begin() + 10);
  const Regularity hole = omr::checkRegularity(quads(), map);
  EXPECT_FALSE(hole.seen[10]);
  EXPECT_DOUBLE_EQ(34. / 35, hole.share);
}

TEST(Regularity, refusesAPlaceThatTwoRegionsClaim)
{
  RegionMap map = allSquares();
  map.regions.push_back(regionAt(2.1, 1));
  const Regularity twice = omr::checkRegularity(quads(), map);
  EXPECT_EQ(1, twice.claimed_twice);
  EXPECT_FALSE(twice.seen[COLS + 2]);
  // A speck or the whole sheet claims nothing.
  map = allSquares();
  map.regions.push_back(regionAt(2.1, 1, 5));
  map.regions.push_back(regionAt(2.1, 1, 100000));
  EXPECT_EQ(0, omr::checkRegularity(quads(), map).claimed_twice);
}

TEST(Regularity, nothingIsNotRegular)
{
  EXPECT_EQ(0, omr::checkRegularity(quads(), RegionMap()).share);
  EXPECT_EQ(0, omr::checkRegularity({}, allSquares()).share);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
