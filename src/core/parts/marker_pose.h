#ifndef OUTDOOR_OMR_CORE_MARKER_POSE_H
#define OUTDOOR_OMR_CORE_MARKER_POSE_H

#include <vector>

#include "outdoor_omr/camera.h"
#include "outdoor_omr/pose.h"

namespace omr
{
/** Standard deviations of what the detector measures, at the least, each coordinate [px]. On rendered plates at 1 to 6
 * m inner corners have 0.014 to 0.02 in the directions that move the pose, centres of targets 0.03 to 0.07, centres of
 * the ellipses of their outermost rings 0.004 to 0.01; where less of the rings shows, Target::outermost_deviation says
 * more. On flat plates the few targets that do not state it had ellipses 1.2 to 4.2 px off, as if they were bent, and
 * centres 0.09 to 0.38 px off. */
constexpr double CORNER_SIGMA = 0.02;
constexpr double TARGET_SIGMA = 0.06;
constexpr double RING_SIGMA = 0.016;
constexpr double UNPLACED_SIGMA = 0.3;

/**
 * solvePose() for pairs of detected markers, whose residuals say too little of their errors: the detector draws the
 * corners of a board towards a smooth surface (refineCorners()), which takes the most from the errors that a pose
 * leaves and nothing from those that move it. The variance factor and with it the covariance make up for that, and are
 * never below what the sigmas of the pairs say.
 *
 * @return the local minima that the residuals do not tell apart: one, two where the flip is a rival, or none.
 */
std::vector<Pose> solveMarkers(const std::vector<PointPair>& pairs, const Camera& camera,
                               const std::vector<cv::Affine3d>& starts = {});

}  // namespace omr

#endif
