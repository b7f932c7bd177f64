#include "targets/seeds/arc_families.h"

#include <gtest/gtest.h>

#include <numeric>
#include <opencv2/imgproc.hpp>

#include "render_target.h"
#include "targets/edges/edge_chains.h"
#include "targets/edges/pixel_set.h"
#include "targets/seeds/arc_circles.h"
#include "targets/seeds/arc_search.h"

namespace
{
std::vector<omr::EdgeArc> arcsOf(const cv::Mat& image)
{
  omr::EdgelMap map(image);
  omr::ArcTrace trace;
  omr::edgelsOf(map, image.size(), trace.edgels);
  omr::traceArcs(image.size(), trace);
  return trace.arcs;
}

double turningOf(const std::vector<omr::EdgeArc>& arcs)
{
  return std::accumulate(arcs.begin(), arcs.end(), 0.,
                         [](double sum, const omr::EdgeArc& arc) { return sum + arc.turning; });
}

cv::Mat circle(int radius)
{
  cv::Mat image(200, 240, CV_8UC3, cv::Scalar::all(230));
  cv::circle(image, {120, 100}, radius, cv::Scalar::all(30), cv::FILLED, cv::LINE_AA);
  return image;
}
}  // namespace

TEST(EdgeArcs, aCircleTurnsOnceAndIsConcaveToItsCentre)
{
  for (const int radius : {12, 30, 80})
  {
    const std::vector<omr::EdgeArc> arcs = arcsOf(circle(radius));
    EXPECT_NEAR(2 * CV_PI, turningOf(arcs), 1.2) << radius;
    for (const omr::EdgeArc& arc : arcs)
    {
      EXPECT_GT(arc.inwards.dot(cv::Point2d(120, 100) - arc.middle), .9 * radius);
    }
  }
}

TEST(EdgeArcs, straightEdgesAndCornersAreNone)
{
  cv::Mat image(200, 240, CV_8UC3, cv::Scalar::all(230));
  const std::vector<cv::Point> outline = {{30, 40}, {190, 20}, {210, 150}, {60, 180}};
  cv::fillConvexPoly(image, outline, cv::Scalar::all(30), cv::LINE_AA);
  EXPECT_LT(turningOf(arcsOf(image)), 2);  // the four corners turn by 6.3 in all
}

TEST(PixelSet, tellsThePixelsAround)
{
  omr::PixelSet set({37, 20});
  EXPECT_EQ(0U, set.around({0, 0}));
  EXPECT_EQ(0U, set.around({36, 19}));
  for (const cv::Point pixel : {cv::Point(0, 0), cv::Point(7, 5), cv::Point(36, 19)})
  {
    set.set(pixel);
    for (int dy = -2; dy <= 2; ++dy)
    {
      for (int dx = -2; dx <= 2; ++dx)
      {
        const cv::Point from = pixel - cv::Point(dx, dy);
        if (cv::Rect(0, 0, 37, 20).contains(from))
        {
          const std::uint32_t bit = 1U << (5 * (dy + 2) + dx + 2);
          EXPECT_EQ(bit, set.around(from));
          EXPECT_EQ(std::max(std::abs(dx), std::abs(dy)) == 1, (bit & omr::PixelSet::NEAREST) != 0);
        }
      }
    }
    set.reset(pixel);
    EXPECT_EQ(0U, set.around(pixel));
  }
}

TEST(ArcCircles, areWhereTheArcsAreDense)
{
  std::vector<omr::ArcRadius> arcs;
  for (int i = 0; i < 8; ++i)
  {
    arcs.emplace_back(40 + .3 * i, .4);
    arcs.emplace_back(60 - .3 * i, .4);
  }
  for (int i = 0; i < 20; ++i)
  {
    arcs.emplace_back(5 + 13. * i, .4);
  }
  const std::vector<double> radii = omr::circlesOf(arcs);
  ASSERT_EQ(2U, radii.size());
  EXPECT_NEAR(41, radii[0], .6);
  EXPECT_NEAR(59, radii[1], .6);
}

TEST(ArcFamilies, arcsOfHalfHiddenCirclesGiveTheirFamily)
{
  TargetScene scene;
  scene.homography = tiltedView({240, 180}, .6, .4, 1, 4000);
  scene.occluder = .45;
  scene.cover = 38;
  scene.cover_offset = {-20, 15};
  const std::vector<omr::ArcFamily> families = omr::findArcFamilies(arcsOf(renderTarget(scene)));
  ASSERT_FALSE(families.empty());
  EXPECT_NEAR(0, cv::norm(families[0].family.center - projectedCenter(scene)), 2);
  EXPECT_NEAR(1 / std::cos(.6), families[0].family.aspect(), .03);
  ASSERT_LE(3U, families[0].radii.size());
  EXPECT_NEAR(100 * std::sqrt(std::cos(.6)), families[0].radii.back(), 2);
}

TEST(ArcFamilies, aScaleOfAnySizeKeepsPlaceAndSize)
{
  // The search works on a reduced image where there are many pixels.
  TargetScene scene;
  const cv::Mat target = renderTarget(scene);
  for (const cv::Size size : {cv::Size(480, 360), cv::Size(1601, 1203), cv::Size(2600, 2003)})
  {
    cv::Mat image(size, CV_8UC3, cv::Scalar::all(145));
    const cv::Rect place(cv::Point((size.width - target.cols) / 2, (size.height - target.rows) / 2), target.size());
    target.copyTo(image(place));
    const std::vector<omr::ArcFamily> families = omr::searchArcFamilies(image);
    ASSERT_EQ(1U, families.size());
    EXPECT_NEAR(0, cv::norm(families[0].family.center - projectedCenter(scene) - cv::Point2d(place.tl())), .7);
    EXPECT_NEAR(100, families[0].radii.back(), 1.5);
  }
}

TEST(ArcFamilies, circlesMostlyOutsideTheImageAreLeftOut)
{
  const cv::Point center(110, 90);
  cv::Mat image(600, 800, CV_8UC3, cv::Scalar::all(230));
  cv::circle(image, center, 300, cv::Scalar::all(30), cv::FILLED, cv::LINE_AA);  // a third of it is inside
  cv::circle(image, center, 70, cv::Scalar::all(230), cv::FILLED, cv::LINE_AA);
  cv::circle(image, center, 40, cv::Scalar::all(30), cv::FILLED, cv::LINE_AA);
  const std::vector<omr::ArcFamily> families = omr::searchArcFamilies(image);
  ASSERT_EQ(1U, families.size());
  EXPECT_NEAR(70, families[0].radii.back(), 1.5);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
