#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "checkerboards/judgement/regularity.h"
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

/** The board and its white margin. */
cv::Mat picture()
{
  omr::test::Render render({400, 300}, cv::Scalar::all(60));
  render.addBoard(ROWS, COLS, board());
  cv::Mat grey;
  cv::cvtColor(render.picture(), grey, cv::COLOR_BGR2GRAY);
  return grey;
}

Regularity check(const std::vector<cv::Point2f>& corners, const RegionMap& map, const cv::Mat& grey = picture())
{
  return omr::checkRegularity(corners, ROWS, COLS, map, grey);
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
  // The top left square is hidden, its neighbour stands in for it.
  const std::vector<cv::Point> places = {{1, 0}, {6, 0}, {6, 4}, {0, 4}};
  std::vector<cv::Point2f> outer;
  for (const cv::Point& place : places)
  {
    outer.emplace_back(omr::test::project(board(), place.x + 0.5, place.y + 0.5));
  }
  const std::vector<cv::Point2f> forecast = omr::forecastSquares(outer, places, ROWS, COLS);
  ASSERT_EQ(35u, forecast.size());
  EXPECT_LT(cv::norm(forecast[2 * COLS + 3] - cv::Point2f(omr::test::project(board(), 3.5, 2.5))), 0.05);
  EXPECT_LT(cv::norm(forecast[0] - cv::Point2f(omr::test::project(board(), 0.5, 0.5))), 0.05);
}

TEST(Regularity, threeOuterSquaresInALineForecastNothing)
{
  const std::vector<cv::Point2f> outer = {{0, 0}, {10, 0}, {20, 0}, {20, 20}};
  EXPECT_TRUE(omr::forecastSquares(outer, {{0, 0}, {1, 0}, {2, 0}, {2, 2}}, ROWS, COLS).empty());
}

TEST(Regularity, forecastRefusesWhatIsNoBoard)
{
  const std::vector<cv::Point2f> outer(4);
  EXPECT_THROW(omr::forecastSquares(outer, std::vector<cv::Point>(4), 1, 7), std::invalid_argument);
  EXPECT_THROW(omr::forecastSquares(outer, {}, 5, 7), std::invalid_argument);
  EXPECT_THROW(omr::forecastSquares({}, {}, 5, 7), std::invalid_argument);
  EXPECT_THROW(omr::checkRegularity({}, ROWS, COLS, RegionMap(), picture()), std::invalid_argument);
  EXPECT_THROW(omr::checkRegularity(std::vector<cv::Point2f>(4 * 7), 1, 7, RegionMap(), picture()),
               std::invalid_argument);
}

TEST(Regularity, theFourOuterSquaresForecastWhereInnerCornersAreWrong)
{
  // Both lines of corners around the fourth column are off by a third of a square: between them its squares would be
  // missed.
  std::vector<cv::Point2f> corners = quads();
  for (int i = 0; i < ROWS; ++i)
  {
    const auto shift = [&](int col, int corner) { corners[4 * (i * COLS + col) + corner].x += 12; };
    shift(2, 1), shift(2, 2), shift(4, 0), shift(4, 3);
    shift(3, 0), shift(3, 1), shift(3, 2), shift(3, 3);
  }
  RegionMap map = allSquares();
  for (Region& region : map.regions)
  {
    region.area = 300;
  }
  EXPECT_DOUBLE_EQ(1, check(corners, map).share);
}

TEST(Regularity, onACurvedPlateTheSquaresAreSoughtBetweenTheirCorners)
{
  const auto bend = [](cv::Point2d at) { return at + cv::Point2d(0, 0.004 * (at.x - 200) * (at.x - 200)); };
  std::vector<cv::Point2f> corners = quads();
  for (cv::Point2f& corner : corners)
  {
    corner = bend(corner);
  }
  RegionMap map = allSquares();
  for (Region& region : map.regions)
  {
    region.center = bend(region.center);
  }
  EXPECT_DOUBLE_EQ(1, check(corners, map).share);
}

TEST(Regularity, countsWhatIsThereAndAcceptsHoles)
{
  RegionMap map = allSquares();
  EXPECT_DOUBLE_EQ(1, check(quads(), map).share);
  map.regions.erase(map.regions.begin() + 10);
  const Regularity hole = check(quads(), map);
  EXPECT_FALSE(hole.seen[10]);
  EXPECT_DOUBLE_EQ(34. / 35, hole.share);
}

TEST(Regularity, refusesAPlaceThatTwoRegionsClaim)
{
  RegionMap map = allSquares();
  map.regions.push_back(regionAt(2.1, 1));
  const Regularity twice = check(quads(), map);
  EXPECT_EQ(1, twice.claimed_twice);
  EXPECT_FALSE(twice.seen[COLS + 2]);
  // A speck or the whole sheet claims nothing.
  map = allSquares();
  map.regions.push_back(regionAt(2.1, 1, 5));
  map.regions.push_back(regionAt(2.1, 1, 100000));
  EXPECT_EQ(0, check(quads(), map).claimed_twice);
}

TEST(Regularity, lightSquaresOfTheRimAreSeenInTheMargin)
{
  RegionMap map;
  for (int i = 0; i < ROWS * COLS; ++i)
  {
    const int row = i / COLS;
    const int col = i % COLS;
    const bool rim = row == 0 || row == ROWS - 1 || col == 0 || col == COLS - 1;
    if (!rim || (row + col) % 2 == 0)
    {
      map.regions.push_back(regionAt(col, row));
    }
  }
  EXPECT_DOUBLE_EQ(1, check(quads(), map).share);
  cv::Mat hidden = picture();
  const std::vector<cv::Point2f> corners = quads();
  const cv::Point center = (corners[4 * 3] + corners[4 * 3 + 2]) / 2;
  cv::circle(hidden, center + cv::Point(5, 5), 9, cv::Scalar(100), cv::FILLED);
  const Regularity partly = check(corners, map, hidden);
  EXPECT_FALSE(partly.seen[3]);
  EXPECT_DOUBLE_EQ(34. / 35, partly.share);
  // Without contrast nothing tells the squares from the margin: only those that are regions count.
  EXPECT_DOUBLE_EQ(25. / 35, check(corners, map, cv::Mat(300, 400, CV_8UC1, cv::Scalar(200))).share);
}

TEST(Regularity, nothingIsNotRegular)
{
  EXPECT_EQ(0, check(quads(), RegionMap()).share);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
