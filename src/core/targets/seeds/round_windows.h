#ifndef OUTDOOR_OMR_CORE_ROUND_WINDOWS_H
#define OUTDOOR_OMR_CORE_ROUND_WINDOWS_H

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** Square windows of an image, some cells wide, in which round spots may lie. */
class RoundWindows
{
 public:
  /** @param grey H x W, CV_8UC1. */
  explicit RoundWindows(const cv::Mat& grey);

  /**
   * Middles of the windows whose gradients are strong in all directions, more so than in those beside them.
   *
   * @param reach of a window [cells to either side of the middle one]; at most 2.
   */
  std::vector<cv::Point2d> strongest(int reach) const;

 private:
  /** How strong the gradients of each window are, in all directions; 0 if they are not. */
  cv::Mat1f marks(int reach) const;

  std::array<cv::Mat1f, 3> tensors_;  // sums over the cells of gx^2, gx gy and gy^2, with a frame of zeros around them
};

}  // namespace omr

#endif
