#include "outdoor_omr/fill_pipeline.h"

#include "outdoor_omr/reference_fill.h"

namespace outdoor_omr
{
class FillPipeline::Implementation
{
 public:
  std::string name = "reference (no OpenCL)";
  std::string fallback_reason;
};

FillPipeline::FillPipeline(const std::string& /*device*/) : implementation_(std::make_unique<Implementation>())
{
}

FillPipeline::~FillPipeline() = default;
FillPipeline::FillPipeline(FillPipeline&&) noexcept = default;
FillPipeline& FillPipeline::operator=(FillPipeline&&) noexcept = default;

void FillPipeline::run(const cv::Mat& bgr, const Settings& settings, const Outputs& outputs, RegionMap& map,
                       std::vector<StepTime>* /*times*/)
{
  const cv::Mat filtered = filterImage(bgr, settings.filter, settings.filter_size);
  const cv::Mat edges = edgeMask(filtered, settings.sobel_threshold);
  const cv::Mat labels = labelRegions(edges);
  map.size = bgr.size();
  map.regions.clear();
  const std::vector<RegionSums> sums = sumRegions(filtered, edges, labels);
  map.region_count = static_cast<int>(sums.size());
  for (const RegionSums& one : sums)
  {
    if (one.area >= static_cast<unsigned>(settings.region_min_area) &&
        one.area <= settings.region_max_share * static_cast<double>(bgr.total()))
    {
      map.regions.push_back(toRegion(one));
    }
  }
  map.edges = outputs.edges ? edges : cv::Mat();
  map.labels = outputs.labels ? labels : cv::Mat();
}

const std::string& FillPipeline::deviceName() const
{
  return implementation_->name;
}

const std::string& FillPipeline::fallbackReason() const
{
  return implementation_->fallback_reason;
}

std::vector<std::string> FillPipeline::devices()
{
  return {};
}

}  // namespace outdoor_omr
