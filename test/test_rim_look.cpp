#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "checkerboards/corners/rim_look.h"
#include "render.h"

using omr::Frame;
using omr::RimLook;
using omr::RimPlace;
using omr::test::Render;

namespace
{
constexpr int ROWS = 5;
constexpr int COLS = 7;
constexpr float CONTRAST = 150;  // grey levels

cv::Matx33d board()
{
  return omr::test::boardHomography(ROWS, COLS, {200, 150}, 30, 10, 30);
}

Frame frameOf(const Render& render)
{
  return omr::makeFrame(render.picture());
}

Render drawBoard(double margin = 1)
{
  Render render({400, 300}, cv::Scalar::all(60));
  render.addBoard(ROWS, COLS, board(), true, margin);
  return render;
}

/** A place on the line of the given row, as if the board ended there; its dark square lies to the right or left. */
RimPlace placeAt(int row, int col)
{
  RimPlace place;
  place.predicted.node = omr::test::project(board(), col, row);
  place.predicted.u = cv::Point2f(omr::test::project(board(), col + 1, row)) - place.predicted.node;
  place.predicted.v = cv::Point2f(omr::test::project(board(), col, row + 1)) - place.predicted.node;
  place.dark_u = (row - 1 + col) % 2 == 0 ? 1 : -1;
  place.dark_v = -1;
  return place;
}
}  // namespace

TEST(RimLook, outerCornersWhereTheBoardEnds)
{
  const Frame frame = frameOf(drawBoard());
  for (int col = 1; col < COLS; ++col)
  {
    EXPECT_EQ(RimLook::outer_corner, omr::lookAtRim(frame, placeAt(ROWS, col), CONTRAST)) << col;
    EXPECT_EQ(RimLook::inner_corner, omr::lookAtRim(frame, placeAt(ROWS - 1, col), CONTRAST)) << col;
  }
}

TEST(RimLook, aLightSquareOfTheRimIsFollowedByTheMargin)
{
  const Frame frame = frameOf(drawBoard());
  for (int col = 1; col < COLS; ++col)
  {
    EXPECT_TRUE(omr::marginFollows(frame, placeAt(ROWS, col))) << col;
    EXPECT_FALSE(omr::marginFollows(frame, placeAt(ROWS - 1, col))) << "a dark square follows, column " << col;
  }
}

TEST(RimLook, noMarginUnderWhatHidesItNorWithoutOne)
{
  Render hidden = drawBoard();
  const auto at = [](double col, double row) { return omr::test::project(board(), col, row); };
  hidden.addPolygon({at(-1, 4.7), at(8, 4.7), at(8, 6.5), at(-1, 6.5)}, cv::Scalar(60, 160, 200));
  const Frame frame = frameOf(hidden);
  const Frame narrow = frameOf(drawBoard(0.2));
  for (int col = 1; col < COLS; ++col)
  {
    EXPECT_FALSE(omr::marginFollows(frame, placeAt(ROWS, col))) << col;
    EXPECT_NE(RimLook::outer_corner, omr::lookAtRim(frame, placeAt(ROWS, col), CONTRAST)) << col;
    EXPECT_FALSE(omr::marginFollows(narrow, placeAt(ROWS, col))) << col;
  }
}

TEST(RimLook, outsideThePictureNothingIsClear)
{
  const Frame frame = frameOf(drawBoard());
  RimPlace place = placeAt(ROWS, 2);
  place.predicted.node = {-50, 20};
  EXPECT_EQ(RimLook::unclear, omr::lookAtRim(frame, place, CONTRAST));
  EXPECT_FALSE(omr::marginFollows(frame, place));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
