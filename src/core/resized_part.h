#ifndef OUTDOOR_OMR_CORE_RESIZED_PART_H
#define OUTDOOR_OMR_CORE_RESIZED_PART_H

#include <opencv2/core.hpp>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/target.h"

namespace omr
{
/** Where a part of the image that was resized lies. The centre of the top-left pixel is (0, 0) in both. */
struct ResizedPart
{
  double factor = 1;   ///< pixels of the part a pixel of the image
  cv::Point2d origin;  ///< of the part, pixel of the image

  cv::Point2d toImage(const cv::Point2d& point) const;
  cv::Point2d fromImage(const cv::Point2d& point) const;
};

/** Gives a marker that was found in the part the positions that it has in the image. */
void moveToImage(const ResizedPart& part, Checkerboard& board);
void moveToImage(const ResizedPart& part, Target& target);

}  // namespace omr

#endif
