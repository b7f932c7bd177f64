#include "checkerboards/seeds/point_grid.h"

#include <gtest/gtest.h>

using omr::PointGrid;

namespace
{
constexpr int LEAST = 2;  // px
constexpr int MOST = 40;  // px
const cv::Size IMAGE(500, 300);

std::vector<cv::Point> somePoints(int count)
{
  cv::RNG random(5);
  std::vector<cv::Point> points;
  for (int i = 0; i < count; ++i)
  {
    points.emplace_back(random.uniform(0, IMAGE.width), random.uniform(0, IMAGE.height));
  }
  return points;
}

/** Ascending [px^2]; of the points far enough apart to be neighbours. */
std::vector<int> squaredDistances(const std::vector<cv::Point>& points, const cv::Point& center)
{
  std::vector<int> squared;
  for (const cv::Point& point : points)
  {
    const int distance = (point - center).dot(point - center);
    if (distance >= LEAST * LEAST && distance < MOST * MOST)
    {
      squared.push_back(distance);
    }
  }
  std::sort(squared.begin(), squared.end());
  return squared;
}
}  // namespace

TEST(PointGrid, nearestNeighboursComeFirst)
{
  // Few points, whose neighbours are far, and many.
  for (const int count : {60, 400, 3000})
  {
    const std::vector<cv::Point> points = somePoints(count);
    const PointGrid grid(points, IMAGE);
    std::vector<PointGrid::Neighbour> neighbours;
    for (const cv::Point& center : points)
    {
      grid.neighbours(center, neighbours);
      const std::vector<int> expected = squaredDistances(points, center);
      ASSERT_EQ(std::min(expected.size(), PointGrid::MAX_NEIGHBOURS), neighbours.size());
      // Those within a cell's side are surely seen.
      for (std::size_t i = 0; i < neighbours.size() && expected[i] < 16 * 16; ++i)
      {
        EXPECT_EQ(expected[i], neighbours[i].squared);
        EXPECT_EQ(neighbours[i].squared, neighbours[i].offset.dot(neighbours[i].offset));
      }
    }
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
