#ifndef OUTDOOR_OMR_MARKER_POSE_H
#define OUTDOOR_OMR_MARKER_POSE_H

#include <vector>

#include "outdoor_omr/camera.h"
#include "outdoor_omr/pose.h"

namespace omr
{
/** Standard deviations of what the detector measures, at the least, each coordinate [px]. On rendered plates at 1 to 6
 * m inner corners have 0.014 to 0.02 in the directions that move the pose, centres of targets 0.03 to 0.07, centres of
 * the ellipses of their outermost rings 0.004 to 0.01. Where less of the rings shows, Target::outermost_deviation is
 * more; where it is not known, 0.04 is what edgels have that know two thirds of a ring. */
constexpr double CORNER_SIGMA = 0.02;
constexpr double TARGET_SIGMA = 0.06;
constexpr double RING_SIGMA = 0.016;
constexpr double UNPLACED_RING_SIGMA = 0.04;

/**
 * solvePose() for pairs of detected markers, whose residuals say too little of their errors: the detector draws the
 * corners of a board towards a smooth surface (refineCorners()), which takes the most from the errors that a pose
 * leaves and nothing from those that move it. The variance factor and with it the covariance make up for that, and are
 * never below what the sigmas of the pairs say.
 *
 * @return the local minima that the residuals do not tell apart: one, two where the flip is a rival, or none.
 */
std::vector<Pose> solveMarkers(const std::vector<PointPair>& pairs, const Camera& camera);

}  // namespace omr

#endif
