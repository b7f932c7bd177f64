#ifndef OUTDOOR_OMR_CORE_YAML_POSE_H
#define OUTDOOR_OMR_CORE_YAML_POSE_H

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>
#include <string>

#include "yaml_file.h"

namespace omr
{
/** What a position in metres is to be; the bound catches a file written in millimetres. */
extern const char* const POSITION_IN_METRES;

/** A list of three numbers. @param bound of each one's absolute value. @throws std::invalid_argument. */
cv::Vec3d readVector(const YamlFile& node, const std::string& expected, double bound);

/** A list of three positions in metres. */
cv::Vec3d readPosition(const YamlFile& node);

/**
 * A map with 'xyz' [m] and, for the turn, either 'rpy_degrees', about the fixed axes x, then y, then z, as in URDF, or
 * 'quaternion' x, y, z, w, as in ROS's messages; without one of them it is not turned.
 */
cv::Affine3d readPose(const YamlFile& node);

}  // namespace omr

#endif
