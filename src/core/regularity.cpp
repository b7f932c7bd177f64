#include "outdoor_omr/regularity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "outdoor_omr/local_frame.h"

namespace omr
{
namespace
{
/** Inner angle at a vertex of a polygon [radians]. */
double vertexAngle(const std::vector<cv::Point2f>& polygon, std::size_t vertex)
{
  const cv::Point2f before = polygon[(vertex + polygon.size() - 1) % polygon.size()] - polygon[vertex];
  const cv::Point2f after = polygon[(vertex + 1) % polygon.size()] - polygon[vertex];
  return std::abs(std::atan2(cross(before, after), before.dot(after)));
}
}  // namespace

std::vector<cv::Point2f> findOuterSquares(const std::vector<cv::Point2f>& centers)
{
  constexpr double MAX_DIFFERENCE = 50 * CV_PI / 180;
  std::vector<cv::Point2f> hull;
  if (centers.size() >= 4)
  {
    cv::convexHull(centers, hull, true);
  }
  if (hull.size() < 4)
  {
    return {};
  }
  std::vector<std::size_t> sharpest(hull.size());
  std::iota(sharpest.begin(), sharpest.end(), 0);
  std::stable_sort(sharpest.begin(), sharpest.end(),
                   [&](std::size_t a, std::size_t b) { return vertexAngle(hull, a) < vertexAngle(hull, b); });
  sharpest.resize(4);
  std::sort(sharpest.begin(), sharpest.end());
  const auto difference = [&](int a, int b) {
    return std::abs(vertexAngle(hull, sharpest[a]) - vertexAngle(hull, sharpest[b]));
  };
  if (difference(0, 2) > MAX_DIFFERENCE || difference(1, 3) > MAX_DIFFERENCE)
  {
    return {};
  }
  std::vector<cv::Point2f> outer;
  outer.reserve(sharpest.size());
  for (const std::size_t vertex : sharpest)
  {
    outer.push_back(hull[vertex]);
  }
  return outer;
}

std::vector<cv::Point2f> forecastSquares(const std::vector<cv::Point2f>& outer, int rows, int cols)
{
  if (outer.size() != 4 || rows < 2 || cols < 2)
  {
    throw std::invalid_argument("expected four outer squares of a board of at least 2 x 2 squares");
  }
  const auto right = static_cast<float>(cols - 1);
  const auto bottom = static_cast<float>(rows - 1);
  const std::vector<cv::Point2f> places = {{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
  std::vector<cv::Point2f> forecast;
  for (int i = 0; i < rows; ++i)
  {
    for (int j = 0; j < cols; ++j)
    {
      forecast.emplace_back(static_cast<float>(j), static_cast<float>(i));
    }
  }
  cv::perspectiveTransform(forecast, forecast, cv::getPerspectiveTransform(places, outer));
  return forecast;
}

Regularity checkRegularity(const std::vector<cv::Point2f>& quads, const RegionMap& regions)
{
  constexpr float MAX_OFFSET = 0.25F;  // of the square's shorter diagonal
  constexpr float MIN_AREA_SHARE = 1.F / 6;
  constexpr float MAX_AREA_SHARE = 1.2F;
  const std::size_t count = quads.size() / 4;
  Regularity result;
  result.seen.assign(count, false);
  if (count == 0)
  {
    return result;
  }
  const cv::Rect2f board(cv::boundingRect(quads));
  std::vector<const Region*> near;
  for (const Region& region : regions.regions)
  {
    if (board.contains(cv::Point2f(region.center)))
    {
      near.push_back(&region);
    }
  }
  int seen = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const cv::Point2f* quad = &quads[4 * i];
    const cv::Point2f first = quad[2] - quad[0];
    const cv::Point2f second = quad[3] - quad[1];
    const float area = std::abs(cross(first, second)) / 2;
    const float reach = MAX_OFFSET * std::min(length(first), length(second));
    const cv::Point2f center = (quad[0] + quad[1] + quad[2] + quad[3]) / 4;
    const auto claims = std::count_if(near.begin(), near.end(), [&](const Region* region) {
      const auto region_area = static_cast<float>(region->area);
      return region_area > MIN_AREA_SHARE * area && region_area < MAX_AREA_SHARE * area &&
             length(cv::Point2f(region->center) - center) < reach;
    });
    result.seen[i] = claims == 1;
    result.claimed_twice += claims > 1 ? 1 : 0;
    seen += claims == 1 ? 1 : 0;
  }
  result.share = static_cast<double>(seen) / static_cast<double>(count);
  return result;
}

}  // namespace omr
