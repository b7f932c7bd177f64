#include "target_views.h"

#include <gtest/gtest.h>

#include <algorithm>

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

void expectLetters(const std::string& colors, int most_unknown, const std::string& found)
{
  ASSERT_EQ(colors.size(), found.size()) << found;
  EXPECT_LE(std::count(found.begin(), found.end(), '?'), most_unknown) << found;
  for (std::size_t k = 0; k < colors.size(); ++k)
  {
    EXPECT_TRUE(found[k] == '?' || found[k] == colors[k]) << found << " instead of " << colors;
  }
}

}  // namespace omr::test
