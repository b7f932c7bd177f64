#ifndef OUTDOOR_OMR_CORE_MARKER_BOX_H
#define OUTDOOR_OMR_CORE_MARKER_BOX_H

#include <opencv2/imgproc.hpp>
#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/target.h"

namespace omr
{
/** The upright box of a marker [px]; beyond the image where that cuts the marker. */
inline cv::Rect boxOf(const Checkerboard& board)
{
  return cv::boundingRect(std::vector<cv::Point2f>(board.corners.begin(), board.corners.end()));
}

inline cv::Rect boxOf(const Target& target)
{
  return target.rings.back().boundingRect();
}

}  // namespace omr

#endif
