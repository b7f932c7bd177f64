#ifndef OUTDOOR_OMR_CORE_SEARCH_MAP_H
#define OUTDOOR_OMR_CORE_SEARCH_MAP_H

#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** Where in the image a lattice may still be started: not on a board that was found, and not where starts failed. */
class SearchMap
{
 public:
  explicit SearchMap(const cv::Size& image);

  bool isOpen(const cv::Point2f& point) const;

  /** Notes failures around a point; two of them close the place. @param square_height of the lattice [px]. */
  void addFailure(const cv::Point2f& point, float square_height, int failures = 1);

  /** Closes the area of a board. @param outline [px]. */
  void close(const std::vector<cv::Point2f>& outline);

 private:
  static constexpr int CELL = 2;  // px
  cv::Mat failures_;              // CV_8UC1, one value a cell
};

}  // namespace omr

#endif
