#ifndef OUTDOOR_OMR_TEST_LOCATE_FIXTURE_H
#define OUTDOOR_OMR_TEST_LOCATE_FIXTURE_H

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "outdoor_omr/locate.h"
#include "part_view.h"

namespace omr::test
{
inline const PartTarget LEFT{"RWPGB", 0.016, {-0.3, 0, 0}};
inline const PartTarget RIGHT{"GRGPB", 0.016, {0.3, 0, 0}};

/** A board that looks the same after half a turn, and targets that tell. */
inline Part plate(const std::string& name = "plate")
{
  return {name, {flatBoard()}, {LEFT, RIGHT}};
}

/** Degrees between two attitudes. */
inline double degreesBetween(const cv::Affine3d& a, const cv::Affine3d& b)
{
  return cv::norm((a.inv() * b).rvec()) * 180 / CV_PI;
}

inline double millimetresBetween(const cv::Affine3d& a, const cv::Affine3d& b)
{
  return cv::norm(a.translation() - b.translation()) * 1000;
}

class Locate : public ::testing::Test
{
 protected:
  std::vector<Sighting> locate(const PartView& view, const std::vector<Part>& parts) const
  {
    return locateParts(view.checkerboards, view.targets, parts, camera_);
  }

  /** One sighting, certain, at the given place: 1 mm at 2 m, 0.1 degrees. */
  void expectCertain(const std::vector<Sighting>& sightings, const std::string& part, const cv::Affine3d& pose) const
  {
    ASSERT_EQ(sightings.size(), 1U);
    ASSERT_TRUE(sightings[0].certain()) << sightings[0].candidates.size() << " candidates";
    expectAt(sightings[0].candidates[0], part, pose);
  }

  static void expectAt(const PartPose& found, const std::string& part, const cv::Affine3d& pose)
  {
    EXPECT_EQ(found.part, part);
    EXPECT_LT(millimetresBetween(found.pose.camera_part, pose), 1);
    EXPECT_LT(degreesBetween(found.pose.camera_part, pose), 0.1);
  }

  Camera camera_{cameraInfo(), ImageKind::raw};
  cv::Affine3d pose_ = poseAt(0.1, -0.05, 2, 20, -25, 10);
};

}  // namespace omr::test

#endif
