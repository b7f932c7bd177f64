#include "training_windows.h"

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace omr
{
namespace
{
/** Squares and rings that a level sees [cells]: the mean of the two directions, and the shorter and longer one. */
struct Units
{
  double min, max, shortest, longest;
};
constexpr std::array<Units, MARKER_KINDS> UNITS = {Units{1.45, 3.1, 1., 4.5}, Units{.9, 1.9, .6, 2.8}};

constexpr double MIN_SHARE = .7;        // of a window on a board
constexpr double MAX_OFF_CENTER = 1.8;  // of a window on a target [cells]

cv::Point2d apply(const cv::Matx33d& homography, const cv::Point2d& point)
{
  const cv::Vec3d image = homography * cv::Vec3d(point.x, point.y, 1);
  return {image[0] / image[2], image[1] / image[2]};
}

/** Whether squares or rings have the size for a level around a point of the image. */
bool suits(const Units& units, const cv::Matx33d& to_pixels, const cv::Matx33d& to_marker, const cv::Point2d& at,
           int level)
{
  const cv::Point2d here = apply(to_marker, at);
  const cv::Point2d across = apply(to_pixels, here + cv::Point2d(.5, 0)) - apply(to_pixels, here - cv::Point2d(.5, 0));
  const cv::Point2d down = apply(to_pixels, here + cv::Point2d(0, .5)) - apply(to_pixels, here - cv::Point2d(0, .5));
  // Singular values of the 2 x 2 matrix (across, down): their product and the sum of their squares.
  const double product = std::abs(across.cross(down));
  const double squares = across.dot(across) + down.dot(down);
  const double root = std::sqrt(std::max(0., squares * squares - 4 * product * product));
  const double longer = std::sqrt((squares + root) / 2);
  const double shorter = product / longer;
  const double cell = cellSize(level);
  const double mean = std::sqrt(product);
  return mean >= units.min * cell && mean <= units.max * cell && shorter >= units.shortest * cell &&
         longer <= units.longest * cell;
}

bool covers(const PlacedMarker& marker, const cv::Point2d& point)
{
  if (marker.kind == MarkerKind::target)
  {
    return std::hypot(point.x, point.y) <= static_cast<double>(marker.colors.size());
  }
  return point.x >= 0 && point.y >= 0 && point.x <= marker.squares.width && point.y <= marker.squares.height;
}

WindowLabel labelOf(const cv::Rect& window, int level, const PlacedMarker& marker)
{
  constexpr int GRID = 7;
  const cv::Matx33d to_marker = marker.to_pixels.inv();
  const cv::Point2d center(window.x + (window.width - 1) / 2., window.y + (window.height - 1) / 2.);
  int covered = 0;
  for (int row = 0; row < GRID; ++row)
  {
    for (int col = 0; col < GRID; ++col)
    {
      const cv::Point2d at(window.x - .5 + window.width * (col + .5) / GRID,
                           window.y - .5 + window.height * (row + .5) / GRID);
      covered += static_cast<int>(covers(marker, apply(to_marker, at)));
    }
  }
  if (marker.kind == MarkerKind::checkerboard)
  {
    if (covered >= MIN_SHARE * GRID * GRID &&
        suits(UNITS[static_cast<int>(marker.kind)], marker.to_pixels, to_marker, center, level))
    {
      return WindowLabel::checkerboard;
    }
  }
  else
  {
    const cv::Point2d middle = apply(marker.to_pixels, {0, 0});
    if (cv::norm(middle - center) <= MAX_OFF_CENTER * cellSize(level) &&
        suits(UNITS[static_cast<int>(marker.kind)], marker.to_pixels, to_marker, middle, level))
    {
      return WindowLabel::target;
    }
  }
  return covered > 0 ? WindowLabel::partly : WindowLabel::clutter;
}
}  // namespace

WindowLabel labelOf(const cv::Rect& window, int level, const std::vector<PlacedMarker>& markers)
{
  WindowLabel label = WindowLabel::clutter;
  for (const PlacedMarker& marker : markers)
  {
    const WindowLabel own = labelOf(window, level, marker);
    if (own == WindowLabel::checkerboard || own == WindowLabel::target)
    {
      return own;
    }
    label = own == WindowLabel::partly ? own : label;
  }
  return label;
}

void WindowSet::append(const float* window, WindowLabel label)
{
  features.push_back(cv::Mat(1, HAAR_FEATURES, CV_32FC1, const_cast<float*>(window)));
  labels.push_back(label);
}

void WindowSet::append(const WindowSet& other)
{
  features.push_back(other.features);
  labels.insert(labels.end(), other.labels.begin(), other.labels.end());
  plain_clutter += other.plain_clutter;
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    plain_markers[kind] += other.plain_markers[kind];
  }
}

void addWindows(const cv::Mat& bgr, const std::vector<PlacedMarker>& markers,
                const std::function<bool(const float* features, WindowLabel label)>& wanted, WindowSet& windows)
{
  cv::Mat integral;
  cv::integral(bgr, integral, CV_32S);
  std::array<float, HAAR_FEATURES> features = {};
  for (int level = 0; level < HAAR_LEVELS; ++level)
  {
    const cv::Mat cells = haarCells(integral, level);
    const cv::Size grid = windowGrid(bgr.size(), level);
    for (int i = 0; i < grid.area(); ++i)
    {
      const cv::Point index(i % grid.width, i / grid.width);
      const WindowLabel label = labelOf(windowRect(index, level), level, markers);
      if (label == WindowLabel::partly)
      {
        continue;
      }
      const bool clutter = label == WindowLabel::clutter;
      if (!haarFeatures(cells, index * WINDOW_STRIDE, features.data()))
      {
        (clutter ? windows.plain_clutter : windows.plain_markers[static_cast<int>(label)]) += 1;
      }
      else if (wanted(features.data(), label))
      {
        windows.append(features.data(), label);
      }
    }
  }
}

}  // namespace omr
