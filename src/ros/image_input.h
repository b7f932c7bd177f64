#ifndef OUTDOOR_OMR_ROS_IMAGE_INPUT_H
#define OUTDOOR_OMR_ROS_IMAGE_INPUT_H

#include <sensor_msgs/Image.h>

#include <opencv2/core.hpp>

namespace omr
{
/**
 * The pixels of an image message as the detector takes them.
 *
 * Everything is checked before the pixels are touched: cv_bridge 1.16 aborts on some inconsistent sizes and returns six
 * channels for big-endian colour.
 *
 * Encodings: mono, rgb, bgr, rgba, bgra and bayer_* of 8 and 16 bits, yuv422, and OpenCV's 8UC1 (grey), 8UC3 (BGR) and
 * 8UC4 (BGRA). Alpha is dropped; 16 bits are scaled to 8 over their full range.
 *
 * @param message kept alive as long as the result is used, and unchanged: bgr8 and 8UC3 are not copied.
 * @return        H x W, CV_8UC3, BGR.
 * @throws std::invalid_argument naming the field, its value and what was expected.
 */
cv::Mat toBgr(const sensor_msgs::ImageConstPtr& message);

}  // namespace omr

#endif
