#include <gtest/gtest.h>

#include "checkerboards/corners/corner_look.h"
#include "checkerboards/corners/rim_look.h"
#include "render.h"

using omr::CornerLook;
using omr::CornerLooker;
using omr::CornerQuery;
using omr::Frame;
using omr::LocalFrame;
using omr::RimLook;
using omr::test::Render;

namespace
{
constexpr int BUDGET = 100;

cv::Matx33d upright(double square)
{
  return {square, 0, 50.3, 0, square, 40.7, 0, 0, 1};
}

LocalFrame frameAt(const cv::Matx33d& board, double col, double row)
{
  const cv::Point2f node = omr::test::project(board, col, row);
  const cv::Point2f right = omr::test::project(board, col + 1, row);
  const cv::Point2f below = omr::test::project(board, col, row + 1);
  return {node, right - node, below - node};
}
}  // namespace

TEST(CornerLook, findsTheCornerOfFourSquaresAtEverySize)
{
  for (const double square : {3.5, 6., 12., 24., 50.})
  {
    Render render({500, 400});
    render.addBoard(5, 7, upright(square));
    const Frame frame = omr::makeFrame(render.picture());
    CornerLooker looker(frame, BUDGET);
    const LocalFrame truth = frameAt(upright(square), 3, 2);
    LocalFrame predicted = truth;
    predicted.node = truth.at(0.1F, -0.12F);
    const CornerLook look = looker.look(predicted, CornerQuery());
    ASSERT_TRUE(look.found) << square;
    EXPECT_NEAR(0, cv::norm(look.position - truth.node), 0.25) << square;
    EXPECT_EQ(1, look.sign) << square;
    EXPECT_GT(look.correlation, 0.9F) << square;
  }
}

TEST(CornerLook, theSignSaysWhichSquaresAreLight)
{
  Render render({300, 300});
  render.addBoard(5, 7, upright(20));
  const Frame frame = omr::makeFrame(render.picture());
  CornerLooker looker(frame, BUDGET);
  const LocalFrame even = frameAt(upright(20), 2, 2);  // beside it, towards +u +v, lies the black square (2, 2)
  const LocalFrame odd = frameAt(upright(20), 3, 2);
  CornerQuery query;
  EXPECT_EQ(-1, looker.look(even, query).sign);
  EXPECT_EQ(1, looker.look(odd, query).sign);
  query.sign = 1;
  EXPECT_FALSE(looker.look(even, query).found);
  query.sign = -1;
  EXPECT_TRUE(looker.look(even, query).found);
}

TEST(CornerLook, theEdgeOfAHardShadowIsNoObstacleAndNoCorner)
{
  Render render({300, 300});
  render.addBoard(5, 7, upright(24));
  render.addShadow({{120, -10}, {400, -10}, {400, 310}, {90, 310}}, 0.2);
  const Frame frame = omr::makeFrame(render.picture());
  CornerLooker looker(frame, BUDGET);
  int found = 0;
  for (int col = 1; col < 7; ++col)
  {
    const CornerLook look = looker.look(frameAt(upright(24), col, 2), CornerQuery());
    found += look.found ? 1 : 0;
  }
  EXPECT_GE(found, 5);
  // In the middle of a square that the shadow crosses there is none.
  LocalFrame middle = frameAt(upright(24), 2, 1);
  middle.node = middle.at(0.5F, 0.5F);
  EXPECT_FALSE(looker.look(middle, CornerQuery()).found);
}

TEST(CornerLook, theRimTellsOuterFromInnerCorners)
{
  Render render({300, 300});
  render.addBoard(5, 7, upright(20));
  const Frame frame = omr::makeFrame(render.picture());
  const auto look = [&](double col, double row, int dark_u, int dark_v) {
    return lookAtRim(frame, {frameAt(upright(20), col, row), dark_u, dark_v, true}, 100);
  };
  // (3, 5) lies on the lower border; the black square (2, 4) is towards -u, -v.
  EXPECT_EQ(RimLook::outer_corner, look(3, 5, -1, -1));
  EXPECT_EQ(RimLook::inner_corner, look(3, 4, 1, -1));
  EXPECT_EQ(RimLook::unclear, look(3, 5, 1, -1));
  EXPECT_EQ(RimLook::unclear, look(500, 500, 1, -1));
}

TEST(CornerLook, aColouredThingOverTheRimIsNoMargin)
{
  Render render({300, 300});
  render.addBoard(5, 7, upright(20));
  const omr::RimPlace place{frameAt(upright(20), 3, 5), -1, -1, true};
  render.addPolygon({{0, 141}, {300, 141}, {300, 200}, {0, 200}}, cv::Scalar(90, 240, 230));
  const Frame frame = omr::makeFrame(render.picture());
  EXPECT_NE(RimLook::outer_corner, lookAtRim(frame, place, 100));
}

TEST(CornerLook, neverBeyondTheBudgetOrThePicture)
{
  Render render({300, 300});
  render.addBoard(5, 7, upright(20));
  const Frame frame = omr::makeFrame(render.picture());
  CornerLooker looker(frame, 1);
  EXPECT_TRUE(looker.look(frameAt(upright(20), 2, 2), CornerQuery()).found);
  EXPECT_EQ(0, looker.looksLeft());
  EXPECT_FALSE(looker.look(frameAt(upright(20), 2, 2), CornerQuery()).found);
  CornerLooker other(frame, BUDGET);
  EXPECT_FALSE(other.look(frameAt(upright(20), -5, 2), CornerQuery()).found);
  EXPECT_FALSE(other.look(LocalFrame{{100, 100}, {5, 5}, {5, 5}}, CornerQuery()).found);  // no area
  EXPECT_FALSE(other.look(LocalFrame{{100, 100}, {0, 0}, {0, 0}}, CornerQuery()).found);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
