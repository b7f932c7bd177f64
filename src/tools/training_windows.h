#ifndef OUTDOOR_OMR_TOOLS_TRAINING_WINDOWS_H
#define OUTDOOR_OMR_TOOLS_TRAINING_WINDOWS_H

#include <array>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "marker_scene.h"
#include "outdoor_omr/haar_features.h"

namespace omr
{
/** What a window shows. */
enum class WindowLabel
{
  checkerboard,
  target,
  clutter,
  partly  ///< a marker's edge, or a marker of another size: neither right nor wrong
};

/**
 * Checkerboard: at least 0.7 of the window lies on a board whose squares suit its level. Target: the centre of rings
 * that suit its level is within 1.8 cells of the window's.
 */
WindowLabel labelOf(const cv::Rect& window, int level, const std::vector<PlacedMarker>& markers);

/** Windows that the network can learn from: rows of features, and labels. */
struct WindowSet
{
  cv::Mat features;  ///< N x HAAR_FEATURES, CV_32FC1
  cv::Mat gate;      ///< N x GATE_INPUTS, CV_32FC1
  std::vector<WindowLabel> labels;
  std::array<long, MARKER_KINDS> plain_markers = {};  ///< windows with a marker that lack the contrast for features, or
                                                      ///< that the gate rejects
  long plain_clutter = 0;                             ///< such windows without one

  void append(const float* window, const float* gate_inputs, WindowLabel label);
  void append(const WindowSet& other);
};

/**
 * Adds the windows of an image, but for those that show a marker partly.
 *
 * @param markers in the image; none in a photograph without.
 * @param gate    windows that do not pass it have no features.
 * @param drawn   whether a window is looked at at all; features take most of the time.
 * @param wanted  of the windows with features: whether one is added.
 */
void addWindows(const cv::Mat& bgr, const std::vector<PlacedMarker>& markers, const FeedForward& gate,
                const std::function<bool(WindowLabel label)>& drawn,
                const std::function<bool(const float* features, WindowLabel label)>& wanted, WindowSet& windows);

}  // namespace omr

#endif
