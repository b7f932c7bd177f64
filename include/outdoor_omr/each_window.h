#ifndef OUTDOOR_OMR_EACH_WINDOW_H
#define OUTDOOR_OMR_EACH_WINDOW_H

#include <opencv2/imgproc.hpp>

#include "outdoor_omr/haar_features.h"

namespace omr
{
/** Calls with (cells, first, index, level) of every window of an image: level by level, row by row; its first cell,
 * its place in windowGrid(). */
template <typename Call>
void forEachWindow(const cv::Mat& bgr, const Call& call)
{
  cv::Mat integral;
  cv::integral(bgr, integral, CV_32S);
  for (int level = 0; level < HAAR_LEVELS; ++level)
  {
    const cv::Mat cells = haarCells(integral, level);
    const cv::Size grid = windowGrid(bgr.size(), level);
    for (int i = 0; i < grid.area(); ++i)
    {
      const cv::Point index(i % grid.width, i / grid.width);
      call(cells, WINDOW_STRIDE * index, index, level);
    }
  }
}

}  // namespace omr

#endif
