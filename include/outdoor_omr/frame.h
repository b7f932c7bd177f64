#ifndef OUTDOOR_OMR_FRAME_H
#define OUTDOOR_OMR_FRAME_H

#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** One image in the forms that the detectors sample. Pixel (0, 0) has its centre at (0, 0) on every level. */
struct Frame
{
  cv::Mat bgr;       ///< H x W, CV_8UC3, as the camera gave it (shared, not copied)
  cv::Mat raw_grey;  ///< H x W, CV_8UC1
  std::vector<cv::Mat>
      grey;  ///< CV_8UC1 pyramid: level 0 is raw_grey after a 3x3 Gaussian, each next has half the size
};

/**
 * The detectors smooth on their own, whatever the fill pipeline's filter. Where a corner is fitted, nothing is
 * smoothed: see fitCorner().
 *
 * @param bgr H x W, CV_8UC3, not empty.
 * @throws std::invalid_argument otherwise.
 */
Frame makeFrame(const cv::Mat& bgr);

/** The same in the memory of an older frame: five megabytes at 1080p that need not be found anew for each image. */
void makeFrame(const cv::Mat& bgr, Frame& frame);

}  // namespace omr

#endif
