#include "candidates/enlargement.h"

#include <gtest/gtest.h>

using omr::Candidate;
using omr::Markers;
using omr::Target;

namespace
{
const cv::Mat IMAGE(200, 300, CV_8UC3, cv::Scalar::all(90));

Candidate candidateAt(const cv::Rect& box, int cell = 2)
{
  Candidate candidate;
  candidate.box = box;
  candidate.cell = cell;
  return candidate;
}

Target targetAt(const cv::Point2d& center, float diameter)
{
  Target target;
  target.colors = "WPR";
  target.center = center;
  target.rings.assign(3, cv::RotatedRect(center, cv::Size2f(diameter, diameter), 0));
  return target;
}

/** What the detector is asked for, and what it answers at one enlargement. */
struct Detector
{
  std::vector<cv::Size> sizes;
  cv::Size answered;  ///< size of the enlargement in which it finds the markers
  Markers found;

  Markers operator()(const cv::Mat& image)
  {
    sizes.push_back(image.size());
    return image.size() == answered ? found : Markers();
  }
};
}  // namespace

TEST(Enlargement, whatIsReadComesBackInPixelsOfTheImage)
{
  Markers markers;
  markers.candidates = {candidateAt({100, 60, 20, 16})};
  Detector detector;
  detector.answered = {80, 64};  // the box with half its size around it, twice enlarged
  detector.found.targets = {targetAt({40.5, 31.5}, 30)};
  detector.found.targets[0].outermost_deviation = .02;
  omr::Checkerboard board;
  board.corners = {cv::Point2f(1.5F, 3.5F), cv::Point2f(9.5F, 3.5F), cv::Point2f(9.5F, 61.5F),
                   cv::Point2f(1.5F, 61.5F)};
  board.inner_corners = {cv::Point2f(20.5F, 21.5F)};
  detector.found.checkerboards = {board};
  omr::readEnlarged(IMAGE, 5, std::ref(detector), markers);
  ASSERT_EQ(1U, markers.targets.size());
  // The centre of the enlarged top-left pixel lies a quarter of a pixel left of that of the image's.
  EXPECT_NEAR(90 + 20, markers.targets[0].center.x, 1e-9);
  EXPECT_NEAR(52 + 15.5, markers.targets[0].center.y, 1e-9);
  EXPECT_NEAR(15, markers.targets[0].rings[2].size.width, 1e-6);
  EXPECT_NEAR(90 + 20, markers.targets[0].rings[2].center.x, 1e-5);
  EXPECT_EQ(.02, markers.targets[0].outermost_deviation);
  EXPECT_TRUE(markers.checkerboards.empty()) << "it lies beside the candidate";
  EXPECT_TRUE(markers.candidates[0].read);
  EXPECT_EQ(1U, detector.sizes.size());
}

TEST(Enlargement, whatFillsLittleOfTheCandidateIsNoneOfIt)
{
  Detector detector;
  detector.answered = {160, 160};
  for (const float diameter : {20.F, 28.F})  // of a box of 80 px, enlarged
  {
    Markers markers;
    markers.candidates = {candidateAt({100, 60, 40, 40})};
    detector.found.targets = {targetAt({80, 80}, diameter)};
    omr::readEnlarged(IMAGE, 5, std::ref(detector), markers);
    EXPECT_EQ(diameter > 24 ? 1U : 0U, markers.targets.size()) << diameter;
  }
}

TEST(Enlargement, threeTimesWhereTwiceShowsNothing)
{
  Markers markers;
  markers.candidates = {candidateAt({100, 60, 20, 16})};
  Detector detector;
  detector.answered = {120, 96};
  detector.found.targets = {targetAt({61, 49}, 40)};
  omr::readEnlarged(IMAGE, 5, std::ref(detector), markers);
  EXPECT_EQ((std::vector<cv::Size>{{80, 64}, {120, 96}}), detector.sizes);
  ASSERT_EQ(1U, markers.targets.size());
  EXPECT_NEAR(90 + 20, markers.targets[0].center.x, 1e-9);
}

TEST(Enlargement, onlyUnreadOnesOfSmallSquaresAreLookedAtAndNotMoreThanAskedFor)
{
  Markers markers;
  markers.candidates.assign(6, candidateAt({100, 60, 20, 16}));
  markers.candidates[0].read = true;
  markers.candidates[1].cell = 8;
  Detector detector;
  omr::readEnlarged(IMAGE, 3, std::ref(detector), markers);
  EXPECT_EQ(6U, detector.sizes.size()) << "three candidates, two enlargements each";
  EXPECT_FALSE(markers.candidates[5].read);
  detector.sizes.clear();
  omr::readEnlarged(IMAGE, 0, std::ref(detector), markers);
  EXPECT_TRUE(detector.sizes.empty());
}

TEST(Enlargement, aPlaceWithAKnownMarkerGetsNoOther)
{
  Markers markers;
  markers.targets = {targetAt({110, 68}, 12)};
  markers.candidates = {candidateAt({100, 60, 20, 16})};
  Detector detector;
  detector.answered = {80, 64};
  detector.found.targets = {targetAt({40.5, 31.5}, 30)};
  omr::readEnlarged(IMAGE, 5, std::ref(detector), markers);
  EXPECT_EQ(1U, markers.targets.size());
}

TEST(Enlargement, theImagesEdgeCutsThePlace)
{
  Markers markers;
  markers.candidates = {candidateAt({0, 0, 20, 16}), candidateAt({280, 184, 20, 16})};
  Detector detector;
  omr::readEnlarged(IMAGE, 5, std::ref(detector), markers);
  EXPECT_EQ((std::vector<cv::Size>{{60, 48}, {90, 72}, {60, 48}, {90, 72}}), detector.sizes);
}

TEST(Enlargement, aLargePlaceTakesNoLookFromASmallOne)
{
  Markers markers;
  markers.candidates = {candidateAt({0, 0, 600, 500}), candidateAt({20, 20, 12, 10})};
  Detector detector;
  omr::readEnlarged(cv::Mat(800, 900, CV_8UC3, cv::Scalar::all(90)), 1, std::ref(detector), markers);
  EXPECT_EQ(2U, detector.sizes.size());
}

TEST(Enlargement, aLargePlaceIsNotEnlarged)
{
  const cv::Mat image(1080, 1920, CV_8UC3);
  Markers markers;
  markers.candidates = {candidateAt({500, 300, 400, 200}, 4)};
  Detector detector;
  omr::readEnlarged(image, 5, std::ref(detector), markers);
  EXPECT_TRUE(detector.sizes.empty());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
