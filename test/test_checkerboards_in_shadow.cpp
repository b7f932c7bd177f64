#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "checkerboards/checkerboards.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

using omr::Checkerboard;
using omr::test::Render;

namespace
{
std::vector<Checkerboard> find(const cv::Mat& picture)
{
  omr::RegionMap map;
  omr::FillPipeline("reference").run(picture, omr::Settings(), {}, map);
  return omr::findCheckerboards(omr::makeFrame(picture), map, omr::Settings());
}

/** Distance of a corner to the nearest true one [px]. */
double distanceToNearest(const cv::Point2f& corner, int rows, int cols, const cv::Matx33d& truth)
{
  double least = 1e9;
  for (int i = 1; i < rows; ++i)
  {
    for (int j = 1; j < cols; ++j)
    {
      least = std::min(least, cv::norm(cv::Point2d(corner) - omr::test::project(truth, j, i)));
    }
  }
  return least;
}

/** Shadows of bars half a square wide. @param direction [degrees] @param step from bar to bar [px]; a little more than
 * the squares, so that no corner's ring is without an edge of them. */
void addFence(Render& render, const cv::Point2d& center, double direction, double step = 31)
{
  const cv::Point2d along(std::cos(direction * CV_PI / 180), std::sin(direction * CV_PI / 180));
  const cv::Point2d across(-along.y, along.x);
  for (int i = -15; i <= 15; ++i)
  {
    const cv::Point2d from = center + step * i * across - 500 * along;
    render.addShadow({from, from + 1000 * along, from + 1000 * along + 13 * across, from + 13 * across}, 0.3);
  }
}
}  // namespace

TEST(CheckerboardsInShadow, aBoardIsFoundBelowAFence)
{
  const cv::Matx33d truth = omr::test::boardHomography(5, 7, {200, 150}, 26, 10, 20);
  for (const double direction : {35, 125, 155})
  {
    Render render({400, 300});
    render.addBoard(5, 7, truth);
    addFence(render, {200, 150}, direction);
    const std::vector<Checkerboard> boards = find(render.picture(0.8));
    ASSERT_EQ(1u, boards.size()) << direction;
    EXPECT_EQ(5, boards[0].rows) << direction;
    EXPECT_EQ(7, boards[0].cols) << direction;
    for (const cv::Point2f& corner : boards[0].inner_corners)
    {
      EXPECT_LT(distanceToNearest(corner, 5, 7, truth), 1) << direction;
    }
  }
}

// Bars that run along the squares or have their width draw corners and borders of their own, and hide the board's.
TEST(CheckerboardsInShadow, mostFencesHideNoBoardAndNoneChangesItsSize)
{
  int found = 0;
  for (int direction = 5; direction < 180; direction += 20)
  {
    for (const double step : {23, 27, 31, 36, 43})
    {
      Render render({400, 300});
      render.addBoard(5, 7, omr::test::boardHomography(5, 7, {200, 150}, 26, 10, 20));
      addFence(render, {200, 150}, direction, step);
      for (const Checkerboard& board : find(render.picture(0.8)))
      {
        ++found;
        EXPECT_EQ(5, board.rows) << direction << " " << step;
        EXPECT_EQ(7, board.cols) << direction << " " << step;
      }
    }
  }
  EXPECT_GE(found, 26) << "of 45";
}

TEST(CheckerboardsInShadow, aSizeIsCertainWhereEdgesAndMarginSaySo)
{
  Render render({400, 300});
  render.addBoard(5, 7, omr::test::boardHomography(5, 7, {200, 150}, 26, 10, 20));
  addFence(render, {200, 150}, 115, 55);
  const std::vector<Checkerboard> boards = find(render.picture(0.8));
  ASSERT_EQ(1u, boards.size());
  EXPECT_TRUE(boards[0].size_certain);
}

TEST(CheckerboardsInShadow, aWholeLatticeIsFoundBelowAFenceWithoutABorder)
{
  const cv::Matx33d truth = omr::test::boardHomography(8, 10, {300, 220}, 32, 0);
  const auto at = [&](double x, double y) { return omr::test::project(truth, x, y); };
  Render render({600, 440}, cv::Scalar::all(200));
  render.addBoard(8, 10, truth);
  const cv::Scalar paper = cv::Scalar::all(225);  // half of the rim's squares is cut
  render.addPolygon({at(-1, -1), at(11, -1), at(11, 0.5), at(-1, 0.5)}, paper);
  render.addPolygon({at(-1, 7.5), at(11, 7.5), at(11, 9), at(-1, 9)}, paper);
  render.addPolygon({at(-1, -1), at(0.5, -1), at(0.5, 9), at(-1, 9)}, paper);
  render.addPolygon({at(9.5, -1), at(11, -1), at(11, 9), at(9.5, 9)}, paper);
  addFence(render, {300, 220}, 40);
  const std::vector<Checkerboard> boards = find(render.picture(0.8));
  ASSERT_EQ(1u, boards.size());
  EXPECT_EQ(8, boards[0].rows);
  EXPECT_EQ(10, boards[0].cols);
  EXPECT_FALSE(boards[0].size_certain);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
