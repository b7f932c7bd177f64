#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <set>
#include <stdexcept>
#include <tuple>

#include "outdoor_omr/overlay.h"
#include "outdoor_omr/reference_fill.h"

using omr::Checkerboard;
using omr::Markers;
using omr::RegionMap;
using omr::Target;

namespace
{
const cv::Scalar GREY(90, 90, 90);
const cv::Vec3b YELLOW(0, 255, 255);
const cv::Vec3b GREEN(0, 255, 0);
const cv::Vec3b RED(0, 0, 255);

/** A frontal board whose first outer corner is at origin. */
Checkerboard makeBoard(int rows, int cols, double side, const cv::Point2d& origin)
{
  const auto at = [&](double row, double col) { return cv::Point2f(origin + side * cv::Point2d(col, row)); };
  Checkerboard board;
  board.rows = rows;
  board.cols = cols;
  board.corners = {at(0, 0), at(0, cols), at(rows, cols), at(rows, 0)};
  for (int row = 0; row < rows; ++row)
  {
    for (int col = 0; col < cols; ++col)
    {
      board.squares.push_back(at(row + 0.5, col + 0.5));
      board.squares_seen.push_back(true);
      if (row > 0 && col > 0)
      {
        board.inner_corners.push_back(at(row, col));
        board.inner_corners_seen.push_back(true);
      }
    }
  }
  return board;
}

Target makeTarget(const std::string& colors, double ring, const cv::Point2d& center)
{
  Target target;
  target.colors = colors;
  target.center = center;
  for (std::size_t i = 1; i <= colors.size(); ++i)
  {
    const auto diameter = static_cast<float>(2 * ring * static_cast<double>(i));
    target.rings.emplace_back(cv::Point2f(center), cv::Size2f(diameter, diameter), 0.F);
  }
  return target;
}

cv::Mat draw(const cv::Size& size, const Markers& markers)
{
  return omr::drawOverlay(cv::Mat(size, CV_8UC3, GREY), markers, {});
}

int countChanged(const cv::Mat& picture)
{
  cv::Mat changed;
  cv::inRange(picture, GREY, GREY, changed);
  return static_cast<int>(picture.total()) - cv::countNonZero(changed);
}

// An anti-aliased line of one pixel does not reach its full colour.
constexpr int TOLERANCE = 64;

int count(const cv::Mat& picture, const cv::Vec3b& color)
{
  const cv::Scalar value(color);
  const cv::Scalar tolerance = cv::Scalar::all(TOLERANCE);
  cv::Mat like;
  cv::inRange(picture, value - tolerance, value + tolerance, like);
  return cv::countNonZero(like);
}

bool isLike(const cv::Mat& picture, int x, int y, const cv::Vec3b& color)
{
  return count(picture(cv::Rect(x, y, 1, 1)), color) == 1;
}
}  // namespace

TEST(Overlay, withoutMarkersIsACopyOfTheImage)
{
  cv::Mat image(48, 64, CV_8UC3);
  cv::randu(image, 0, 256);
  const cv::Mat before = image.clone();
  cv::Mat picture = omr::drawOverlay(image, {}, {});
  EXPECT_EQ(0, cv::norm(picture, before, cv::NORM_INF));
  picture.setTo(0);
  EXPECT_EQ(0, cv::norm(image, before, cv::NORM_INF)) << "the overlay shares the image's memory";
}

TEST(Overlay, doesNotChangeTheImageItDrawsOn)
{
  const cv::Mat image(480, 640, CV_8UC3, GREY);
  Markers markers;
  markers.checkerboards = {makeBoard(5, 7, 40, {50, 60})};
  markers.targets = {makeTarget("RWP", 20, {500, 300})};
  EXPECT_GT(countChanged(omr::drawOverlay(image, markers, {})), 1000);
  EXPECT_EQ(0, countChanged(image));
}

TEST(Overlay, drawsAYellowCircleAtTheTargetsCentreAndItsRings)
{
  Markers markers;
  markers.targets = {makeTarget("RWPGB", 30, {320, 240})};
  const cv::Mat picture = draw({640, 480}, markers);
  // The circle's radius is 5 px at 480 px; its inside stays free, so that the centre can be judged.
  EXPECT_TRUE(isLike(picture, 315, 240, YELLOW));
  EXPECT_TRUE(isLike(picture, 320, 245, YELLOW));
  EXPECT_EQ(cv::Vec3b(90, 90, 90), picture.at<cv::Vec3b>(240, 320));
  for (const int radius : {30, 60, 90, 120, 150})
  {
    EXPECT_TRUE(isLike(picture, 320, 240 + radius, YELLOW)) << radius;
    EXPECT_TRUE(isLike(picture, 320 - radius, 240, YELLOW)) << radius;
  }
}

TEST(Overlay, writesTheColorSequenceInYellowOnADarkOutline)
{
  Markers markers;
  Target target;
  target.center = {100, 240};
  markers.targets = {target};
  const cv::Mat without = draw({640, 480}, markers);
  markers.targets[0].colors = "RWPGB";
  const cv::Mat with = draw({640, 480}, markers);
  EXPECT_GT(count(with, YELLOW), count(without, YELLOW) + 50);
  EXPECT_GT(count(with, {0, 0, 0}), count(without, {0, 0, 0}) + 100);
}

TEST(Overlay, circlesSeenSquaresInOneColorPerBoard)
{
  Markers markers;
  markers.checkerboards = {makeBoard(5, 7, 40, {20, 40}), makeBoard(5, 7, 40, {340, 40})};
  markers.checkerboards[0].squares_seen[8] = false;
  const cv::Mat picture = draw({640, 480}, markers);
  // A circle's radius is a fifth of the square's side, at most 6 px at 480 px.
  const auto left_of = [&](const cv::Point2f& square) {
    return picture.at<cv::Vec3b>(cvRound(square.y), cvRound(square.x) - 6);
  };
  const cv::Vec3b first = left_of(markers.checkerboards[0].squares[0]);
  const cv::Vec3b second = left_of(markers.checkerboards[1].squares[0]);
  EXPECT_NE(first, cv::Vec3b(90, 90, 90));
  EXPECT_GT(cv::norm(first, second), 100);
  for (std::size_t i = 0; i < 35; ++i)
  {
    EXPECT_EQ(i == 8 ? cv::Vec3b(90, 90, 90) : first, left_of(markers.checkerboards[0].squares[i])) << i;
    EXPECT_EQ(second, left_of(markers.checkerboards[1].squares[i])) << i;
  }
}

TEST(Overlay, theOutlineOfABentBoardIsBent)
{
  // Its lines from top to bottom stay upright, the others are parabolas 30 px high.
  const auto bend = [](const cv::Point2f& point) {
    const double across = (point.x - 320) / 210;
    return cv::Point2f(point.x, static_cast<float>(point.y - 30 * (1 - across * across)));
  };
  Checkerboard board = makeBoard(5, 7, 60, {110, 100});
  std::transform(board.corners.begin(), board.corners.end(), board.corners.begin(), bend);
  std::transform(board.inner_corners.begin(), board.inner_corners.end(), board.inner_corners.begin(), bend);
  board.squares_seen.assign(board.squares_seen.size(), false);
  const auto is_drawn = [&](const cv::Point2f& at) {
    Markers markers;
    markers.checkerboards = {board};
    return countChanged(draw({640, 480}, markers)(cv::Rect(cvRound(at.x) - 1, cvRound(at.y) - 1, 3, 3))) > 0;
  };
  EXPECT_TRUE(is_drawn(bend({350, 100})));
  EXPECT_TRUE(is_drawn(bend({290, 400})));
  EXPECT_FALSE(is_drawn({320, 100}));
  board.inner_corners_seen.assign(board.inner_corners_seen.size(), false);  // where nothing is seen nothing bends
  EXPECT_FALSE(is_drawn(bend({350, 100})));
  EXPECT_TRUE(is_drawn({350, 100}));
}

TEST(Overlay, tellsSeenInnerCornersFromHiddenOnes)
{
  Markers markers;
  markers.checkerboards = {makeBoard(5, 7, 40, {100, 100})};
  markers.checkerboards[0].inner_corners_seen[7] = false;
  const cv::Mat picture = draw({640, 480}, markers);
  EXPECT_TRUE(isLike(picture, 140, 140, GREEN));  // corner 0
  EXPECT_TRUE(isLike(picture, 144, 140, GREEN));
  EXPECT_TRUE(isLike(picture, 180, 180, RED));  // corner 7: second row, second column
  EXPECT_TRUE(isLike(picture, 184, 184, RED));
  EXPECT_EQ(cv::Vec3b(90, 90, 90), picture.at<cv::Vec3b>(180, 184));
}

TEST(Overlay, anUncertainSizeIsWrittenDifferently)
{
  Markers markers;
  markers.checkerboards = {makeBoard(5, 7, 40, {100, 100})};
  const cv::Mat certain = draw({640, 480}, markers);
  markers.checkerboards[0].size_certain = false;
  EXPECT_GT(cv::norm(certain, draw({640, 480}, markers), cv::NORM_L1), 10000);
}

TEST(Overlay, linesAndTextGrowWithTheImage)
{
  Markers small;
  small.targets = {makeTarget("RWP", 30, {320, 240})};
  Markers large;
  large.targets = {makeTarget("RWP", 135, {1440, 1080})};
  const double share_small = count(draw({640, 480}, small), YELLOW) / (640. * 480);
  const double share_large = count(draw({2880, 2160}, large), YELLOW) / (2880. * 2160);
  // The rings' lines grow half as fast as the rest, lest they hide the edge they mark.
  EXPECT_GT(share_large, 0.3 * share_small);
  EXPECT_LT(share_large, 2 * share_small);
}

TEST(Overlay, keepsTextInsideThePicture)
{
  Markers markers;
  Target target;
  target.center = {635, 2};
  target.colors = "RWPGB";
  markers.targets = {target};
  const cv::Mat corner = draw({640, 480}, markers);
  markers.targets[0].center = {300, 200};
  const cv::Mat middle = draw({640, 480}, markers);
  EXPECT_GT(count(corner, YELLOW), 0.85 * count(middle, YELLOW));
}

TEST(Overlay, paintsEveryRegionTheFirstBlueEdgesYellow)
{
  cv::Mat image(60, 80, CV_8UC3, cv::Scalar(200, 200, 200));
  cv::rectangle(image, {10, 10, 20, 20}, {0, 0, 0}, cv::FILLED);
  cv::rectangle(image, {50, 30, 20, 20}, {0, 0, 255}, cv::FILLED);
  RegionMap regions;
  regions.size = image.size();
  regions.edges = omr::edgeMask(image, {100});
  regions.labels = omr::labelRegions(regions.edges);
  const cv::Mat picture = omr::drawOverlay(image, {}, regions);
  const auto& first_square = picture.at<cv::Vec3b>(20, 20);
  const auto& second_square = picture.at<cv::Vec3b>(40, 60);
  EXPECT_NE(first_square, second_square);
  std::set<std::tuple<int, int, int>> colors;
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      const auto& pixel = picture.at<cv::Vec3b>(y, x);
      colors.emplace(pixel[0], pixel[1], pixel[2]);
      if (regions.edges.at<std::uint8_t>(y, x) != 0)
      {
        ASSERT_EQ(YELLOW, pixel) << x << ", " << y;
      }
      else if (regions.labels.at<int>(y, x) == 0)
      {
        ASSERT_EQ(cv::Vec3b(255, 0, 0), pixel) << x << ", " << y;
      }
    }
  }
  EXPECT_EQ(4U, colors.size());
  EXPECT_EQ(0, cv::norm(picture, omr::drawOverlay(image, {}, regions), cv::NORM_INF));
}

TEST(Overlay, survivesMarkersFarOutsideAndPositionsThatAreNoNumbers)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double far : {-50., 1e4, -1e9, 1e30, nan, infinity})
  {
    Markers markers;
    markers.checkerboards = {makeBoard(5, 7, 20, {far, far}), makeBoard(5, 7, far, {10, 10})};
    markers.targets = {makeTarget("RWP", 10, {far, 100}), makeTarget("RWP", far, {100, 100})};
    markers.targets[1].rings[1].angle = static_cast<float>(far);
    EXPECT_NO_THROW(draw({640, 480}, markers)) << far;
  }
}

TEST(Overlay, drawsWhatIsFiniteOfABoardWithHolesInItsData)
{
  Markers markers;
  markers.checkerboards = {makeBoard(5, 7, 40, {100, 100})};
  markers.checkerboards[0].inner_corners[0] = {std::numeric_limits<float>::quiet_NaN(), 0};
  markers.checkerboards[0].squares_seen.resize(3);
  const cv::Mat picture = draw({640, 480}, markers);
  EXPECT_EQ(cv::Vec3b(90, 90, 90), picture.at<cv::Vec3b>(140, 140));
  EXPECT_TRUE(isLike(picture, 180, 140, GREEN));
}

TEST(Overlay, takesTheSmallestImages)
{
  Markers markers;
  markers.checkerboards = {makeBoard(5, 7, 0.1, {0, 0})};
  markers.targets = {makeTarget("RWPGB", 0.1, {0, 0})};
  EXPECT_EQ(cv::Size(1, 1), draw({1, 1}, markers).size());
  EXPECT_EQ(cv::Size(1, 40), draw({1, 40}, markers).size());
}

TEST(Overlay, refusesWhatDoesNotFitTogether)
{
  const cv::Mat image(48, 64, CV_8UC3, GREY);
  EXPECT_THROW(omr::drawOverlay({}, {}, {}), std::invalid_argument);
  EXPECT_THROW(omr::drawOverlay(cv::Mat(48, 64, CV_8UC1), {}, {}), std::invalid_argument);
  RegionMap regions;
  regions.labels = cv::Mat::zeros(24, 32, CV_32SC1);
  EXPECT_THROW(omr::drawOverlay(image, {}, regions), std::invalid_argument);
  regions.labels = cv::Mat::zeros(48, 64, CV_32SC1);
  regions.edges = cv::Mat::zeros(48, 60, CV_8UC1);
  EXPECT_THROW(omr::drawOverlay(image, {}, regions), std::invalid_argument);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
