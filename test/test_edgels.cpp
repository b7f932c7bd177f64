#include "targets/edges/edgels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>

#include "render_target.h"

using omr::Edgel;
using omr::EdgelMap;

TEST(Edgels, lieOnTheCircleToATenthOfAPixel)
{
  TargetScene scene;
  scene.colors = "P";
  scene.radii = {60.4};
  scene.sheet_half_side = 1000;
  scene.noise = 0;
  EdgelMap map(renderTarget(scene));
  int count = 0;
  double sum = 0;
  double squared_sum = 0;
  map.visit(0, 0, 479, 359, [&](const Edgel& edgel) {
    const double dx = edgel.x - 240;
    const double dy = edgel.y - 180;
    const double r = std::hypot(dx, dy);
    ++count;
    sum += r;
    squared_sum += r * r;
    EXPECT_GT((dx * edgel.nx + dy * edgel.ny) / r, .95) << "towards the brighter side";
  });
  EXPECT_GT(count, 300);
  // The transfer function moves an edge of high contrast towards its dark side.
  const double mean = sum / count;
  EXPECT_NEAR(60.4, mean, .5);
  EXPECT_LT(std::sqrt(squared_sum / count - mean * mean), .1);
}

TEST(Edgels, followTheStrongestChannel)
{
  cv::Mat image(64, 64, CV_8UC3, cv::Scalar(40, 90, 40));
  image.colRange(32, 64).setTo(cv::Scalar(40, 40, 200));
  EdgelMap map(image);
  int count = 0;
  map.visit(0, 0, 63, 63, [&](const Edgel& edgel) {
    ++count;
    EXPECT_NEAR(31.5, edgel.x, .05);
    EXPECT_GT(edgel.nx, .99);
  });
  EXPECT_GE(count, 60);
}

TEST(Edgels, tilesJoinWithoutGapsOrDoubles)
{
  cv::Mat image(100, 150, CV_8UC3, cv::Scalar::all(30));
  image.rowRange(64, 100).setTo(cv::Scalar::all(200));
  EdgelMap map(image);
  std::vector<int> columns(150, 0);
  map.visit(0, 0, 149, 99, [&](const Edgel& edgel) { ++columns[static_cast<std::size_t>(std::lround(edgel.x))]; });
  for (int x = 1; x < 149; ++x)
  {
    EXPECT_EQ(1, columns[x]) << x;
  }
}

TEST(Edgels, onlyThoseInTheBox)
{
  cv::Mat image(100, 100, CV_8UC3, cv::Scalar::all(30));
  image.colRange(10, 50).setTo(cv::Scalar::all(120));
  image.colRange(50, 100).setTo(cv::Scalar::all(200));
  EdgelMap map(image);
  int count = 0;
  map.visit(20, 30, 80, 40, [&](const Edgel& edgel) {
    EXPECT_NEAR(49.5, edgel.x, .1);
    EXPECT_GE(edgel.y, 30);
    EXPECT_LE(edgel.y, 40);
    ++count;
  });
  EXPECT_EQ(11, count);
  map.visit(-50, -50, -10, -10, [](const Edgel&) { FAIL(); });
}

TEST(Edgels, thresholdFollowsTheNoise)
{
  cv::Mat clean(200, 200, CV_8UC3, cv::Scalar::all(100));
  cv::Mat noisy = clean.clone();
  cv::RNG random(5);
  random.fill(noisy, cv::RNG::NORMAL, 100, 20);
  EXPECT_LT(EdgelMap(clean).threshold(), EdgelMap(noisy).threshold());
}

TEST(Edgels, forksCountTheirLooksApartWhoeverComputesTheTiles)
{
  TargetScene scene;
  scene.noise = 6;
  const cv::Mat image = renderTarget(scene);
  const auto looks_alone = [&] {
    EdgelMap map(image);
    map.visit(0, 0, 479, 359, [](const Edgel&) {});
    return map.looks();
  }();
  const EdgelMap map(image);
  std::array<std::size_t, 4> looks{};
  std::array<int, 4> counts{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < looks.size(); ++i)
  {
    threads.emplace_back([&, i] {
      EdgelMap copy = map.fork();
      copy.visit(0, 0, 479, 359, [&](const Edgel&) { ++counts[i]; });
      looks[i] = copy.looks();
    });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(0U, map.looks());
  EXPECT_GT(looks_alone, 5000U);
  for (std::size_t i = 0; i < looks.size(); ++i)
  {
    EXPECT_EQ(looks_alone, looks[i]);
    EXPECT_EQ(counts[0], counts[i]);
  }
}

TEST(Edgels, computedAheadAreTheSameAndCountNoLooks)
{
  TargetScene scene;
  scene.noise = 6;
  const cv::Mat image = renderTarget(scene);
  EdgelMap ahead(image);
  ahead.computeAll();
  EXPECT_EQ(0U, ahead.looks());
  EdgelMap lazy(image);
  std::array<std::vector<float>, 2> places;
  ahead.visit(0, 0, 479, 359, [&](const Edgel& edgel) { places[0].push_back(edgel.x); });
  lazy.visit(0, 0, 479, 359, [&](const Edgel& edgel) { places[1].push_back(edgel.x); });
  EXPECT_FALSE(places[0].empty());
  EXPECT_EQ(places[1], places[0]);
  EXPECT_EQ(lazy.looks(), ahead.looks());
}

TEST(Edgels, tinyImages)
{
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 50), cv::Size(31, 3)})
  {
    EdgelMap map(cv::Mat(size, CV_8UC3, cv::Scalar::all(7)));
    map.visit(0, 0, 100, 100, [](const Edgel&) { FAIL(); });
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
