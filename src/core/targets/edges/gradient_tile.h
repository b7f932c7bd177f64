#ifndef OUTDOOR_OMR_CORE_GRADIENT_TILE_H
#define OUTDOOR_OMR_CORE_GRADIENT_TILE_H

#include <array>
#include <opencv2/core.hpp>

namespace omr
{
/** Colour gradients of a square of pixels and of one pixel more around. */
struct GradientTile
{
  static constexpr int PIXELS = 30;        // a side; a small target touches few tiles, a tile's border costs 44 %
  static constexpr int SIDE = PIXELS + 2;  // a multiple of the vectors' length
  static constexpr float KERNEL_SUM = 16;  // of the 3x3 Gaussian, which x and y contain undivided

  std::array<std::array<float, SIDE>, SIDE> x, y;       ///< whole numbers
  std::array<std::array<float, SIDE>, SIDE> magnitude;  ///< [grey levels]
};

/**
 * The gradient of the strongest of B, G and R: the 3x3 Sobel response on the 3x3 Gaussian.
 *
 * @param bgr  H x W, CV_8UC3, replicated beyond its borders.
 * @param left, top the first pixel, which has index (1, 1) in the tile.
 */
void computeGradients(const cv::Mat& bgr, int left, int top, GradientTile& tile);

/** Median magnitude of a few tiles spread over the picture, not empty: its noise [grey levels]. */
float medianMagnitude(const cv::Mat& bgr);

}  // namespace omr

#endif
