#include "box_training.h"

#include <gtest/gtest.h>

using omr::LabelledBox;
using omr::MarkerKind;
using omr::MarkerNetwork;

namespace
{
/** Boxes of two kinds; the first feature tells the checkerboards, the second one the targets. */
std::vector<LabelledBox> boxesToLearn()
{
  std::vector<LabelledBox> boxes;
  cv::RNG random(3);
  for (int i = 0; i < 4000; ++i)
  {
    const auto kind = static_cast<MarkerKind>(i % 2);
    const bool marker = i % 4 < 2;
    LabelledBox box = {{}, kind, marker, marker};
    for (float& feature : box.features)
    {
      feature = static_cast<float>(random.gaussian(1));
    }
    box.features[static_cast<int>(kind)] += marker ? 3.F : 0.F;
    boxes.push_back(box);
  }
  return boxes;
}

MarkerNetwork learned(const std::vector<LabelledBox>& boxes)
{
  MarkerNetwork network;
  network.boxes[0].weights = omr::learnEvidence(boxes, MarkerKind::checkerboard);
  network.boxes[1].weights = omr::learnEvidence(boxes, MarkerKind::target);
  return network;
}
}  // namespace

TEST(BoxTraining, theEvidenceIsTheLogOfTheOdds)
{
  const MarkerNetwork network = learned(boxesToLearn());
  // Two normal distributions 3 apart: log of the odds 3 x - 4.5.
  EXPECT_NEAR(-4.5, network.boxes[0].weights[0], .5);
  EXPECT_NEAR(3, network.boxes[0].weights[1], .4);
  EXPECT_NEAR(0, network.boxes[0].weights[2], .2);
  EXPECT_NEAR(3, network.boxes[1].weights[2], .4);
}

TEST(BoxTraining, boxesWithoutAMistakeGiveFiniteEvidence)
{
  std::vector<LabelledBox> boxes = boxesToLearn();
  for (LabelledBox& box : boxes)
  {
    box.features[0] = box.marker ? 1.F : -1.F;
  }
  EXPECT_LT(std::abs(omr::learnEvidence(boxes, MarkerKind::checkerboard)[1]), 20);
}

TEST(BoxTraining, asManyFalseBoxesAsAreAllowedHaveTheEvidence)
{
  const std::vector<LabelledBox> boxes = boxesToLearn();
  const MarkerNetwork network = learned(boxes);
  const int pictures = 500;
  for (const double rate : {0., .1, 1.})
  {
    const float evidence = omr::evidenceOfFalse(boxes, network, pictures, rate);
    int wrong = 0;
    for (const LabelledBox& box : boxes)
    {
      const bool enough = omr::evidenceOf(box.features, network.boxes[static_cast<int>(box.kind)]) >= evidence;
      wrong += static_cast<int>(!box.among_markers && enough);
    }
    EXPECT_EQ(static_cast<int>(rate * pictures), wrong);
  }
  EXPECT_LT(omr::shareOfMarkers(boxes, network, MarkerKind::target, 5), .6);
  EXPECT_GT(omr::shareOfMarkers(boxes, network, MarkerKind::target, 0), .9);
}

TEST(BoxTraining, noFalseBoxAsksForNoEvidence)
{
  EXPECT_EQ(0, omr::evidenceOfFalse({}, {}, 10, .1));
}

TEST(BoxTraining, boxesOfPicturesKnowWhetherMarkersAreThere)
{
  const std::vector<cv::Mat> photographs = {cv::Mat(200, 300, CV_8UC3, cv::Scalar(90, 120, 80))};
  const omr::TrainingPictures pictures(photographs, 20);
  const std::vector<LabelledBox> boxes = omr::labelledBoxes(pictures, 7, omr::defaultMarkerNetwork());
  int markers = 0;
  for (const LabelledBox& box : boxes)
  {
    markers += static_cast<int>(box.marker);
    EXPECT_TRUE(!box.marker || box.among_markers);
  }
  EXPECT_GT(markers, 10);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
