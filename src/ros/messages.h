#ifndef OUTDOOR_OMR_ROS_MESSAGES_H
#define OUTDOOR_OMR_ROS_MESSAGES_H

#include <std_msgs/Header.h>

#include <opencv2/core.hpp>
#include <vector>

#include "message_types.h"
#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/target.h"

namespace outdoor_omr
{
/** @param header of the image, copied. @param size of the image [px]. */
outdoor_omr_msgs::CheckerboardArray toMessage(const std_msgs::Header& header, const cv::Size& size,
                                              const std::vector<Checkerboard>& checkerboards);

/** @param header of the image, copied. @param size of the image [px]. */
outdoor_omr_msgs::TargetArray toMessage(const std_msgs::Header& header, const cv::Size& size,
                                        const std::vector<Target>& targets);

}  // namespace outdoor_omr

#endif
