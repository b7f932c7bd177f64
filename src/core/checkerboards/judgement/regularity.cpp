#include "regularity.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "checkerboards/corners/local_frame.h"

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

/** One square of the board as the inner corners give it, and what a region needs to claim its place. */
struct Square
{
  explicit Square(const cv::Point2f* quad) : center((quad[0] + quad[1] + quad[2] + quad[3]) / 4)
  {
    constexpr float MAX_OFFSET = 0.25F;
    const cv::Point2f first = quad[2] - quad[0];
    const cv::Point2f second = quad[3] - quad[1];
    area = std::abs(cross(first, second)) / 2;
    reach = MAX_OFFSET * std::min(length(first), length(second));
  }

  bool admits(const Region& region, const cv::Point2f& forecast) const
  {
    constexpr float MIN_AREA_SHARE = 1.F / 6;
    constexpr float MAX_AREA_SHARE = 1.2F;
    const auto region_area = static_cast<float>(region.area);
    return region_area > MIN_AREA_SHARE * area && region_area < MAX_AREA_SHARE * area &&
           length(cv::Point2f(region.center) - forecast) < reach;
  }

  cv::Point2f center;
  float area = 0;   // [px^2]
  float reach = 0;  // [px]
};

Regularity countSeen(const std::vector<cv::Point2f>& forecast, const std::vector<Square>& squares,
                     const std::vector<const Region*>& regions)
{
  Regularity result;
  result.seen.reserve(squares.size());
  int seen = 0;
  for (std::size_t i = 0; i < squares.size(); ++i)
  {
    const auto claims = std::count_if(regions.begin(), regions.end(),
                                      [&](const Region* region) { return squares[i].admits(*region, forecast[i]); });
    result.seen.push_back(claims == 1);
    result.claimed_twice += claims > 1 ? 1 : 0;
    seen += claims == 1 ? 1 : 0;
  }
  result.share = static_cast<double>(seen) / static_cast<double>(squares.size());
  return result;
}

/**
 * Whether the picture goes on over a square's place as over its diagonal neighbours, and unlike its adjacent ones: a
 * light square of the rim, which is one region with the margin. In all of the square, so that nothing lies upon it.
 */
bool meltsIntoMargin(const cv::Mat& grey, const std::vector<Square>& squares, const std::vector<bool>& seen, int rows,
                     int cols, int index)
{
  constexpr float MIN_CONTRAST = 10;  // grey levels
  float sums[2] = {0, 0};             // adjacent, diagonal
  int counts[2] = {0, 0};
  const int row = index / cols;
  const int col = index % cols;
  for (int i = std::max(row - 1, 0); i <= std::min(row + 1, rows - 1); ++i)
  {
    for (int j = std::max(col - 1, 0); j <= std::min(col + 1, cols - 1); ++j)
    {
      const int neighbour = i * cols + j;
      if (seen[neighbour])
      {
        const int diagonal = i != row && j != col ? 1 : 0;
        const cv::Point2f& center = squares[neighbour].center;
        sums[diagonal] += sampleGrey(grey, center.x, center.y);
        ++counts[diagonal];
      }
    }
  }
  if (counts[0] == 0 || counts[1] == 0)
  {
    return false;
  }
  const float diagonal = sums[1] / static_cast<float>(counts[1]);
  const float contrast = std::abs(diagonal - sums[0] / static_cast<float>(counts[0]));
  const Square& square = squares[index];
  const auto alike = [&](const cv::Point2f& offset) {
    const cv::Point2f at = square.center + offset;
    return isInside(grey, at, 0) && std::abs(sampleGrey(grey, at.x, at.y) - diagonal) < contrast / 2;
  };
  const cv::Point2f across(square.reach, 0);
  const cv::Point2f down(0, square.reach);
  return contrast > MIN_CONTRAST && alike({}) && alike(across) && alike(-across) && alike(down) && alike(-down);
}

void addMeltedSquares(const cv::Mat& grey, const std::vector<Square>& squares, int rows, int cols, Regularity& result)
{
  const std::vector<bool> regions_seen = result.seen;
  for (int i = 0; i < rows * cols; ++i)
  {
    const bool rim = i / cols == 0 || i / cols == rows - 1 || i % cols == 0 || i % cols == cols - 1;
    if (rim && !regions_seen[i])
    {
      result.seen[i] = meltsIntoMargin(grey, squares, regions_seen, rows, cols, i);
    }
  }
  const auto seen = std::count(result.seen.begin(), result.seen.end(), true);
  result.share = static_cast<double>(seen) / static_cast<double>(squares.size());
}

/** The forecast from the four outer squares among those seen; empty if there are not four. */
std::vector<cv::Point2f> forecastFromOuterSquares(const std::vector<Square>& squares, const std::vector<bool>& seen,
                                                  int rows, int cols, const std::vector<const Region*>& regions)
{
  std::vector<cv::Point2f> centers;
  std::vector<cv::Point> places;
  for (int i = 0; i < rows * cols; ++i)
  {
    const Square& square = squares[i];
    if (seen[i])
    {
      const auto region = std::find_if(regions.begin(), regions.end(),
                                       [&](const Region* claims) { return square.admits(*claims, square.center); });
      centers.emplace_back((*region)->center);
      places.emplace_back(i % cols, i / cols);
    }
  }
  const std::vector<cv::Point2f> outer = findOuterSquares(centers);
  std::vector<cv::Point> outer_places;
  outer_places.reserve(outer.size());
  for (const cv::Point2f& square : outer)
  {
    outer_places.push_back(places[std::find(centers.begin(), centers.end(), square) - centers.begin()]);
  }
  return outer.empty() ? outer : forecastSquares(outer, outer_places, rows, cols);
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

std::vector<cv::Point2f> forecastSquares(const std::vector<cv::Point2f>& outer, const std::vector<cv::Point>& places,
                                         int rows, int cols)
{
  if (outer.size() != 4 || places.size() != 4 || rows < 2 || cols < 2)
  {
    throw std::invalid_argument("expected four outer squares of a board of at least 2 x 2 squares");
  }
  for (int i = 0; i < 4; ++i)
  {
    const cv::Point before = places[(i + 3) % 4] - places[i];
    const cv::Point after = places[(i + 1) % 4] - places[i];
    if (before.cross(after) == 0)
    {
      return {};
    }
  }
  std::vector<cv::Point2f> forecast;
  for (int i = 0; i < rows; ++i)
  {
    for (int j = 0; j < cols; ++j)
    {
      forecast.emplace_back(static_cast<float>(j), static_cast<float>(i));
    }
  }
  const std::vector<cv::Point2f> from(places.begin(), places.end());
  cv::perspectiveTransform(forecast, forecast, cv::getPerspectiveTransform(from, outer));
  return forecast;
}

Regularity checkRegularity(const std::vector<cv::Point2f>& quads, int rows, int cols, const RegionMap& regions,
                           const cv::Mat& grey)
{
  if (rows < 2 || cols < 2 || quads.size() != 4 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols))
  {
    throw std::invalid_argument("expected four corners for each of at least 2 x 2 squares");
  }
  std::vector<Square> squares;
  std::vector<cv::Point2f> centers;
  for (std::size_t i = 0; i < quads.size(); i += 4)
  {
    squares.emplace_back(&quads[i]);
    centers.push_back(squares.back().center);
  }
  const cv::Rect2f board(cv::boundingRect(quads));
  std::vector<const Region*> on_board;
  for (const Region& region : regions.regions)
  {
    if (board.contains(cv::Point2f(region.center)))
    {
      on_board.push_back(&region);
    }
  }
  Regularity result = countSeen(centers, squares, on_board);
  const std::vector<cv::Point2f> forecast = forecastFromOuterSquares(squares, result.seen, rows, cols, on_board);
  if (!forecast.empty())
  {
    const Regularity plain = countSeen(forecast, squares, on_board);
    result = plain.share >= result.share ? plain : result;
  }
  addMeltedSquares(grey, squares, rows, cols, result);
  return result;
}

}  // namespace omr
