#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "checkerboards/checkerboards.h"
#include "checkerboards/seeds/eroded_squares.h"
#include "checkerboards/seeds/saturated_islands.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

namespace
{
constexpr int ROWS = 6;
constexpr int COLS = 9;
constexpr double SQUARE = 20;  // px
const cv::Size SIZE(420, 340);

/** A picture with more light than the camera takes: what is white spills over and stays white. */
cv::Mat overexposed(const omr::test::Render& render)
{
  cv::Mat light;
  render.picture(0, 0).convertTo(light, CV_32F, 1 / 255.);
  cv::pow(light, 2.2, light);
  cv::GaussianBlur(light, light, {}, 0.2 * SQUARE);
  light = cv::min(5 * light, 1);
  cv::pow(light, 1 / 2.2, light);
  cv::Mat picture;
  light.convertTo(picture, CV_8U, 255);
  return picture;
}

cv::Matx33d homography()
{
  return omr::test::boardHomography(ROWS, COLS, {210, 170}, SQUARE, 20, 20);
}

std::vector<omr::Checkerboard> findIn(const cv::Mat& picture)
{
  omr::RegionMap map;
  omr::FillPipeline("reference").run(picture, omr::Settings(), {}, map);
  return omr::findCheckerboards(omr::makeFrame(picture), map, omr::Settings());
}

std::vector<omr::ErodedPart> partsOf(const cv::Mat& picture)
{
  return omr::findErodedParts(omr::makeFrame(picture), omr::SearchMap(picture.size()));
}
}  // namespace

TEST(SaturatedIslands, haveWhiteAllAround)
{
  cv::Mat grey(60, 90, CV_8UC1, cv::Scalar(255));
  grey(cv::Rect(10, 20, 5, 4)) = 100;
  grey(cv::Rect(30, 20, 9, 9)) = 100;  // a ring
  grey(cv::Rect(33, 23, 3, 3)) = 255;
  grey(cv::Rect(50, 10, 2, 12)) = 230;  // two arms that meet below
  grey(cv::Rect(60, 10, 2, 12)) = 230;
  grey(cv::Rect(50, 22, 12, 2)) = 230;
  grey(cv::Rect(0, 40, 20, 3)) = 100;  // these touch the picture's border
  grey(cv::Rect(70, 0, 3, 3)) = 100;
  grey(cv::Rect(80, 30, 10, 2)) = 100;
  grey(cv::Rect(40, 50, 3, 10)) = 100;
  std::vector<omr::Island> islands = omr::findIslands(grey, 235);
  std::sort(islands.begin(), islands.end(), [](const auto& a, const auto& b) { return a.center.x < b.center.x; });
  ASSERT_EQ(3U, islands.size());
  EXPECT_EQ(20, islands[0].area);
  EXPECT_EQ(cv::Point2f(12, 21.5F), islands[0].center);
  EXPECT_EQ(72, islands[1].area);
  EXPECT_EQ(cv::Point2f(34, 24), islands[1].center);
  EXPECT_EQ(72, islands[2].area);
  EXPECT_FLOAT_EQ(55.5F, islands[2].center.x);
  EXPECT_TRUE(omr::findIslands(cv::Mat(60, 90, CV_8UC1, cv::Scalar(200)), 235).empty());
}

TEST(ErodedSquares, areFoundWithTheirSides)
{
  omr::test::Render render(SIZE);
  render.addBoard(ROWS, COLS, homography());
  const cv::Mat picture = overexposed(render);
  const std::vector<omr::ErodedPart> parts = partsOf(picture);
  ASSERT_EQ(1U, parts.size());
  const cv::Point2f step(omr::test::project(homography(), COLS / 2. + 1, ROWS / 2.) -
                         omr::test::project(homography(), COLS / 2., ROWS / 2.));
  const double deviation = std::min(std::min(cv::norm(parts[0].u - step), cv::norm(parts[0].u + step)),
                                    std::min(cv::norm(parts[0].v - step), cv::norm(parts[0].v + step)));
  EXPECT_LT(deviation, 0.1 * SQUARE);
  EXPECT_LT(parts[0].width, 0.85F);
  EXPECT_TRUE(partsOf(render.picture()).empty()) << "without too much light";
}

TEST(ErodedSquares, areNoDots)
{
  omr::test::Render render(SIZE);
  const cv::Matx33d to_pixels = homography();
  render.addPolygon({omr::test::project(to_pixels, -1, -1), omr::test::project(to_pixels, COLS + 1, -1),
                     omr::test::project(to_pixels, COLS + 1, ROWS + 1), omr::test::project(to_pixels, -1, ROWS + 1)},
                    cv::Scalar::all(255));
  for (int i = 0; i < ROWS; ++i)
  {
    for (int j = i % 2; j < COLS; j += 2)
    {
      render.addCircle({j + 0.5, i + 0.5}, 0.35, to_pixels, cv::Scalar::all(20));
    }
  }
  const cv::Mat picture = render.picture();
  EXPECT_GE(omr::findIslands(omr::makeFrame(picture).grey.front(), 235).size(), 27U);
  EXPECT_TRUE(partsOf(picture).empty());
  EXPECT_TRUE(findIn(picture).empty());
}

TEST(Checkerboards, areFoundWhereTooMuchLightPartsTheirSquares)
{
  omr::test::Render render(SIZE);
  render.addBoard(ROWS, COLS, homography());
  const std::vector<omr::Checkerboard> boards = findIn(overexposed(render));
  ASSERT_EQ(1U, boards.size());
  EXPECT_EQ(ROWS, boards[0].rows);
  EXPECT_EQ(COLS, boards[0].cols);
  EXPECT_FALSE(boards[0].size_certain);
  for (int i = 1; i < ROWS; ++i)
  {
    for (int j = 1; j < COLS; ++j)
    {
      double nearest = SQUARE;
      for (const cv::Point2f& corner : boards[0].inner_corners)
      {
        nearest = std::min(nearest, cv::norm(cv::Point2d(corner) - omr::test::project(homography(), j, i)));
      }
      EXPECT_LT(nearest, 0.4) << i << " " << j;
    }
  }
}

TEST(Checkerboards, areNotSmallerWhereLightLeavesLittleOfTheRim)
{
  omr::test::Render render(SIZE);
  render.addBoard(ROWS, COLS, homography());
  const cv::Matx33d to_pixels = homography();
  for (const double x : {-1.2, COLS - 0.5})
  {
    render.addPolygon({omr::test::project(to_pixels, x, -1), omr::test::project(to_pixels, x + 1.7, -1),
                       omr::test::project(to_pixels, x + 1.7, ROWS + 1), omr::test::project(to_pixels, x, ROWS + 1)},
                      cv::Scalar::all(255));
  }
  for (const omr::Checkerboard& board : findIn(overexposed(render)))
  {
    EXPECT_EQ(ROWS, board.rows);
    EXPECT_EQ(COLS, board.cols);
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
