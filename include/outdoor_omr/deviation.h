#ifndef OUTDOOR_OMR_DEVIATION_H
#define OUTDOOR_OMR_DEVIATION_H

#include <opencv2/core.hpp>

#include "outdoor_omr/goals.h"
#include "outdoor_omr/pose_estimate.h"

namespace omr
{
enum class Verdict
{
  undecided,  ///< the tolerance's bound lies within what the measurement leaves open
  within,     ///< within both tolerances, uncertainty included
  outside     ///< beyond one of them, uncertainty included
};

/** How far a part is from its goal. */
struct Deviation
{
  cv::Vec3d translation;            ///< from the goal to the part's origin, along the axes of the goal [m]
  cv::Vec3d rotation;               ///< rotation vector that takes the goal to the part, likewise [rad]
  double position_uncertainty = 0;  ///< 95 %, of the worst direction [m]
  double rotation_uncertainty = 0;  ///< [rad]
  Verdict verdict = Verdict::undecided;
};

/** @param estimate in the frame of the goal. */
Deviation deviationFrom(const Goal& goal, const PoseEstimate& estimate);

}  // namespace omr

#endif
