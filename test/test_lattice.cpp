#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "checkerboards/lattice/lattice.h"
#include "checkerboards/lattice/lattice_evidence.h"
#include "checkerboards/lattice/lattice_extent.h"
#include "checkerboards/lattice/lattice_gaps.h"
#include "checkerboards/lattice/lattice_growth.h"
#include "checkerboards/lattice/lattice_model.h"
#include "checkerboards/lattice/lattice_prediction.h"
#include "lattices.h"
#include "render.h"

using omr::CornerLook;
using omr::CornerLooker;
using omr::Frame;
using omr::Lattice;
using omr::LocalFrame;
using omr::SideEvidence;
using omr::test::grow;
using omr::test::latticeOf;
using omr::test::Render;

namespace
{
constexpr int BUDGET = 10000;

LocalFrame frameAt(const cv::Matx33d& board, double col, double row)
{
  const cv::Point2f node = omr::test::project(board, col, row);
  const cv::Point2f right = omr::test::project(board, col + 1, row);
  const cv::Point2f below = omr::test::project(board, col, row + 1);
  return {node, right - node, below - node};
}

}  // namespace

TEST(Lattice, aNewStartForgetsAllOfTheLast)
{
  Lattice lattice;
  CornerLook corner;
  corner.sign = 1;
  lattice.start({}, corner);
  lattice.put(6, 40, corner);
  lattice.at(45, 9).looks = 3;
  lattice.at(30, 30).weight = .5F;
  lattice.start({}, corner);
  for (int row = 0; row < Lattice::SIZE; ++row)
  {
    for (int col = 0; col < Lattice::SIZE; ++col)
    {
      const omr::LatticeNode& node = std::as_const(lattice).at(row, col);
      EXPECT_EQ(row == Lattice::SEED && col == Lattice::SEED, node.found);
      EXPECT_EQ(0, node.looks);
      EXPECT_EQ(1, node.weight);
    }
  }
}

TEST(Lattice, growsToTheWholeBoardFromAnyCorner)
{
  const cv::Matx33d board = omr::test::boardHomography(5, 7, {200, 150}, 25, 35, 40);
  Render render({400, 300});
  render.addBoard(5, 7, board);
  const Frame frame = omr::makeFrame(render.picture());
  for (const cv::Point& start : {cv::Point(1, 1), cv::Point(6, 4), cv::Point(3, 2)})
  {
    CornerLooker looker(frame, BUDGET);
    Lattice lattice = grow(looker, frameAt(board, start.x, start.y));
    const auto sides = settleExtent(lattice, looker);
    EXPECT_EQ(24, lattice.count());
    EXPECT_EQ(cv::Size(6, 4), lattice.box.size());
    for (const SideEvidence side : sides)
    {
      EXPECT_EQ(SideEvidence::border, side);
    }
  }
}

TEST(Lattice, jumpsOverWhatHidesSquaresButNotOverTheMarginToTheNextBoard)
{
  const cv::Matx33d board(25, 0, 60, 0, 25, 60, 0, 0, 1);
  Render render({700, 300});
  render.addBoard(5, 9, board);
  render.addPolygon({{160, 0}, {195, 0}, {195, 300}, {160, 300}}, cv::Scalar(60, 110, 90));
  // The next board continues the lattice after a margin of two squares, alike in size and phase.
  render.addBoard(5, 7, cv::Matx33d(25, 0, 60 + 11 * 25, 0, 25, 60, 0, 0, 1), false);
  const Frame frame = omr::makeFrame(render.picture());
  CornerLooker looker(frame, BUDGET);
  Lattice lattice = grow(looker, frameAt(board, 2, 2));
  const int before = lattice.count();
  jumpGaps(lattice, looker);
  EXPECT_GT(lattice.count(), before + 8);
  settleExtent(lattice, looker);
  EXPECT_EQ(cv::Size(8, 4), lattice.box.size());
}

TEST(Lattice, predictsAlongALineAndAcrossACurvedPlate)
{
  const auto curved = [](int col, int row) {
    return cv::Point2f(static_cast<float>(100 + 80 * std::sin(0.15 * col)), static_cast<float>(100 + 20 * row));
  };
  const Lattice lattice = latticeOf(5, 5, curved);
  LocalFrame predicted;
  ASSERT_TRUE(predictNode(lattice, Lattice::SEED + 2, Lattice::SEED + 5, 3, predicted));
  EXPECT_NEAR(0, cv::norm(predicted.node - curved(5, 2)), 1.0);  // of a step of 9 px
  const Lattice line = latticeOf(1, 3, curved);
  ASSERT_TRUE(predictNode(line, Lattice::SEED, Lattice::SEED + 3, 3, predicted));
  EXPECT_NEAR(0, cv::norm(predicted.node - curved(3, 0)), 4.0);
  EXPECT_FALSE(predictNode(line, Lattice::SEED, Lattice::SEED + 9, 3, predicted));  // nothing near
}

TEST(Lattice, unevennessIsOfClutterNotOfPerspectiveOrCurvature)
{
  const auto perspective = [](int col, int row) {
    const float w = 1 + 0.05F * static_cast<float>(col);
    return cv::Point2f(100 + 30 * static_cast<float>(col) / w, 100 + 30 * static_cast<float>(row) / w);
  };
  cv::RNG random(3);
  const auto clutter = [&](int col, int row) {
    return cv::Point2f(100 + 20 * static_cast<float>(col) + random.uniform(-4.F, 4.F),
                       100 + 20 * static_cast<float>(row) + random.uniform(-4.F, 4.F));
  };
  EXPECT_LT(latticeEvidence(latticeOf(6, 6, perspective)).unevenness, 0.02);
  EXPECT_GT(latticeEvidence(latticeOf(6, 6, clutter)).unevenness, 0.2);
}

TEST(Lattice, cornersThatTellNothingOfEvennessAreNotEven)
{
  const auto even = [](int col, int row) {
    return cv::Point2f(20.F * static_cast<float>(col), 20.F * static_cast<float>(row));
  };
  EXPECT_GT(latticeEvidence(latticeOf(2, 2, even)).doubt(), 1e6F);
  EXPECT_LT(latticeEvidence(latticeOf(2, 3, even)).doubt(), 0.01F);
}

TEST(Lattice, theModelTellsCornersThatDoNotFit)
{
  const auto flat = [](int col, int row) {
    const cv::Point2f node(100 + 20 * static_cast<float>(col), 100 + 20 * static_cast<float>(row));
    return col == 3 && row == 2 ? node + cv::Point2f(3, 0) : node;
  };
  Lattice lattice = latticeOf(6, 7, flat);
  dropOutliers(lattice);
  EXPECT_EQ(41, lattice.count());
  EXPECT_FALSE(lattice.found(Lattice::SEED + 2, Lattice::SEED + 3));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
