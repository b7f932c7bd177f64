#include <gtest/gtest.h>

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "checkerboards/checkerboards.h"
#include "checkerboards/lattice/lattice_seam.h"
#include "checkerboards/lattice/lattice_strip.h"
#include "lattices.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

using omr::Checkerboard;
using omr::test::Render;

namespace
{
std::vector<Checkerboard> find(const Render& render)
{
  const cv::Mat picture = render.picture();
  omr::RegionMap map;
  omr::FillPipeline("reference").run(picture, omr::Settings(), {}, map);
  return omr::findCheckerboards(omr::makeFrame(picture), map, omr::Settings());
}

void addRectangle(Render& render, const cv::Matx33d& place, const cv::Rect2d& squares, double grey)
{
  const auto at = [&](double x, double y) { return omr::test::project(place, x, y); };
  const cv::Point2d first = squares.tl();
  const cv::Point2d last = squares.br();
  render.addPolygon({at(first.x, first.y), at(last.x, first.y), at(last.x, last.y), at(first.x, last.y)},
                    cv::Scalar::all(grey));
}

/** Two boards of 7 x 9 whose squares alternate on beyond the gap. @param gap, shift [squares]. */
std::vector<Checkerboard> findPair(double square, double gap, double ground, double margin = 0, double shift = 0)
{
  constexpr int ROWS = 7;
  constexpr int COLS = 9;
  Render render(cv::Size(cvRound(28 * square), cvRound(14 * square)), cv::Scalar::all(ground));
  const cv::Matx33d place = omr::test::boardHomography(ROWS, 2 * COLS, {14 * square, 7 * square}, square, 2, 15);
  const cv::Matx33d beside(1, 0, COLS + gap, 0, 1, shift, 0, 0, 1);
  render.addBoard(ROWS, COLS, place, true, margin);
  render.addBoard(ROWS, COLS, place * beside, (COLS + cvRound(gap)) % 2 == 0, margin);
  return find(render);
}

void expectTwo(const std::vector<Checkerboard>& boards, const std::string& what)
{
  EXPECT_EQ(2u, boards.size()) << what;
  for (const Checkerboard& board : boards)
  {
    EXPECT_EQ(7, board.rows) << what;
    EXPECT_EQ(9, board.cols) << what;
  }
}
}  // namespace

TEST(JoinedBoards, aGapOfWholeSquaresPartsThem)
{
  for (const double ground : {20., 70., 120.})
  {
    for (const double gap : {0.9, 1., 2., 3.})
    {
      expectTwo(findPair(22, gap, ground), "gap " + std::to_string(gap) + ", ground " + std::to_string(ground));
    }
  }
}

TEST(JoinedBoards, aGapOfWholeSquaresPartsThemWhereMarginsAreNarrow)
{
  for (const double ground : {20., 70., 120.})
  {
    for (const double margin : {0.05, 0.1, 0.2})
    {
      for (const double shift : {0., 0.05})
      {
        expectTwo(findPair(16, 1.05, ground, margin, shift), "ground " + std::to_string(ground) + ", margin " +
                                                                 std::to_string(margin) + ", shift " +
                                                                 std::to_string(shift));
      }
    }
  }
}

TEST(JoinedBoards, aGapOfAFractionOfASquarePartsThem)
{
  for (const double gap : {0.1, 0.25, 0.4})
  {
    for (const double margin : {0., gap / 2})
    {
      for (const double shift : {0., 0.3})
      {
        expectTwo(
            findPair(24, gap, 120, margin, shift),
            "gap " + std::to_string(gap) + ", margin " + std::to_string(margin) + ", shift " + std::to_string(shift));
      }
    }
  }
}

TEST(JoinedBoards, aBandHidesTwoLinesOfCornersAsAGapDoes)
{
  const cv::Matx33d place = omr::test::boardHomography(7, 10, {300, 220}, 30, 5);
  for (const double width : {1., 1.9})
  {
    Render render({600, 440});
    render.addBoard(7, 10, place);
    addRectangle(render, place, {4.6, -2, width, 11}, 100);
    const std::vector<Checkerboard> boards = find(render);
    ASSERT_EQ(1u, boards.size()) << width;
    EXPECT_EQ(10, boards[0].cols) << width;
    EXPECT_EQ(width < 1.5, boards[0].size_certain) << width;
  }
}

TEST(CoveredBoards, aBandAlongTheSquaresPartsNoBoardThatHasAMargin)
{
  const cv::Matx33d place = omr::test::boardHomography(7, 10, {300, 220}, 30, 5);
  for (const double position : {3.95, 4., 5.})
  {
    Render render({600, 440});
    render.addBoard(7, 10, place);
    addRectangle(render, place, {position, -2, 1.05, 11}, 100);
    const std::vector<Checkerboard> boards = find(render);
    ASSERT_EQ(1u, boards.size()) << position;
    EXPECT_EQ(10, boards[0].cols) << position;
    EXPECT_FALSE(boards[0].size_certain) << position;
  }
}

/** A thing over a board that ends squares along its lines. */
TEST(CoveredBoards, aLabelEndsNoBoard)
{
  const cv::Matx33d wide = omr::test::boardHomography(9, 12, {300, 240}, 30, 3, 10);
  const cv::Matx33d long_one = omr::test::boardHomography(9, 14, {300, 240}, 28, 0);
  Render half({600, 480}, cv::Scalar::all(90));
  half.addBoard(9, 12, wide);
  addRectangle(half, wide, {6, 1, 8, 7}, 215);
  Render middle({600, 480}, cv::Scalar::all(90));
  middle.addBoard(9, 14, long_one);
  addRectangle(middle, long_one, {6, 1, 3, 7}, 215);
  for (const Render& render : {half, middle})
  {
    const std::vector<Checkerboard> boards = find(render);
    EXPECT_FALSE(boards.empty());
    for (const Checkerboard& board : boards)
    {
      EXPECT_TRUE(!board.size_certain || board.cols > 9) << board.rows << " x " << board.cols;
    }
  }
}

TEST(CoveredBoards, theWindowOfAMatIsNoMargin)
{
  const cv::Matx33d place = omr::test::boardHomography(13, 16, {300, 240}, 26, 0);
  for (const double grey : {70., 120.})
  {
    Render render({600, 480});
    render.addBoard(13, 16, place);
    addRectangle(render, place, {-3, -3, 22, 6}, grey);
    addRectangle(render, place, {-3, 10, 22, 6}, grey);
    addRectangle(render, place, {-3, -3, 6, 19}, grey);
    addRectangle(render, place, {12, -3, 7, 19}, grey);
    const std::vector<Checkerboard> boards = find(render);
    ASSERT_EQ(1u, boards.size()) << grey;
    EXPECT_EQ(7, boards[0].rows) << grey;
    EXPECT_FALSE(boards[0].size_certain) << grey;
  }
}

TEST(LatticeStrip, endsABoardWhereTheSquaresAcrossItAreNoWholeOnes)
{
  // Two lines of corners are hidden between columns 5 and 8; what lies beyond is displaced [squares].
  const auto columns_left = [](const std::array<double, 5>& jumps) {
    omr::Lattice lattice = omr::test::latticeOf(5, 14, [&](int col, int row) {
      return cv::Point2f(static_cast<float>(50 + 20 * (col + (col > 6 ? jumps[row] : 0))),
                         static_cast<float>(50 + 20 * row));
    });
    for (int row = 0; row < 5; ++row)
    {
      lattice.remove(lattice.box.y + row, lattice.box.x + 6);
      lattice.remove(lattice.box.y + row, lattice.box.x + 7);
    }
    omr::splitAtStrips(lattice, omr::makeFrame(cv::Mat(200, 400, CV_8UC3, cv::Scalar::all(128))));
    return lattice.box.width;
  };
  EXPECT_EQ(6, columns_left({0.4, 0.4, 0.42, 0.4, 0.39}));
  EXPECT_EQ(14, columns_left({0.1, 0.1, 0.1, 0.1, 0.1}));
  EXPECT_EQ(14, columns_left({0.4, 0.1, 0.8, 0.2, 0.6})) << "the lines disagree";
}

TEST(LatticeSeam, isWhereAllLinesJumpAlike)
{
  // By how much the corners of each row lie beside their places, on one half of the lattice [squares].
  const auto has_seam = [](const std::array<double, 5>& jumps) {
    return omr::hasSeam(omr::test::latticeOf(5, 13, [&](int col, int row) {
      return cv::Point2f(static_cast<float>(20 * (col + (col > 6 ? jumps[row] : 0))), static_cast<float>(20 * row));
    }));
  };
  EXPECT_TRUE(has_seam({0.12, 0.12, 0.12, 0.12, 0.12}));
  EXPECT_TRUE(has_seam({0.12, 0.11, 0.12, 0.13, 0.12}));
  EXPECT_FALSE(has_seam({0.12, 0.35, -0.2, 0.13, -0.1}));
  EXPECT_FALSE(has_seam({0, 0, 0, 0, 0}));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
