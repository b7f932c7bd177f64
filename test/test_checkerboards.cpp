#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "checkerboards/checkerboards.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

using omr::Checkerboard;
using omr::RegionMap;
using omr::Settings;
using omr::test::Render;

namespace
{
std::vector<Checkerboard> find(const cv::Mat& picture)
{
  RegionMap map;
  omr::FillPipeline("reference").run(picture, Settings(), {}, map);
  return omr::findCheckerboards(omr::makeFrame(picture), map, Settings());
}

/** Largest distance of an inner corner to the nearest true one, and of a true one to the nearest found [px]. */
double largestError(const Checkerboard& board, int rows, int cols, const cv::Matx33d& truth)
{
  double largest = 0;
  const auto nearest = [](const cv::Point2f& point, const std::vector<cv::Point2f>& others) {
    double least = 1e9;
    for (const cv::Point2f& other : others)
    {
      least = std::min(least, cv::norm(point - other));
    }
    return least;
  };
  std::vector<cv::Point2f> corners;
  for (int i = 1; i < rows; ++i)
  {
    for (int j = 1; j < cols; ++j)
    {
      corners.emplace_back(omr::test::project(truth, j, i));
      largest = std::max(largest, nearest(corners.back(), board.inner_corners));
    }
  }
  for (const cv::Point2f& corner : board.inner_corners)
  {
    largest = std::max(largest, nearest(corner, corners));
  }
  return largest;
}

void expectConsistent(const Checkerboard& board)
{
  EXPECT_LE(board.rows, board.cols);
  EXPECT_EQ(static_cast<std::size_t>((board.rows - 1) * (board.cols - 1)), board.inner_corners.size());
  EXPECT_EQ(board.inner_corners.size(), board.inner_corners_seen.size());
  EXPECT_EQ(static_cast<std::size_t>(board.rows * board.cols), board.squares.size());
  EXPECT_EQ(board.squares.size(), board.squares_seen.size());
  EXPECT_GE(board.regularity, 0);
  EXPECT_LE(board.regularity, 1);
}
}  // namespace

TEST(Checkerboards, findsEverySizeFrom5x7To21x21)
{
  for (const cv::Size& size : {cv::Size(7, 5), cv::Size(9, 6), cv::Size(10, 7), cv::Size(7, 7), cv::Size(21, 21)})
  {
    const double square = 340. / size.width;
    const cv::Matx33d truth = omr::test::boardHomography(size.height, size.width, {400, 300}, square, 25, 30);
    Render render({800, 600});
    render.addBoard(size.height, size.width, truth);
    const std::vector<Checkerboard> boards = find(render.picture());
    ASSERT_EQ(1u, boards.size()) << size;
    EXPECT_EQ(size.height, boards[0].rows);
    EXPECT_EQ(size.width, boards[0].cols);
    EXPECT_LT(largestError(boards[0], size.height, size.width, truth), 0.2) << size;
    EXPECT_TRUE(boards[0].size_certain) << size;
    EXPECT_EQ(1, boards[0].regularity) << size;
    expectConsistent(boards[0]);
  }
}

TEST(Checkerboards, smallerThan5x7IsNoBoard)
{
  Render render({400, 300});
  render.addBoard(4, 7, omr::test::boardHomography(4, 7, {200, 80}, 18, 0));
  render.addBoard(5, 6, omr::test::boardHomography(5, 6, {200, 210}, 18, 0));
  EXPECT_TRUE(find(render.picture()).empty());
}

TEST(Checkerboards, smallAndBlurredBoardsAreFoundByTheirSaddlePoints)
{
  Render small({300, 200});
  small.addBoard(5, 7, omr::test::boardHomography(5, 7, {150, 100}, 4, 20));
  EXPECT_EQ(1u, find(small.picture(0.5, 1)).size());
  Render blurred({400, 300});
  blurred.addBoard(5, 7, omr::test::boardHomography(5, 7, {200, 150}, 18, 20));
  EXPECT_EQ(1u, find(blurred.picture(4, 1)).size());
}

TEST(Checkerboards, lightDoesNotMatter)
{
  const cv::Matx33d truth = omr::test::boardHomography(7, 9, {300, 220}, 30, 12, 25);
  Render render({600, 440});
  render.addBoard(7, 9, truth);
  render.addLightGradient(0.4, 1.1);
  render.addShadow({{-10, 180}, {610, 120}, {610, 260}, {-10, 300}}, 0.25);
  render.addShadow({{330, -10}, {360, -10}, {300, 450}, {270, 450}}, 0.3);
  const std::vector<Checkerboard> boards = find(render.picture());
  ASSERT_EQ(1u, boards.size());
  EXPECT_EQ(7, boards[0].rows);
  EXPECT_EQ(9, boards[0].cols);
  EXPECT_LT(largestError(boards[0], 7, 9, truth), 0.6);
}

TEST(Checkerboards, partlyHiddenBoardsKeepTheirSize)
{
  const cv::Matx33d truth = omr::test::boardHomography(7, 9, {300, 220}, 30, 5);
  Render render({600, 440});
  render.addBoard(7, 9, truth);
  render.addPolygon({{250, -10}, {300, -10}, {340, 450}, {290, 450}}, cv::Scalar(70, 120, 60));
  const std::vector<Checkerboard> boards = find(render.picture());
  ASSERT_EQ(1u, boards.size());
  EXPECT_EQ(7, boards[0].rows);
  EXPECT_EQ(9, boards[0].cols);
  EXPECT_LT(largestError(boards[0], 7, 9, truth), 0.5);
  EXPECT_LT(std::count(boards[0].inner_corners_seen.begin(), boards[0].inner_corners_seen.end(), true), 48);
  EXPECT_LT(boards[0].regularity, 1);
}

TEST(Checkerboards, boardsSideBySideStayTwo)
{
  // The same plane, the same squares, and a common margin as wide as a whole number of squares: the lattice of one
  // continues in the other.
  for (const double margin : {0.5, 1., 1.5})
  {
    const double gap = 2 * margin;
    Render render({900, 400});
    const cv::Matx33d view = omr::test::boardHomography(5, 7, {230, 200}, 30, 4, 15);
    const cv::Matx33d shift(1, 0, 7 + gap, 0, 1, 0, 0, 0, 1);
    render.addBoard(5, 7, view, true, margin);
    render.addBoard(5, 7, view * shift, true, margin);
    const std::vector<Checkerboard> boards = find(render.picture());
    ASSERT_EQ(2u, boards.size()) << margin;
    for (const Checkerboard& board : boards)
    {
      EXPECT_EQ(5, board.rows) << margin;
      EXPECT_EQ(7, board.cols) << margin;
    }
  }
}

TEST(Checkerboards, theOrderIsTheSameUnderAllRotations)
{
  // 5 x 8: one of the two long diagonals ends in black squares only at one end, so the order is unique.
  for (int turn = 0; turn < 360; turn += 45)
  {
    const cv::Matx33d truth = omr::test::boardHomography(5, 8, {250, 250}, 25, turn);
    Render render({500, 500});
    render.addBoard(5, 8, truth);  // black: (0, 0) and (4, 0); white: (0, 7) and (4, 7)
    const std::vector<Checkerboard> boards = find(render.picture());
    ASSERT_EQ(1u, boards.size()) << turn;
    const Checkerboard& board = boards[0];
    ASSERT_EQ(5, board.rows);
    ASSERT_EQ(8, board.cols);
    EXPECT_LT(cv::norm(board.inner_corners[0] - cv::Point2f(omr::test::project(truth, 1, 1))), 0.2) << turn;
    EXPECT_LT(cv::norm(board.inner_corners[6] - cv::Point2f(omr::test::project(truth, 7, 1))), 0.2) << turn;
    EXPECT_LT(cv::norm(board.inner_corners[7] - cv::Point2f(omr::test::project(truth, 1, 2))), 0.2) << turn;
    EXPECT_LT(cv::norm(board.corners[0] - cv::Point2f(omr::test::project(truth, 0, 0))), 0.5) << turn;
    EXPECT_LT(cv::norm(board.corners[1] - cv::Point2f(omr::test::project(truth, 8, 0))), 0.5) << turn;
    EXPECT_LT(cv::norm(board.corners[2] - cv::Point2f(omr::test::project(truth, 8, 5))), 0.5) << turn;
    EXPECT_LT(cv::norm(board.squares[8] - cv::Point2f(omr::test::project(truth, 0.5, 1.5))), 0.5) << turn;
  }
}

TEST(Checkerboards, equalCornerSquaresBeginNearestToTheTopLeft)
{
  for (int turn = 10; turn < 360; turn += 50)
  {
    Render render({500, 500});
    render.addBoard(5, 7, omr::test::boardHomography(5, 7, {250, 250}, 25, turn));
    const std::vector<Checkerboard> boards = find(render.picture());
    ASSERT_EQ(1u, boards.size()) << turn;
    EXPECT_LT(cv::norm(boards[0].inner_corners.front()), cv::norm(boards[0].inner_corners.back())) << turn;
    const cv::Point2f along = boards[0].inner_corners[5] - boards[0].inner_corners[0];
    const cv::Point2f down = boards[0].inner_corners[18] - boards[0].inner_corners[0];
    EXPECT_GT(along.cross(down), 0) << turn;
  }
}

TEST(Checkerboards, aBoardCutByThePictureHasNoCertainSize)
{
  const cv::Matx33d truth = omr::test::boardHomography(9, 9, {130, 200}, 40, 0);
  Render render({400, 400});
  render.addBoard(9, 9, truth);  // the first column lies outside
  const std::vector<Checkerboard> boards = find(render.picture());
  ASSERT_EQ(1u, boards.size());
  EXPECT_FALSE(boards[0].size_certain);
  expectConsistent(boards[0]);
}

TEST(Checkerboards, hiddenRimsHaveNoCertainSize)
{
  const cv::Matx33d truth = omr::test::boardHomography(7, 9, {300, 220}, 30, 0);
  Render render({600, 440});
  render.addBoard(7, 9, truth);
  // Hides the last two columns and the margin beside them.
  render.addPolygon({{375, -10}, {610, -10}, {610, 450}, {375, 450}}, cv::Scalar(90, 100, 110));
  const std::vector<Checkerboard> boards = find(render.picture());
  ASSERT_EQ(1u, boards.size());
  EXPECT_FALSE(boards[0].size_certain);
}

TEST(Checkerboards, aLightThingOverTheLastSquaresIsNoMargin)
{
  // White paper over the last columns but for the outermost squares, as if the board ended where it begins.
  const cv::Matx33d truth = omr::test::boardHomography(5, 9, {300, 220}, 30, 0);
  const auto at = [&](double x, double y) { return omr::test::project(truth, x, y); };
  for (const double begin : {5.6, 5.75, 5.9, 6.05, 6.2})
  {
    for (const double slope : {-0.3, -0.15, 0.15})
    {
      Render render({600, 440}, cv::Scalar(90, 140, 170));
      render.addBoard(5, 9, truth);
      render.addPolygon({at(begin, 1), at(10.5, 1 - slope), at(10.5, 4 - slope), at(begin + slope, 4)},
                        cv::Scalar(215, 205, 195));
      const std::vector<Checkerboard> boards = find(render.picture());
      ASSERT_EQ(1u, boards.size());
      EXPECT_TRUE(!boards[0].size_certain || boards[0].cols == 9)
          << boards[0].rows << " x " << boards[0].cols << ", paper from " << begin << ", slope " << slope;
    }
  }
}

TEST(Checkerboards, nothingInPicturesWithoutABoard)
{
  EXPECT_TRUE(find(cv::Mat::zeros(1, 1, CV_8UC3)).empty());
  EXPECT_TRUE(find(cv::Mat::zeros(2, 7, CV_8UC3)).empty());
  EXPECT_TRUE(find(cv::Mat::zeros(16, 16, CV_8UC3)).empty());
  EXPECT_TRUE(find(cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(255))).empty());
  cv::Mat line(1, 200, CV_8UC3);
  for (int x = 0; x < line.cols; ++x)
  {
    line.at<cv::Vec3b>(0, x) = x / 8 % 2 == 0 ? cv::Vec3b(0, 0, 0) : cv::Vec3b(255, 255, 255);
  }
  EXPECT_TRUE(find(line).empty());
  EXPECT_TRUE(find(line.t()).empty());
  cv::Mat noise(240, 320, CV_8UC3);
  cv::RNG random(5);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  EXPECT_TRUE(find(noise).empty());
  Render render({320, 240});  // bricks
  for (int i = 0; i < 20; ++i)
  {
    for (int j = 0; j < 16; ++j)
    {
      const double x = 24. * j - (i % 2) * 12;
      const double y = 12. * i;
      render.addPolygon({{x, y}, {x + 22, y}, {x + 22, y + 10}, {x, y + 10}}, cv::Scalar(60, 70, 150));
    }
  }
  EXPECT_TRUE(find(render.picture()).empty());
}

TEST(Checkerboards, thePlainPatternThatFillsThePictureIsNoBoard)
{
  Render render({400, 300});
  render.addBoard(40, 60, cv::Matx33d(10, 0, -50, 0, 10, -30, 0, 0, 1));
  EXPECT_TRUE(find(render.picture()).empty());
}

TEST(Checkerboards, anUnevenTilingThatFillsThePictureIsNoBoard)
{
  constexpr int NODES = 14;
  constexpr double SQUARE = 40;
  constexpr double UNEVEN = 0.045;  // squares
  Render render({440, 440}, cv::Scalar::all(200));
  cv::RNG random(1);
  std::vector<cv::Point2d> nodes;
  for (int i = 0; i < NODES * NODES; ++i)
  {
    const cv::Point2d even(i % NODES - 0.6, i / NODES - 0.6);
    nodes.push_back(SQUARE * (even + UNEVEN * cv::Point2d(random.gaussian(1), random.gaussian(1))));
  }
  for (int i = 0; i + NODES + 1 < NODES * NODES; ++i)
  {
    if ((i % NODES + i / NODES) % 2 == 0 && i % NODES + 1 < NODES)
    {
      render.addPolygon({nodes[i], nodes[i + 1], nodes[i + NODES + 1], nodes[i + NODES]}, cv::Scalar::all(40));
    }
  }
  EXPECT_TRUE(find(render.picture()).empty());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
