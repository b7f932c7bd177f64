#include "arc_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace omr
{
namespace
{
constexpr double MAX_PIXELS = 550000;  // that arcs are traced in

constexpr float STRENGTH = 1.3F;  // of the edgels, relative to the weakest: texture gives weak ones
}  // namespace

std::vector<ArcFamily> searchArcFamilies(const cv::Mat& bgr)
{
  const int reduction = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(bgr.total()) / MAX_PIXELS)));
  cv::Mat reduced = bgr;
  if (reduction > 1)
  {
    const cv::Size size(std::max(1, bgr.cols / reduction), std::max(1, bgr.rows / reduction));
    // Whole blocks of pixels, so that the scale is exact.
    cv::resize(bgr(cv::Rect(cv::Point(), cv::Size(std::min(bgr.cols, size.width * reduction),
                                                  std::min(bgr.rows, size.height * reduction)))),
               reduced, size, 0, 0, cv::INTER_AREA);
  }
  EdgelMap map(reduced);
  map.raiseThreshold(STRENGTH);
  std::vector<ArcFamily> families = findArcFamilies(traceArcs(map, reduced.size()));
  for (ArcFamily& family : families)
  {
    const double shift = (reduction - 1) / 2.;  // of the centre of a block
    family.family.center = family.family.center * reduction + cv::Point2d(shift, shift);
    for (double& radius : family.radii)
    {
      radius *= reduction;
    }
  }
  return families;
}

}  // namespace omr
