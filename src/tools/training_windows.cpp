#include "training_windows.h"

#include <array>
#include <cmath>

#include "outdoor_omr/each_window.h"
#include "outdoor_omr/window_scores.h"

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

constexpr int MARGIN = 4;  // of a marker's box, whose circles have corners [px]

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
    const auto rings = static_cast<double>(marker.colors.size());
    return point.dot(point) <= rings * rings;
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

void WindowSet::append(const float* window, const float* gate_inputs, WindowLabel label)
{
  features.push_back(cv::Mat(1, HAAR_FEATURES, CV_32FC1, const_cast<float*>(window)));
  gate.push_back(cv::Mat(1, GATE_INPUTS, CV_32FC1, const_cast<float*>(gate_inputs)));
  labels.push_back(label);
}

void WindowSet::append(const WindowSet& other)
{
  if (!other.labels.empty())
  {
    features.push_back(other.features);
    gate.push_back(other.gate);
  }
  labels.insert(labels.end(), other.labels.begin(), other.labels.end());
  plain_clutter += other.plain_clutter;
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    plain_markers[kind] += other.plain_markers[kind];
  }
}

void addWindows(const cv::Mat& bgr, const std::vector<PlacedMarker>& markers, const FeedForward& gate,
                const std::function<bool(WindowLabel label)>& drawn,
                const std::function<bool(const float* features, WindowLabel label)>& wanted, WindowSet& windows)
{
  std::array<float, HAAR_FEATURES> features = {};
  std::array<float, GATE_INPUTS> inputs = {};
  std::vector<cv::Rect> boxes;
  for (const PlacedMarker& marker : markers)
  {
    const cv::Rect box = boxOf(marker);
    boxes.push_back(box + cv::Size(2 * MARGIN, 2 * MARGIN) - cv::Point(MARGIN, MARGIN));
  }
  std::vector<PlacedMarker> near;
  forEachWindow(bgr, [&](const cv::Mat& cells, const cv::Point& first, const cv::Point& index, int level) {
    const cv::Rect window = windowRect(index, level);
    near.clear();
    for (std::size_t i = 0; i < markers.size(); ++i)
    {
      if (!(boxes[i] & window).empty())
      {
        near.push_back(markers[i]);
      }
    }
    const WindowLabel label = labelOf(window, level, near);
    if (label == WindowLabel::partly || !drawn(label))
    {
      return;
    }
    if (!passesGate(cells, first, gate) || !haarFeatures(cells, first, features.data()))
    {
      const bool clutter = label == WindowLabel::clutter;
      (clutter ? windows.plain_clutter : windows.plain_markers[static_cast<int>(label)]) += 1;
    }
    else if (wanted(features.data(), label))
    {
      gateInputs(cells, first, inputs.data());
      windows.append(features.data(), inputs.data(), label);
    }
  });
}

}  // namespace omr
