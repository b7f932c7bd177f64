#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "checkerboards/checkerboards.h"
#include "checkerboards/seeds/groups.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

using omr::Frame;
using omr::RegionMap;
using omr::Seed;
using omr::Settings;
using omr::test::Render;

namespace
{
RegionMap regionsOf(const cv::Mat& picture)
{
  RegionMap map;
  omr::FillPipeline("reference").run(picture, Settings(), {}, map);
  return map;
}
}  // namespace

TEST(Groups, pairsOfSquaresGiveTheLatticeBetweenThem)
{
  const cv::Matx33d board = omr::test::boardHomography(5, 7, {200, 150}, 25, 20, 30);
  Render render({400, 300});
  render.addBoard(5, 7, board);
  const cv::Mat picture = render.picture();
  const std::vector<Seed> seeds = omr::pairNeighbours(omr::makeFrame(picture), regionsOf(picture));
  ASSERT_FALSE(seeds.empty());
  for (std::size_t i = 1; i < seeds.size(); ++i)
  {
    EXPECT_LE(seeds[i].rank, seeds[i - 1].rank);
  }
  // The first seed lies on an inner corner, and one step along u and v leads to others.
  const cv::Matx33d to_board = board.inv();
  const auto distance_to_node = [&](const cv::Point2f& point) {
    const cv::Point2d square = omr::test::project(to_board, point.x, point.y);
    return std::hypot(square.x - std::round(square.x), square.y - std::round(square.y));
  };
  EXPECT_LT(distance_to_node(seeds[0].frame.node), 0.15);
  EXPECT_LT(distance_to_node(seeds[0].frame.at(1, 0)), 0.25);
  EXPECT_LT(distance_to_node(seeds[0].frame.at(0, 1)), 0.25);
  EXPECT_GT(omr::cross(seeds[0].frame.u, seeds[0].frame.v), 0);
}

TEST(Groups, boardsOfPairsComeFirstThoseOfSaddlePointsLater)
{
  Render render({400, 300});
  render.addBoard(5, 7, omr::test::boardHomography(5, 7, {200, 150}, 25, 20, 30));
  const cv::Mat picture = render.picture();
  const Frame frame = omr::makeFrame(picture);
  std::vector<std::size_t> first;
  const auto use_first = [&](const std::vector<omr::Checkerboard>& boards) { first.push_back(boards.size()); };
  EXPECT_EQ(1U, omr::findCheckerboards(frame, regionsOf(picture), Settings(), use_first).size());
  EXPECT_EQ(1U, omr::findCheckerboards(frame, RegionMap(), Settings(), use_first).size());
  EXPECT_EQ((std::vector<std::size_t>{1, 0}), first);
}

TEST(Groups, singleSquaresAndEmptyMapsGiveNothing)
{
  Render render({200, 200});
  render.addPolygon({{50, 50}, {80, 50}, {80, 80}, {50, 80}}, cv::Scalar::all(20));
  const cv::Mat picture = render.picture();
  EXPECT_TRUE(omr::pairNeighbours(omr::makeFrame(picture), regionsOf(picture)).empty());
  EXPECT_TRUE(omr::pairNeighbours(omr::makeFrame(picture), RegionMap()).empty());
}

TEST(Groups, regionsWithoutExtentAreIgnored)
{
  RegionMap map;
  map.size = {64, 64};
  map.regions.resize(3);  // all zero: no area, no covariance
  EXPECT_TRUE(omr::pairNeighbours(omr::makeFrame(cv::Mat::zeros(64, 64, CV_8UC3)), map).empty());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
