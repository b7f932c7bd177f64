#ifndef OUTDOOR_OMR_GOALS_H
#define OUTDOOR_OMR_GOALS_H

#include <opencv2/core/affine.hpp>
#include <string>
#include <vector>

namespace omr
{
/** Where a part shall be. */
struct Goal
{
  std::string part;               ///< its name in the parts file
  std::string frame;              ///< TF frame that the pose is in
  cv::Affine3d pose;              ///< X_frame = pose * X_part [m]
  double position_tolerance = 0;  ///< largest distance of the part's origin from its place [m]
  double rotation_tolerance = 0;  ///< largest turn away from the goal's, about any axis [rad]
};

/**
 * Reads a goals file; config/goals.yaml explains the format by example.
 *
 * @throws std::runtime_error if the file cannot be read; std::invalid_argument with file, line, key and what is
 *         expected for anything unknown, missing, double or impossible.
 */
std::vector<Goal> readGoals(const std::string& file);

}  // namespace omr

#endif
