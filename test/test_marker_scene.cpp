#include "marker_scene.h"

#include <gtest/gtest.h>

#include "classification.h"
#include "clutter_scene.h"
#include "compare.h"
#include "training_windows.h"

using omr::MarkerKind;
using omr::PlacedMarker;
using omr::WindowLabel;

namespace
{
PlacedMarker board(double square, const cv::Point2d& corner)
{
  PlacedMarker marker;
  marker.kind = MarkerKind::checkerboard;
  marker.squares = {9, 7};
  marker.to_pixels = cv::Matx33d(square, 0, corner.x, 0, square, corner.y, 0, 0, 1);
  return marker;
}

PlacedMarker target(double ring, const cv::Point2d& center)
{
  PlacedMarker marker;
  marker.kind = MarkerKind::target;
  marker.colors = "WPRGB";
  marker.to_pixels = cv::Matx33d(ring, 0, center.x, 0, ring, center.y, 0, 0, 1);
  return marker;
}
}  // namespace

TEST(MarkerScene, equalSeedsGiveEqualScenesWithMarkersInside)
{
  const cv::Mat background = omr::test::noiseImage({200, 150});
  for (int seed = 1; seed <= 20; ++seed)
  {
    cv::RNG random(seed);
    cv::RNG again(seed);
    const omr::MarkerScene scene = omr::renderMarkerScene(background, random);
    EXPECT_TRUE(omr::test::equal(scene.image, omr::renderMarkerScene(background, again).image));
    EXPECT_EQ(CV_8UC3, scene.image.type());
    for (const PlacedMarker& marker : scene.markers)
    {
      const cv::Vec3d origin =
          marker.to_pixels * (marker.kind == MarkerKind::target
                                  ? cv::Vec3d(0, 0, 1)
                                  : cv::Vec3d(marker.squares.width / 2., marker.squares.height / 2., 1));
      const cv::Point2d center(origin[0] / origin[2], origin[1] / origin[2]);
      EXPECT_TRUE(cv::Rect2d({}, scene.image.size()).contains(center)) << "seed " << seed;
    }
  }
}

TEST(ClutterScene, equalSeedsGiveEqualScenesAndOthersDiffer)
{
  const cv::Mat background = omr::test::noiseImage({200, 150});
  cv::Mat before;
  for (int seed = 1; seed <= 30; ++seed)  // more than there are patterns
  {
    cv::RNG random(seed);
    cv::RNG again(seed);
    const cv::Mat scene = omr::renderClutterScene(background, random);
    EXPECT_TRUE(omr::test::equal(scene, omr::renderClutterScene(background, again)));
    EXPECT_EQ(CV_8UC3, scene.type());
    EXPECT_FALSE(seed > 1 && omr::test::equal(scene, before));
    before = scene;
  }
}

TEST(TrainingWindows, whatTheGateRejectsHasNoFeatures)
{
  const cv::Mat image = omr::test::noiseImage({64, 64});
  omr::FeedForward gate;
  gate.hidden = 1;
  gate.weights.assign(omr::GATE_INPUTS + 1 + 2 * 2, 0);  // scores of 0
  const auto all_drawn = [](WindowLabel /*label*/) { return true; };
  const auto any = [](const float* /*features*/, WindowLabel /*label*/) { return true; };
  omr::WindowSet all;
  omr::addWindows(image, {}, gate, all_drawn, any, all);
  EXPECT_EQ(0U, all.labels.size()) << "thresholds of 1";
  EXPECT_GT(all.plain_clutter, 0);
  gate.thresholds = {1, -.5F};
  omr::addWindows(image, {}, gate, all_drawn, any, all);
  EXPECT_GT(all.labels.size(), 0U);
  EXPECT_EQ(static_cast<int>(all.labels.size()), all.features.rows);
  EXPECT_EQ(static_cast<int>(all.labels.size()), all.gate.rows);
}

TEST(TrainingWindows, aWindowOnABoardShowsItWhereTheSquaresSuitTheLevel)
{
  const std::vector<PlacedMarker> markers = {board(4, {100, 100})};
  EXPECT_EQ(WindowLabel::checkerboard, omr::labelOf({108, 108, 16, 16}, 0, markers));
  EXPECT_EQ(WindowLabel::partly, omr::labelOf({104, 100, 32, 32}, 1, markers)) << "squares of one cell";
  EXPECT_EQ(WindowLabel::partly, omr::labelOf({90, 100, 16, 16}, 0, markers)) << "half of it beside the board";
  EXPECT_EQ(WindowLabel::clutter, omr::labelOf({60, 100, 16, 16}, 0, markers));
}

TEST(TrainingWindows, aWindowAroundTheCentreShowsATarget)
{
  const std::vector<PlacedMarker> markers = {target(3, {100, 100})};
  EXPECT_EQ(WindowLabel::target, omr::labelOf({92, 92, 16, 16}, 0, markers));
  EXPECT_EQ(WindowLabel::target, omr::labelOf({94, 93, 16, 16}, 0, markers));
  EXPECT_EQ(WindowLabel::partly, omr::labelOf({98, 92, 16, 16}, 0, markers)) << "beside the centre";
  EXPECT_EQ(WindowLabel::partly, omr::labelOf({68, 68, 64, 64}, 2, markers)) << "rings of less than half a cell";
}

TEST(Classification, theCurveCountsWhatIsAboveTheThreshold)
{
  omr::ScoreCounts counts;
  for (const float score : {-.9F, .3F, .6F, .9F})
  {
    counts.add(WindowLabel::checkerboard, {score, -1});
    counts.add(WindowLabel::clutter, {score - .5F, -1});
  }
  omr::WindowSet plain;
  plain.plain_clutter = 4;
  plain.plain_markers = {1, 0};
  counts.addPlain(plain);
  EXPECT_EQ(5, counts.count(WindowLabel::checkerboard));
  EXPECT_EQ(8, counts.count(WindowLabel::clutter));
  for (const omr::Classification& at : counts.curve(MarkerKind::checkerboard))
  {
    if (std::abs(at.threshold - .2) < 6e-4)
    {
      EXPECT_DOUBLE_EQ(.6, at.recall);
      EXPECT_DOUBLE_EQ(.125, at.false_rate);
      EXPECT_DOUBLE_EQ((.6 + .875) / 2, at.accuracy());
      EXPECT_DOUBLE_EQ(.6 / .725, at.precision());
      EXPECT_DOUBLE_EQ(.05 * .6 + .95 * .875, at.accuracy(.05)) << "of 20 windows one shows a marker";
      EXPECT_DOUBLE_EQ(.03 / (.03 + .95 * .125), at.precision(.05));
      return;
    }
  }
  FAIL() << "no threshold near .2";
}

TEST(Classification, whereFewWindowsShowAMarkerAPrecisionTakesAHigherThreshold)
{
  const std::vector<omr::Classification> curve = {{-.5, .9, .1}, {0, .8, .02}, {.5, .6, .001}};
  EXPECT_EQ(-.5, omr::atPrecision(curve, .9).threshold);
  EXPECT_EQ(0, omr::atPrecision(curve, .95).threshold);
  EXPECT_EQ(.5, omr::atPrecision(curve, .95, .05).threshold);
  EXPECT_EQ(.5, omr::atPrecision(curve, .9999).threshold) << "the largest, where none is enough";
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
