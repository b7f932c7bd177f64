#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "checkerboards/corners/corner_fit.h"
#include "checkerboards/corners/corner_look.h"
#include "checkerboards/lattice/corners.h"
#include "checkerboards/lattice/lattice_growth.h"
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

/** How far a sheet that ripples moves a point of the picture [px]. */
cv::Point2f ripple(const cv::Point2f& point, float amplitude)
{
  return amplitude *
         cv::Point2f(std::sin(point.x / 27 + 1) + std::sin(point.y / 24), std::sin((point.x + point.y) / 30));
}

/** The picture of a sheet that ripples. */
cv::Mat rippled(const cv::Mat& picture, float amplitude)
{
  cv::Mat places(picture.size(), CV_32FC2);
  for (int y = 0; y < places.rows; ++y)
  {
    for (int x = 0; x < places.cols; ++x)
    {
      const cv::Point2f here(static_cast<float>(x), static_cast<float>(y));
      places.at<cv::Point2f>(y, x) = here - ripple(here, amplitude);
    }
  }
  cv::Mat result;
  cv::remap(picture, result, places, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return result;
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

TEST(Corners, oneThatTheSearchDidNotFindIsSeenAllTheSame)
{
  const cv::Matx33d board = omr::test::boardHomography(5, 7, {200, 150}, 25, 10, 0);
  Render render({400, 300});
  render.addBoard(5, 7, board);
  const Frame frame = omr::makeFrame(render.picture());
  Lattice lattice = grow(frame, frameAt(board, 1, 1));
  ASSERT_EQ(24, lattice.count());
  lattice.remove(lattice.box.y + 1, lattice.box.x + 2);
  const std::vector<bool> seen = refineCorners(frame, lattice);
  EXPECT_EQ(24, std::count(seen.begin(), seen.end(), true));
}

TEST(Corners, ofTooFewForASurfaceEachIsWhereItsPictureHasIt)
{
  const cv::Matx33d board = omr::test::boardHomography(5, 7, {200, 150}, 25, 10, 0);
  Render render({400, 300});
  render.addBoard(5, 7, board);
  const Frame frame = omr::makeFrame(render.picture());
  CornerLooker looker(frame, 1000);
  Lattice lattice;
  lattice.start(frameAt(board, 3, 2), looker.look(frameAt(board, 3, 2), CornerQuery()));
  growLattice(lattice, looker, 2);
  ASSERT_LT(lattice.count(), 6);
  const int count = lattice.count();
  const std::vector<bool> seen = refineCorners(frame, lattice);
  ASSERT_EQ(lattice.box.area(), static_cast<int>(seen.size()));
  EXPECT_EQ(count, std::count(seen.begin(), seen.end(), true));
  const cv::Point2d truth = omr::test::project(board, 3, 2);
  EXPECT_LT(cv::norm(cv::Point2d(lattice.at(Lattice::SEED, Lattice::SEED).position) - truth), 0.1);
}

TEST(Corners, whatCoversAPartOfOneBendsNone)
{
  const cv::Matx33d board = omr::test::boardHomography(7, 9, {200, 150}, 12, 10, 20);
  Render render({400, 300});
  render.addBoard(7, 9, board);
  // Its edge lies a third of a square beside the corners of one column.
  const auto at = [&](double col, double row) { return omr::test::project(board, col, row); };
  render.addPolygon({at(5.7, -0.5), at(9.5, -0.5), at(9.5, 3.6), at(5.7, 3.6)}, cv::Scalar(50, 80, 110));
  double sum = 0;
  int count = 0;
  for (int seed = 0; seed < 10; ++seed)
  {
    const Frame frame = omr::makeFrame(render.picture(0.7, 2, seed));
    Lattice lattice = grow(frame, frameAt(board, 3, 3));
    ASSERT_EQ(cv::Size(8, 6), lattice.box.size());
    const std::vector<bool> seen = refineCorners(frame, lattice);
    // Where it covers a third of what is around a corner, the others say where that is.
    EXPECT_EQ(0, std::count(seen.begin() + 3 * 8 + 5, seen.begin() + 4 * 8, true));
    EXPECT_EQ(6 * 8 - 4 * 3, std::count(seen.begin(), seen.end(), true));
    for (int i = 0; i < 6; ++i)
    {
      for (int j = 0; j < 8; ++j)
      {
        const cv::Point2f error =
            lattice.at(lattice.box.y + i, lattice.box.x + j).position - cv::Point2f(at(j + 1, i + 1));
        sum += seen[i * 8 + j] ? error.dot(error) : 0;
        count += seen[i * 8 + j] ? 1 : 0;
      }
    }
  }
  EXPECT_LT(std::sqrt(sum / count), 0.04) << "with equal weights 0.05";
}

TEST(Corners, ofASheetThatRipplesAreWhereItsPictureHasThem)
{
  const cv::Matx33d board = omr::test::boardHomography(7, 10, {300, 220}, 30, 3, 0);
  Render render({600, 440});
  render.addBoard(7, 10, board);
  for (const float amplitude : {0.3F, 0.6F, 0.9F})
  {
    const Frame frame = omr::makeFrame(rippled(render.picture(), amplitude));
    Lattice lattice = grow(frame, frameAt(board, 4, 3));
    ASSERT_EQ(cv::Size(9, 6), lattice.box.size()) << amplitude;
    const std::vector<bool> seen = refineCorners(frame, lattice);
    EXPECT_EQ(54, std::count(seen.begin(), seen.end(), true)) << amplitude;
    double sum = 0;
    for (int i = 0; i < 6; ++i)
    {
      for (int j = 0; j < 9; ++j)
      {
        const cv::Point2f flat = omr::test::project(board, j + 1, i + 1);
        cv::Point2f truth = flat;
        for (int step = 0; step < 20; ++step)
        {
          truth = flat + ripple(truth, amplitude);
        }
        const cv::Point2f error = lattice.at(lattice.box.y + i, lattice.box.x + j).position - truth;
        sum += error.dot(error);
      }
    }
    EXPECT_LT(std::sqrt(sum / 54), 0.11) << amplitude << ": drawn to a smooth surface 0.19, 0.39, 0.58";
  }
}

TEST(CornerFit, findsTheCornerInNoiseBlurAndUnevenLight)
{
  struct Case
  {
    double square, blur, noise, most;
  };
  // Gradients alone (Foerstner) leave 0.15, 0.12, 0.15 and 0.11 px; 0.07 are the renderer's own.
  for (const Case& one : {Case{6, 0.6, 8, 0.1}, {10, 0.6, 4, 0.09}, {20, 1.5, 8, 0.11}, {40, 0.6, 8, 0.1}})
  {
    double sum = 0;
    int count = 0;
    for (int turn = 0; turn < 90; turn += 9)
    {
      const cv::Matx33d board = omr::test::boardHomography(5, 7, {200.3, 200.7}, one.square, turn, 30);
      Render render({400, 400});
      render.addBoard(5, 7, board);
      render.addLightGradient(0.4, 1);
      const cv::Mat picture = render.picture(one.blur, one.noise, turn);
      const cv::Mat grey = omr::makeFrame(picture).raw_grey;
      for (int row = 1; row < 5; ++row)
      {
        for (int col = 1; col < 7; ++col)
        {
          LocalFrame start = frameAt(board, col, row);
          const cv::Point2f truth = start.node;
          start.node += cv::Point2f(0.4F, -0.3F);
          const cv::Point2f error = omr::fitCorner(grey, start).position - truth;
          sum += error.dot(error);
          ++count;
        }
      }
    }
    EXPECT_LT(std::sqrt(sum / count), one.most) << one.square;
  }
}

TEST(CornerFit, whatCoversAPartOfAnEdgeCountsLess)
{
  const cv::Matx33d board = omr::test::boardHomography(5, 7, {200.3, 200.7}, 20, 20, 0);
  struct Case
  {
    double along, most;
  };
  // With equal weights 0.55, 0.41 and 0.15 px.
  for (const Case& one : {Case{0.35, 0.45}, {0.5, 0.3}, {0.65, 0.12}})
  {
    Render render({400, 400});
    render.addBoard(5, 7, board);
    render.addCircle(omr::test::project(board, 3 + one.along, 2.1), 4, cv::Matx33d::eye(), cv::Scalar::all(250));
    const cv::Mat grey = omr::makeFrame(render.picture()).raw_grey;
    const LocalFrame corner = frameAt(board, 3, 2);
    EXPECT_LT(cv::norm(omr::fitCorner(grey, corner).position - corner.node), one.most) << one.along;
  }
}

TEST(CornerFit, staysPutWithoutEdgesAndAtThePicturesRim)
{
  const cv::Mat flat(60, 60, CV_8UC1, cv::Scalar(90));
  const LocalFrame inside{{30.25F, 30.5F}, {12, 0}, {0, 12}};
  EXPECT_EQ(inside.node, omr::fitCorner(flat, inside).position);
  const LocalFrame edge{{1, 59}, {12, 0}, {0, 12}};
  EXPECT_EQ(edge.node, omr::fitCorner(flat, edge).position);
  const LocalFrame outside{{-40, 900}, {12, 0}, {0, 12}};
  EXPECT_EQ(outside.node, omr::fitCorner(flat, outside).position);
  const LocalFrame degenerate{{30, 30}, {12, 0}, {24, 0}};
  EXPECT_EQ(degenerate.node, omr::fitCorner(flat, degenerate).position);
}

TEST(CornerFit, staysPutWhereItWouldLeaveTheCorner)
{
  // An edge alone says nothing of the place along it; another corner is not this one.
  cv::Mat edge(60, 60, CV_8UC1, cv::Scalar(40));
  edge.colRange(30, 60) = 200;
  const LocalFrame on_edge{{29.4F, 30}, {12, 0}, {0, 12}};
  EXPECT_NEAR(omr::fitCorner(edge, on_edge).position.y, 30, 0.01);
  EXPECT_LT(omr::fitCorner(edge, on_edge).squareness, 0.5);
  const cv::Matx33d board = omr::test::boardHomography(5, 7, {200, 150}, 25, 0, 0);
  Render render({400, 300});
  render.addBoard(5, 7, board);
  const cv::Mat grey = omr::makeFrame(render.picture()).raw_grey;
  for (float off = 0; off < 25; off += 1)
  {
    LocalFrame start = frameAt(board, 3, 2);
    start.node += cv::Point2f(off, -off / 3);
    const cv::Point2f move = omr::fitCorner(grey, start).position - start.node;
    EXPECT_LE(std::max(std::abs(move.x), std::abs(move.y)), 0.3 * 25) << off;
  }
}

TEST(CornerFit, tellsFourSquaresFromTheOuterCornerOfOne)
{
  const cv::Matx33d board = omr::test::boardHomography(5, 7, {200, 150}, 25, 10, 0);
  Render render({400, 300});
  render.addBoard(5, 7, board);
  const cv::Mat grey = omr::makeFrame(render.picture()).raw_grey;
  EXPECT_GT(omr::fitCorner(grey, frameAt(board, 2, 1)).squareness, 5);
  EXPECT_NEAR(omr::fitCorner(grey, frameAt(board, 2, 0)).squareness, 1, 0.1);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
