#include "checkerboards/lattice/edge_line.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "checkerboards/judgement/board_judgement.h"
#include "checkerboards/judgement/edge_reading.h"
#include "checkerboards/lattice/edge_growth.h"
#include "lattices.h"
#include "render.h"

using omr::Frame;
using omr::Lattice;
using omr::LocalFrame;
using omr::test::Render;

namespace
{
constexpr int ROWS = 7;
constexpr int COLS = 8;
constexpr double SQUARE = 30;  // px

const cv::Matx33d& place()
{
  static const cv::Matx33d PLACE = omr::test::boardHomography(ROWS, COLS, {200, 170}, SQUARE, 8);
  return PLACE;
}

cv::Point2f at(double x, double y)
{
  return cv::Point2f(omr::test::project(place(), x, y));
}

LocalFrame frameAt(int x, int y)
{
  return {at(x, y), at(x + 1, y) - at(x, y), at(x, y + 1) - at(x, y)};
}

/** Shadow of bars across the rows of squares. @param from, to rows where a bar begins and ends. */
void addBar(Render& render, double from, double to)
{
  const auto corner = [](double x, double y) { return cv::Point2d(at(x, y)); };
  render.addShadow({corner(-2, from), corner(COLS + 2, from), corner(COLS + 2, to), corner(-2, to)}, 0.3);
}

/** The inner corners of the first rows. */
Lattice firstRows(int rows)
{
  return omr::test::latticeOf(
      rows, COLS - 1, [](int col, int row) { return at(col + 1, row + 1); }, -1);
}
}  // namespace

using Sides = std::array<omr::SideEvidence, 4>;

TEST(EdgeLine, aRimIsNoneWhereSquaresGoOnBelowAShadow)
{
  Render render({400, 340});
  render.addBoard(ROWS, COLS, place());
  addBar(render, 4.6, 5.5);  // over the corners of the line that the lattice lacks
  const Frame frame = omr::makeFrame(render.picture(0.8));
  constexpr auto RIM = omr::SideEvidence::rim;
  Sides sides = {RIM, RIM, RIM, RIM};
  omr::settleRims(frame, firstRows(ROWS - 3), sides);
  EXPECT_EQ((Sides{RIM, RIM, omr::SideEvidence::none, RIM}), sides);
  sides[omr::bottom] = omr::SideEvidence::border;
  omr::settleRims(frame, firstRows(ROWS - 3), sides);
  EXPECT_EQ(omr::SideEvidence::border, sides[omr::bottom]) << "what corners settle is not asked";
  sides[omr::bottom] = RIM;
  omr::settleRims(frame, firstRows(ROWS - 1), sides);
  EXPECT_EQ(RIM, sides[omr::bottom]);
}

TEST(EdgeLine, aRimIsNoneWhereTheNextSquaresBegin)
{
  constexpr auto RIM = omr::SideEvidence::rim;
  for (const double begin : {0., 0.25})  // squares
  {
    Render render({400, 340});
    render.addBoard(ROWS, COLS, place());
    const auto corner = [](double x, double y) { return cv::Point2d(at(x, y)); };
    const double covered = ROWS - 1 + begin;
    render.addPolygon({corner(-2, covered), corner(COLS + 2, covered), corner(COLS + 2, 9), corner(-2, 9)},
                      cv::Scalar::all(110));
    Sides sides = {RIM, RIM, RIM, RIM};
    omr::settleRims(omr::makeFrame(render.picture(0.8)), firstRows(ROWS - 2), sides);
    EXPECT_EQ(begin > 0 ? omr::SideEvidence::none : RIM, sides[omr::bottom]) << begin;
  }
}

TEST(EdgeLine, aRimIsNoneWhereGlareHidesTheHalfOfItsCorners)
{
  constexpr auto RIM = omr::SideEvidence::rim;
  const auto last_side = [](double light, int hidden) {
    Render render({400, 340});
    render.addBoard(ROWS, COLS, place());
    const auto corner = [](double x, double y) { return cv::Point2d(at(x, y)); };
    render.addPolygon({corner(-2, 4.5), corner(COLS + 2, 4.5), corner(COLS + 2, 9), corner(-2, 9)},
                      cv::Scalar::all(light));
    Lattice lattice = firstRows(ROWS - 3);
    for (int j = 0; j < hidden; ++j)
    {
      lattice.remove(lattice.box.br().y - 1, lattice.box.x + j);
    }
    Sides sides = {RIM, RIM, RIM, RIM};
    omr::settleRims(omr::makeFrame(render.picture(0.8)), lattice, sides);
    return sides[omr::bottom];
  };
  EXPECT_EQ(omr::SideEvidence::none, last_side(255, 4));
  EXPECT_EQ(RIM, last_side(255, 2)) << "most corners show";
  EXPECT_EQ(RIM, last_side(215, 4)) << "as bright as paper";
}

TEST(EdgeLine, aHiddenSideIsARimWhereItsSquaresAreCut)
{
  constexpr double CUT = ROWS - 0.5;
  Render render({400, 340});
  render.addBoard(ROWS, COLS, place());
  const auto corner = [](double x, double y) { return cv::Point2d(at(x, y)); };
  render.addPolygon({corner(-2, CUT), corner(COLS + 2, CUT), corner(COLS + 2, 9), corner(-2, 9)}, cv::Scalar::all(110));
  const Frame frame = omr::makeFrame(render.picture(0.8));
  Sides sides;
  sides.fill(omr::SideEvidence::none);
  omr::settleRims(frame, firstRows(ROWS - 1), sides);
  EXPECT_EQ(omr::SideEvidence::rim, sides[omr::bottom]);
  sides.fill(omr::SideEvidence::none);
  omr::settleRims(frame, firstRows(ROWS - 2), sides);
  EXPECT_EQ(omr::SideEvidence::none, sides[omr::bottom]) << "half a line of squares follows";
}

TEST(EdgeLine, anUnevenLatticeWithoutABorderEndsOnlyWhereSquaresShow)
{
  constexpr double HIDDEN = ROWS - 1 + 0.1;
  Render render({400, 340});
  render.addBoard(ROWS, COLS, place());
  const auto corner = [](double x, double y) { return cv::Point2d(at(x, y)); };
  render.addPolygon({corner(-2, HIDDEN), corner(COLS + 2, HIDDEN), corner(COLS + 2, 9), corner(-2, 9)},
                    cv::Scalar::all(110));
  const Frame frame = omr::makeFrame(render.picture(0.8));
  constexpr auto RIM = omr::SideEvidence::rim;
  Sides sides = {RIM, RIM, RIM, RIM};
  Lattice lattice = firstRows(ROWS - 1);
  omr::settleRims(frame, lattice, sides);
  EXPECT_EQ(RIM, sides[omr::bottom]);
  for (int i = 0; i < ROWS - 1; ++i)
  {
    for (int j = 0; j < COLS - 1; ++j)
    {
      lattice.at(Lattice::SEED + i, Lattice::SEED + j).position.y += (i * j) % 2 == 0 ? 3 : -3;
    }
  }
  Sides uneven = {RIM, RIM, RIM, RIM};
  omr::settleRims(frame, lattice, uneven);
  EXPECT_EQ(omr::SideEvidence::none, uneven[omr::bottom]);
  uneven = {omr::SideEvidence::border, RIM, RIM, RIM};
  omr::settleRims(frame, lattice, uneven);
  EXPECT_EQ(RIM, uneven[omr::bottom]);
}

TEST(EdgeLine, theLastRowOfSquaresIsTheLastWhereAShadowHidesTheBorder)
{
  Render render({400, 340});
  render.addBoard(ROWS, COLS, place());
  addBar(render, ROWS, ROWS + 0.6);  // as dark a line as the rim's own
  const Frame frame = omr::makeFrame(render.picture(0.8));
  const Lattice lattice = firstRows(ROWS - 1);
  omr::LatticeModel model;
  ASSERT_TRUE(omr::fitEdges(lattice, true, model));
  const float ratio = 1.8F;  // of the drawn black and white
  const omr::EdgeLine border = omr::lookAtEdgeLine(frame, model, lattice, omr::bottom, 1, ratio);
  EXPECT_FALSE(border.ends());
  EXPECT_TRUE(border.isLast());
  EXPECT_FALSE(omr::lookAtEdgeLine(frame, model, lattice, omr::bottom, -1, ratio).isLast());
}

TEST(EdgeLine, aLatticeThatGoesOnBelowAThingDoesNotEnd)
{
  Render render({400, 340});
  render.addBoard(ROWS, COLS, place());
  const auto corner = [](double x, double y) { return cv::Point2d(at(x, y)); };
  // Over the squares beyond, not over their corners with those inside.
  render.addPolygon({corner(-2, 5.27), corner(COLS + 2, 5.27), corner(COLS + 2, 9), corner(-2, 9)},
                    cv::Scalar::all(150));
  const Frame frame = omr::makeFrame(render.picture(0.8));
  const Lattice lattice = firstRows(ROWS - 3);
  omr::LatticeModel model;
  ASSERT_TRUE(omr::fitEdges(lattice, true, model));
  const omr::EdgeLine line = omr::lookAtEdgeLine(frame, model, lattice, omr::bottom, 1, 1.8F);
  EXPECT_FALSE(line.ends());
  EXPECT_FALSE(line.isLast());
}

TEST(EdgeLine, aThirdOfItsCornersHoldsTheOutermostLine)
{
  std::array<omr::SideEvidence, 4> sides;
  sides.fill(omr::SideEvidence::doubtful_border);
  Lattice lattice = firstRows(ROWS - 1);
  for (int i = 2; i < ROWS - 1; ++i)
  {
    lattice.remove(Lattice::SEED + i, Lattice::SEED);
  }
  EXPECT_TRUE(omr::isBoardOfEdges(lattice, sides));
  lattice.remove(Lattice::SEED, Lattice::SEED);
  EXPECT_FALSE(omr::isBoardOfEdges(lattice, sides));
}

TEST(EdgeGrowth, growsWhereRingsDoNot)
{
  Render render({400, 340});
  render.addBoard(ROWS, COLS, place());
  for (int i = 0; i < 8; ++i)
  {
    addBar(render, 0.85 + i, 1.3 + i);
  }
  const Frame frame = omr::makeFrame(render.picture(0.8));
  Lattice lattice;
  EXPECT_TRUE(omr::growByEdges(frame, frameAt(3, 3), lattice));
  EXPECT_GE(lattice.count(), 12);
}

// In a deep shadow of narrow bars too few edges around a corner are alike by themselves: 4 of these 35.
TEST(EdgeGrowth, theRatioOfTheFirstCornerHelpsItsNeighbours)
{
  constexpr double SLOPE = 3;  // rows of squares from one end of a bar to the other
  const auto corner = [](double x, double y) { return cv::Point2d(at(x, y)); };
  int grown = 0;
  for (const auto& [period, width] : {std::pair{0.45, 0.315}, {0.6, 0.3}, {0.6, 0.42}, {0.8, 0.24}, {0.8, 0.4}})
  {
    Render render({400, 340});
    render.addBoard(ROWS, COLS, place());
    for (int i = -34; i < 54; ++i)
    {
      const double from = period * i;
      const double to = from + width;
      render.addShadow({corner(-2, from), corner(COLS + 2, from + SLOPE), corner(COLS + 2, to + SLOPE), corner(-2, to)},
                       0.15);
    }
    const Frame frame = omr::makeFrame(render.picture(0.8));
    for (int x = 1; x < COLS; ++x)
    {
      Lattice lattice;
      grown += omr::growByEdges(frame, frameAt(x, 3), lattice) ? 1 : 0;
    }
  }
  EXPECT_GE(grown, 10);
}

TEST(EdgeReading, cornersAreFittedAsFarAsTheirSurfaceAdmits)
{
  Render render({400, 340});
  render.addBoard(ROWS, COLS, place());
  const cv::Point2d hidden = at(3, 3);
  const double size = SQUARE / 4;
  render.addPolygon({hidden + cv::Point2d(-1, -size), hidden + cv::Point2d(2 * size, -size),
                     hidden + cv::Point2d(2 * size, 2 * size), hidden + cv::Point2d(-1, 2 * size)},
                    cv::Scalar::all(35));
  const Frame frame = omr::makeFrame(render.picture(0.8));
  Lattice lattice = firstRows(ROWS - 1);
  for (int i = 0; i < ROWS - 1; ++i)
  {
    for (int j = 0; j < COLS - 1; ++j)
    {
      lattice.at(Lattice::SEED + i, Lattice::SEED + j).position += cv::Point2f((i + j) % 2 == 0 ? 1.F : -1.F, 0);
    }
  }
  omr::fitReadCorners(frame, lattice);
  for (int i = 0; i < ROWS - 1; ++i)
  {
    for (int j = 0; j < COLS - 1; ++j)
    {
      const double error = cv::norm(lattice.at(Lattice::SEED + i, Lattice::SEED + j).position - at(j + 1, i + 1));
      EXPECT_LT(error, i == 2 && j == 2 ? 3.1 : 0.2) << i << " " << j;
    }
  }
}

TEST(EdgeGrowth, bareGroundHasNoEdges)
{
  const Frame frame = omr::makeFrame(Render({400, 340}).picture(0.8));
  Lattice lattice;
  EXPECT_FALSE(omr::growByEdges(frame, frameAt(3, 3), lattice));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
