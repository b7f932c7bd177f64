#ifndef OUTDOOR_OMR_ROS_MESSAGE_TYPES_H
#define OUTDOOR_OMR_ROS_MESSAGE_TYPES_H

// The generated messages Checkerboard and Target have the names of the core's structs, in the package's namespace:
// where both are seen, the messages live in a namespace of their own.
#define outdoor_omr outdoor_omr_msgs
#include <outdoor_omr/CheckerboardArray.h>
#include <outdoor_omr/TargetArray.h>
#undef outdoor_omr

#endif
