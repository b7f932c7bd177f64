#ifndef OUTDOOR_OMR_CORE_BENT_OUTLINE_H
#define OUTDOOR_OMR_CORE_BENT_OUTLINE_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/checkerboard.h"

namespace omr
{
/**
 * A board's outline as bent as its lines, for drawing [px]: from outer corner to outer corner each line of inner
 * corners goes on for a square, where it is seen. The four outer corners alone where the inner ones are not as many as
 * the size says.
 */
std::vector<cv::Point2f> bentOutline(const Checkerboard& board);

}  // namespace omr

#endif
