#ifndef OUTDOOR_OMR_ROS_CANDIDATE_MESSAGES_H
#define OUTDOOR_OMR_ROS_CANDIDATE_MESSAGES_H

#include <outdoor_omr/CandidateArray.h>
#include <sensor_msgs/RegionOfInterest.h>
#include <std_msgs/Header.h>

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/candidates.h"

namespace omr
{
/** @param header of the image, copied. @param size of the image [px]. */
outdoor_omr::CandidateArray toMessage(const std_msgs::Header& header, const cv::Size& size,
                                      const std::vector<Candidate>& candidates);

/**
 * Where a camera should look closer: around all candidates that were not read, with half their size on each side; all
 * zero, which stands for the whole image in sensor_msgs, when there is none.
 *
 * @param size of the image [px].
 */
sensor_msgs::RegionOfInterest unreadRegion(const cv::Size& size, const std::vector<Candidate>& candidates);

}  // namespace omr

#endif
