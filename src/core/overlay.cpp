#include "outdoor_omr/overlay.h"

namespace outdoor_omr
{
cv::Mat drawOverlay(const cv::Mat& bgr, const Markers& /*markers*/, const RegionMap& /*regions*/)
{
  return bgr.clone();
}

}  // namespace outdoor_omr
