#ifndef OUTDOOR_OMR_ROS_PART_MESSAGES_H
#define OUTDOOR_OMR_ROS_PART_MESSAGES_H

#include <geometry_msgs/TransformStamped.h>
#include <outdoor_omr/CheckerboardArray.h>
#include <outdoor_omr/PartArray.h>
#include <outdoor_omr/TargetArray.h>
#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "outdoor_omr/camera.h"
#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/locate.h"
#include "outdoor_omr/part_tracker.h"
#include "outdoor_omr/parts.h"
#include "outdoor_omr/target.h"

namespace omr
{
CameraInfo fromMessage(const sensor_msgs::CameraInfo& message);

/** What locateParts() reads of them. @throws std::invalid_argument if the lengths of a board's lists do not fit. */
std::vector<Checkerboard> fromMessage(const outdoor_omr::CheckerboardArray& message);
std::vector<Target> fromMessage(const outdoor_omr::TargetArray& message);

/** @param header of the image, copied. */
outdoor_omr::PartArray toMessage(const std_msgs::Header& header, const std::vector<Sighting>& sightings);

/** Gives the parts that are certain their numbers, and smoothed poses where the tracker smooths. */
void track(outdoor_omr::PartArray& parts, PartTracker& tracker);

/** The frame of the part in TF: its name, and of one that may have copies in view NAME_COPY. */
std::string frameOf(const outdoor_omr::Part& part, const std::vector<Part>& descriptions);

/** The transform from the frame of the parts to that of the part. */
geometry_msgs::TransformStamped toTransform(const std_msgs::Header& header, const outdoor_omr::Part& part,
                                            const std::vector<Part>& descriptions);

/**
 * What rviz shows: of each certain part the outlines of its boards, its axes, its name and the ellipsoid that holds its
 * position with 95 %; what was shown before is deleted.
 */
visualization_msgs::MarkerArray toMarkers(const outdoor_omr::PartArray& parts, const std::vector<Part>& descriptions);

}  // namespace omr

#endif
