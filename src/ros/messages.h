#ifndef OUTDOOR_OMR_ROS_MESSAGES_H
#define OUTDOOR_OMR_ROS_MESSAGES_H

#include <outdoor_omr/CheckerboardArray.h>
#include <outdoor_omr/TargetArray.h>
#include <std_msgs/Header.h>

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/target.h"

namespace omr
{
/** @param header of the image, copied. @param size of the image [px]. @param sections see Markers. */
outdoor_omr::CheckerboardArray toMessage(const std_msgs::Header& header, const cv::Size& size,
                                         const std::vector<Checkerboard>& checkerboards,
                                         const std::vector<Checkerboard>& sections = {});

/** @param header of the image, copied. @param size of the image [px]. */
outdoor_omr::TargetArray toMessage(const std_msgs::Header& header, const cv::Size& size,
                                   const std::vector<Target>& targets);

}  // namespace omr

#endif
