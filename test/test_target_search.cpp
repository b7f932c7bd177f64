// The search for targets in steps, as the detector takes them beside the fill pipeline.

#include <gtest/gtest.h>

#include "target_views.h"

using omr::Settings;
using omr::Target;
using omr::test::findTargetsIn;
using omr::test::targetRegions;

TEST(TargetSearch, givesTheSameWhetherItLooksAheadOrNot)
{
  TargetScene scene;
  scene.homography = tiltedView({240, 180}, .5, .4, 1, 900);
  scene.occluder = .3;
  const cv::Mat image = renderTarget(scene);
  const omr::RegionMap regions = targetRegions(image, Settings());
  const std::vector<Target> plain = findTargetsIn(image);
  ASSERT_EQ(1U, plain.size());
  for (const bool with_grey : {false, true})
  {
    omr::TargetSearch search(image, Settings());
    search.lookAtImage();
    if (with_grey)
    {
      search.lookAtGrey(omr::makeFrame(image).raw_grey);
    }
    const std::vector<Target> ahead = search.finish(regions, {});
    ASSERT_EQ(1U, ahead.size());
    EXPECT_EQ(plain[0].colors, ahead[0].colors);
    EXPECT_EQ(plain[0].center, ahead[0].center);
  }
}

TEST(TargetSearch, givesThoseBesideTheBoardsThatThereAreWhicheverWereExpected)
{
  TargetScene scene;
  scene.homography = tiltedView({240, 180}, .5, .4, 1, 900);
  const cv::Mat image = renderTarget(scene);
  const omr::RegionMap regions = targetRegions(image, Settings());
  omr::Checkerboard everywhere;
  const auto right = static_cast<float>(image.cols);
  const auto bottom = static_cast<float>(image.rows);
  everywhere.rows = everywhere.cols = 2;
  everywhere.corners = {cv::Point2f(0, 0), cv::Point2f(right, 0), cv::Point2f(right, bottom), cv::Point2f(0, bottom)};
  everywhere.inner_corners = {cv::Point2f(right / 2, bottom / 2)};
  everywhere.inner_corners_seen = {true};
  const std::vector<std::vector<omr::Checkerboard>> both = {{}, {everywhere}};
  for (const auto& expected : both)
  {
    for (const auto& boards : both)
    {
      omr::TargetSearch search(image, Settings());
      search.expect(expected);
      search.lookAtRest(regions);
      EXPECT_EQ(boards.empty() ? 1U : 0U, search.finish(regions, boards).size());
    }
  }
}

TEST(TargetSearch, lookingInVainIsNoHarm)
{
  const cv::Mat image = renderTarget(TargetScene());
  const omr::RegionMap regions = targetRegions(image, Settings());
  omr::TargetSearch search(image, Settings());
  search.expect({omr::Checkerboard()});
  search.confirm({});
  search.lookAtRest(regions);
  EXPECT_EQ(1U, search.finish(regions, {}).size());
}

TEST(TargetSearch, lookingAheadAtWhatIsNoColourImageDoesNothing)
{
  for (const cv::Mat& image : {cv::Mat(), cv::Mat(40, 40, CV_8UC1, cv::Scalar::all(9))})
  {
    omr::TargetSearch search(image, Settings());
    search.lookAtImage();
    search.lookAtGrey({});
    search.lookAtRest({});
    EXPECT_TRUE(search.finish({}, {}).empty());
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
