#ifndef OUTDOOR_OMR_TOOLS_MARKER_SCENE_H
#define OUTDOOR_OMR_TOOLS_MARKER_SCENE_H

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "outdoor_omr/marker_network.h"

namespace omr
{
/** A marker in a rendered picture. */
struct PlacedMarker
{
  MarkerKind kind = MarkerKind::checkerboard;
  cv::Size squares;       ///< checkerboard: columns and rows
  std::string colors;     ///< target: from the inside out
  cv::Matx33d to_pixels;  ///< marker's plane -> px. Unit: a square, a ring; origin: first corner of the board, centre
                          ///< of the rings
};

/** The upright box of a marker in its picture [px]. */
cv::Rect boxOf(const PlacedMarker& marker);

/** A picture with known markers. */
struct MarkerScene
{
  cv::Mat image;  ///< CV_8UC3
  std::vector<PlacedMarker> markers;
};

/**
 * Renders a picture with one to nine markers as an outdoor camera may see them: boards of 5x7 to 21x21 squares and
 * targets of any ring colours, squares and rings of 2.5 to 24 px, under perspective, uneven light and shadows, blurred,
 * noisy and coded as JPEG.
 *
 * @param background CV_8UC3, at least 32 px wide and high; a random part of it, of random size, fills the picture.
 * @param random     all that is random comes from it.
 */
MarkerScene renderMarkerScene(const cv::Mat& background, cv::RNG& random);

}  // namespace omr

#endif
