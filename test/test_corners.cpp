#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "outdoor_omr/corner_look.h"
#include "outdoor_omr/corners.h"
#include "outdoor_omr/lattice_growth.h"
#include "render.h"

using omr::CornerLooker;
using omr::CornerQuery;
using omr::Frame;
using omr::Lattice;
using omr::LocalFrame;
using omr::test::Render;

namespace
{
LocalFrame frameAt(const cv::Matx33d& board, double col, double row)
{
  const cv::Point2f node = omr::test::project(board, col, row);
  const cv::Point2f right = omr::test::project(board, col + 1, row);
  const cv::Point2f below = omr::test::project(board, col, row + 1);
  return {node, right - node, below - node};
}

Lattice grow(const Frame& frame, const LocalFrame& seed)
{
  CornerLooker looker(frame, 1000);
  Lattice lattice;
  lattice.start(seed, looker.look(seed, CornerQuery()));
  growLattice(lattice, looker, Lattice::SIZE * Lattice::SIZE);
  return lattice;
}

/** Root mean square distance of the lattice's nodes to the truth [px]. */
double rmsOf(const Lattice& lattice, const cv::Matx33d& board)
{
  double sum = 0;
  for (int i = 0; i < lattice.box.height; ++i)
  {
    for (int j = 0; j < lattice.box.width; ++j)
    {
      const cv::Point2f truth = omr::test::project(board, j + 1, i + 1);
      const cv::Point2f error = lattice.at(lattice.box.y + i, lattice.box.x + j).position - truth;
      sum += error.dot(error);
    }
  }
  return std::sqrt(sum / lattice.box.area());
}
}  // namespace

TEST(Corners, areAccurateToAFewHundredthsOfAPixel)
{
  for (const double square : {6., 12., 30., 60.})
  {
    const cv::Matx33d board = omr::test::boardHomography(5, 7, {300.2, 220.7}, square, 17, 30);
    Render render({600, 440});
    render.addBoard(5, 7, board);
    const Frame frame = omr::makeFrame(render.picture(0.7, 2));
    Lattice lattice = grow(frame, frameAt(board, 3, 2));
    ASSERT_EQ(cv::Size(6, 4), lattice.box.size()) << square;
    const std::vector<bool> seen = refineCorners(frame, lattice);
    EXPECT_EQ(24, std::count(seen.begin(), seen.end(), true)) << square;
    EXPECT_LT(rmsOf(lattice, board), 0.1) << square;
  }
}

TEST(Corners, aHiddenCornerGetsItsForecastAndTheFlag)
{
  const cv::Matx33d board = omr::test::boardHomography(5, 7, {200, 150}, 25, 10, 0);
  Render render({400, 300});
  render.addBoard(5, 7, board);
  const cv::Point2d hidden = omr::test::project(board, 3, 2);
  render.addCircle(hidden, 9, cv::Matx33d::eye(), cv::Scalar(40, 90, 70));
  const Frame frame = omr::makeFrame(render.picture());
  Lattice lattice = grow(frame, frameAt(board, 1, 1));
  ASSERT_EQ(cv::Size(6, 4), lattice.box.size());
  const std::vector<bool> seen = refineCorners(frame, lattice);
  ASSERT_EQ(24u, seen.size());
  EXPECT_FALSE(seen[1 * 6 + 2]);
  EXPECT_EQ(23, std::count(seen.begin(), seen.end(), true));
  const cv::Point2f error = lattice.at(lattice.box.y + 1, lattice.box.x + 2).position - cv::Point2f(hidden);
  EXPECT_LT(cv::norm(error), 0.15);
}

TEST(Corners, refinementStaysPutWithoutGradientAndAtThePicturesEdge)
{
  const cv::Mat flat(60, 60, CV_8UC1, cv::Scalar(90));
  const LocalFrame inside{{30.25F, 30.5F}, {12, 0}, {0, 12}};
  EXPECT_EQ(inside.node, omr::refineCorner(flat, inside));
  const LocalFrame edge{{1, 59}, {12, 0}, {0, 12}};
  EXPECT_EQ(edge.node, omr::refineCorner(flat, edge));
  const LocalFrame outside{{-40, 900}, {12, 0}, {0, 12}};
  EXPECT_EQ(outside.node, omr::refineCorner(flat, outside));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
