#include "targets/ring_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <opencv2/imgproc.hpp>

#include "outdoor_omr/reference_fill.h"
#include "outdoor_omr/settings.h"
#include "render_target.h"
#include "targets/candidate/ring_growth.h"
#include "targets/edges/look_budget.h"

namespace
{
omr::RegionMap regionsOf(const cv::Mat& image)
{
  const omr::Settings settings;
  const cv::Mat edges =
      omr::edgeMask(omr::filterImage(image, settings.filter, settings.filter_size), omr::edgeThreshold(settings));
  omr::RegionMap regions;
  regions.size = image.size();
  for (const auto& sums : omr::sumRegions(image, edges, omr::labelRegions(edges)))
  {
    if (static_cast<int>(sums.area) >= settings.region_min_area)
    {
      regions.regions.push_back(omr::toRegion(sums));
    }
  }
  return regions;
}

/** Disks and pairs of circles everywhere: every one is a seed, and has edges around it. */
cv::Mat clutter(const cv::Size& size)
{
  cv::RNG random(7);  // by chance, some seeds give concentric disks, which are targets
  cv::Mat image(size, CV_8UC3, cv::Scalar::all(128));
  for (int i = 0; i < size.area() / 250; ++i)
  {
    const cv::Point center(random.uniform(0, size.width), random.uniform(0, size.height));
    const int radius = random.uniform(3, 12);
    const cv::Scalar color(random.uniform(0, 256), random.uniform(0, 256), random.uniform(0, 256));
    cv::circle(image, center, radius, color, random.uniform(0, 2) == 0 ? cv::FILLED : 2, cv::LINE_AA);
  }
  return image;
}

/** Without those that only inks may tell: in clutter many a disk lies in another. */
std::vector<omr::RingCandidate> clearOf(std::vector<omr::RingCandidate> candidates)
{
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [](const omr::RingCandidate& candidate) { return candidate.is_merged; }),
                   candidates.end());
  return candidates;
}

/** One seed's growth may begin before the looks are spent. */
constexpr double ONE_GROWTH = 250000;
/** Concentric polygons, black and white, the outermost with this radius around the image's middle. */
cv::Mat polygons(int corners, double radius)
{
  cv::Mat image(500, 500, CV_8UC3, cv::Scalar::all(230));
  for (int ring = 4; ring > 0; --ring)
  {
    std::vector<cv::Point> outline;
    for (int i = 0; i < corners; ++i)
    {
      const double angle = 2 * CV_PI * i / corners;
      outline.push_back(cv::Point(250, 250) +
                        cv::Point(radius * ring / 4 * cv::Point2d(std::cos(angle), std::sin(angle))));
    }
    cv::fillConvexPoly(image, outline, cv::Scalar::all(ring % 2 == 0 ? 30 : 230), cv::LINE_AA);
  }
  return image;
}

}  // namespace

TEST(RingSearch, clutterTakesNoMoreThanTheAllowedLooks)
{
  const cv::Mat image = clutter({1600, 1200});
  const omr::RegionMap regions = regionsOf(image);
  omr::EdgelMap map(image);
  EXPECT_TRUE(clearOf(omr::findRingCandidates(map, image, regions, {}, {}, 3)).empty());
  EXPECT_GT(map.looks(), .5 * omr::allowedLooks(image.size()));
  EXPECT_LT(map.looks(), omr::allowedLooks(image.size()) + ONE_GROWTH);
}

TEST(RingSearch, endsSoonWhenItIsInVain)
{
  const cv::Mat image = clutter({1600, 1200});
  const omr::RegionMap regions = regionsOf(image);
  omr::EdgelMap map(image);
  const std::atomic<bool> is_vain(true);
  omr::findRingCandidates(map, image, regions, {}, {}, 3, &is_vain);
  EXPECT_LT(map.looks(), .5 * omr::allowedLooks(image.size()));  // those of the families, which come before
}

TEST(RingSearch, aTargetComesBeforeTheClutterAroundIt)
{
  TargetScene scene;
  const cv::Mat target = renderTarget(scene);
  cv::Mat image = clutter({1600, 1200});
  target.copyTo(image(cv::Rect(cv::Point(600, 400), target.size())));
  omr::EdgelMap map(image);
  const auto candidates = clearOf(omr::findRingCandidates(map, image, regionsOf(image), {}, {}, 3));
  ASSERT_EQ(1U, candidates.size());
  EXPECT_EQ(5, candidates[0].ring_count);
  EXPECT_NEAR(0, cv::norm(candidates[0].rings.family.center - projectedCenter(scene) - cv::Point2d(600, 400)), .2);
}

TEST(RingSearch, isTheSameForAnyNumberOfThreads)
{
  const cv::Mat target = renderTarget(TargetScene());
  cv::Mat image = clutter({1600, 1200});
  target.copyTo(image(cv::Rect(cv::Point(600, 400), target.size())));
  target.copyTo(image(cv::Rect(cv::Point(100, 700), target.size())));
  const omr::RegionMap regions = regionsOf(image);
  const int threads = cv::getNumThreads();
  std::vector<std::size_t> looks;
  std::vector<cv::Point2d> centers;
  for (const int count : {1, 4})
  {
    cv::setNumThreads(count);
    omr::EdgelMap map(image);
    for (const omr::RingCandidate& candidate : clearOf(omr::findRingCandidates(map, image, regions, {}, {}, 3)))
    {
      centers.push_back(candidate.rings.family.center);
    }
    looks.push_back(map.looks());
  }
  cv::setNumThreads(threads);
  ASSERT_EQ(4U, centers.size());
  EXPECT_EQ(centers[0], centers[2]);
  EXPECT_EQ(centers[1], centers[3]);
  EXPECT_EQ(looks[0], looks[1]);
}

TEST(RingSearch, anEmptyPictureTakesNoLooks)
{
  const cv::Mat image(300, 400, CV_8UC3, cv::Scalar::all(90));
  omr::EdgelMap map(image);
  EXPECT_TRUE(omr::findRingCandidates(map, image, regionsOf(image), {}, {}, 3).empty());
  EXPECT_LT(map.looks(), 10000);
}

TEST(RingGrowth, endsWherePolygonsFitWorseThanCircles)
{
  for (const bool is_round : {true, false})
  {
    omr::EdgelMap map(polygons(is_round ? 200 : 9, 200));
    omr::Rings rings;
    rings.family.center = {250, 250};
    rings.radii = {is_round ? 50. : 49.};
    EXPECT_EQ(is_round, omr::growRings(map, 120, rings)) << rings.rms;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
