#include "target_views.h"

#include <gtest/gtest.h>

#include "outdoor_omr/reference_fill.h"

namespace omr::test
{
RegionMap targetRegions(const cv::Mat& image, const Settings& settings)
{
  const cv::Mat filtered = filterImage(image, settings.filter, settings.filter_size);
  const cv::Mat edges = edgeMask(filtered, edgeThreshold(settings));
  RegionMap regions;
  regions.size = image.size();
  for (const auto& sums : sumRegions(filtered, edges, labelRegions(edges)))
  {
    if (static_cast<int>(sums.area) >= settings.region_min_area &&
        sums.area <= settings.region_max_share * image.total())
    {
      regions.regions.push_back(toRegion(sums));
    }
  }
  return regions;
}

std::vector<Target> findTargetsIn(const cv::Mat& image, const Settings& settings)
{
  return findTargets(makeFrame(image), targetRegions(image, settings), {}, settings);
}

void expectFound(const TargetScene& scene, const std::string& colors, double tolerance)
{
  const std::vector<Target> targets = findTargetsIn(renderTarget(scene));
  ASSERT_EQ(1U, targets.size());
  EXPECT_EQ(colors, targets[0].colors);
  EXPECT_EQ(colors.size(), targets[0].rings.size());
  EXPECT_NEAR(0, cv::norm(cv::Point2d(targets[0].center) - projectedCenter(scene)), tolerance);
}

}  // namespace omr::test
