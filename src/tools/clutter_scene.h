#ifndef OUTDOOR_OMR_TOOLS_CLUTTER_SCENE_H
#define OUTDOOR_OMR_TOOLS_CLUTTER_SCENE_H

#include <opencv2/core.hpp>

namespace omr
{
/**
 * Renders a picture without a marker but with a pattern that resembles one, as sites have them: bricks, tiles, grilles,
 * stripes, dots, gingham, lettering, mosaics, bull's eyes of two rings, windows. Light, view and camera are those of
 * renderMarkerScene(), and so are background and random.
 */
cv::Mat renderClutterScene(const cv::Mat& background, cv::RNG& random);

}  // namespace omr

#endif
