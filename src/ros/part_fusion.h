#ifndef OUTDOOR_OMR_ROS_PART_FUSION_H
#define OUTDOOR_OMR_ROS_PART_FUSION_H

#include <outdoor_omr/FusionArray.h>
#include <outdoor_omr/PartArray.h>
#include <std_msgs/Header.h>

#include <map>
#include <opencv2/core/affine.hpp>
#include <string>
#include <vector>

#include "outdoor_omr/fusion.h"
#include "outdoor_omr/parts.h"

namespace omr
{
/** What one camera sees, and where it stands. */
struct CameraView
{
  outdoor_omr::PartArray parts;
  cv::Affine3d frame_camera;  ///< X_frame = frame_camera * X_camera, in the frame that the cameras share
};

/** What there may be of a part at once. */
struct Copies
{
  int count = 1;
  double apart = 0;  ///< the shorter side of its smallest board: nearer to each other two of them cannot be [m]
};

struct FusionSettings
{
  CameraSigma sigma;                     ///< of where the cameras stand
  int min_cameras = 1;                   ///< a part that fewer are certain of is not published
  std::map<std::string, Copies> copies;  ///< by name; a part that is missing here is one of its kind
};

/** The copies that a parts file allows. */
std::map<std::string, Copies> copiesOf(const std::vector<Part>& parts);

struct FusedViews
{
  outdoor_omr::PartArray parts;  ///< in the shared frame; indices of markers are left out
  outdoor_omr::FusionArray report;
};

/**
 * Combines what cameras see at one time. A part that enough cameras are certain of is certain; where they contradict
 * each other, all of them are candidates of an ambiguous sighting. What no camera is certain of stays
 * ambiguous, as each of them reported it.
 *
 * Of a part with copies the poses that agree within their covariances, one a camera, are of one copy. More groups of
 * poses than copies, or two groups too near to each other to be two, are a contradiction.
 *
 * @param header of the answer: the time, and the shared frame.
 * @throws std::invalid_argument for a pose or covariance that is none.
 */
FusedViews fuseViews(const std::vector<CameraView>& views, const std_msgs::Header& header,
                     const FusionSettings& settings);

}  // namespace omr

#endif
