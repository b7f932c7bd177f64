#include "arc_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "edge_arcs.h"

namespace omr
{
namespace
{
constexpr double MAX_PIXELS = 550000;  // that arcs are traced in

constexpr float STRENGTH = 1.3F;  // of the edgels, relative to the weakest: texture gives weak ones

constexpr double LEAST_INSIDE = .42;  // of a circle: a target of which less can be seen is none

/** Share of the circle that lies in the image. */
double shareInside(const RingFamily& family, double radius, const cv::Size& image_size)
{
  constexpr int DIRECTIONS = 32;
  const cv::Rect2d image(cv::Point2d(), image_size);
  int inside = 0;
  for (int i = 0; i < DIRECTIONS; ++i)
  {
    const double angle = 2 * CV_PI * i / DIRECTIONS;
    inside += image.contains(family.toImage(radius * cv::Point2d(std::cos(angle), std::sin(angle)))) ? 1 : 0;
  }
  return inside / static_cast<double>(DIRECTIONS);
}

/** Takes away the largest circles, as of arcs that are nearly straight, while hardly any of them is in the image. */
void dropOutside(const cv::Size& image_size, ArcFamily& family)
{
  while (!family.radii.empty() && shareInside(family.family, family.radii.back(), image_size) < LEAST_INSIDE)
  {
    family.radii.pop_back();
  }
}

/** The arcs of the strong edges in the reduced picture. */
void findArcs(const cv::Mat& bgr, int reduction, const cv::Size& size, ArcTrace& trace)
{
  {
    cv::Mat reduced = bgr;
    if (reduction > 1)
    {
      // Whole blocks of pixels, so that the scale is exact.
      cv::resize(bgr(cv::Rect(cv::Point(), size * reduction)), reduced, size, 0, 0, cv::INTER_AREA);
    }
    EdgelMap map(reduced);
    map.raiseThreshold(STRENGTH);
    edgelsOf(map, size, trace.edgels);
  }  // what the next step does not need is gone before it
  traceArcs(size, trace);
}
}  // namespace

int arcReduction(const cv::Size& image_size)
{
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(image_size.area()) / MAX_PIXELS)));
}

std::vector<ArcFamily> searchArcFamilies(const cv::Mat& bgr)
{
  const int reduction = arcReduction(bgr.size());
  const cv::Size size(std::max(1, bgr.cols / reduction), std::max(1, bgr.rows / reduction));
  thread_local ArcTrace trace;  // of the thread that searches one image after the other
  findArcs(bgr, reduction, size, trace);
  std::vector<ArcFamily> families = findArcFamilies(trace.arcs);
  for (ArcFamily& family : families)
  {
    const double shift = (reduction - 1) / 2.;  // of the centre of a block
    family.family.center = family.family.center * reduction + cv::Point2d(shift, shift);
    for (double& radius : family.radii)
    {
      radius *= reduction;
    }
    dropOutside(bgr.size(), family);
  }
  families.erase(
      std::remove_if(families.begin(), families.end(), [](const ArcFamily& family) { return family.radii.empty(); }),
      families.end());
  return families;
}

}  // namespace omr
