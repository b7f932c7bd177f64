#include "gradient_tile.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "median.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int HALO = 3;  // two pixels for the 5x5 kernels, one for the comparison with neighbours
constexpr int SIDE = GradientTile::SIDE;
constexpr int PIXELS = GradientTile::PIXELS + 2 * HALO;
constexpr int CHANNELS = 3;
constexpr int NOISE_SAMPLES = 6;  // tiles along each side of the picture

/** One channel of the tile's pixels, replicated beyond the borders. */
using Plane = std::array<std::array<std::int16_t, PIXELS>, PIXELS>;

/** @param rows the first pixels of the tile's rows. */
OMR_VECTORIZED void splitRows(const std::array<const uchar*, PIXELS>& rows, std::array<Plane, CHANNELS>& planes)
{
  for (int i = 0; i < PIXELS; ++i)
  {
    const uchar* __restrict row = rows[i];
    std::int16_t* __restrict blue = planes[0][i].data();
    std::int16_t* __restrict green = planes[1][i].data();
    std::int16_t* __restrict red = planes[2][i].data();
    for (int j = 0; j < PIXELS; ++j)
    {
      blue[j] = row[CHANNELS * j];
      green[j] = row[CHANNELS * j + 1];
      red[j] = row[CHANNELS * j + 2];
    }
  }
}

void readPixels(const cv::Mat& bgr, int left, int top, std::array<Plane, CHANNELS>& planes)
{
  const int x0 = left - HALO;
  const int first = std::min(PIXELS, std::max(0, -x0));  // of the tile's columns that lie in the image
  const int last = std::max(first, std::min(PIXELS, bgr.cols - x0));
  const bool is_inside = first == 0 && last == PIXELS;
  std::array<std::array<uchar, CHANNELS * PIXELS>, PIXELS> replicated;
  std::array<const uchar*, PIXELS> rows;
  for (int i = 0; i < PIXELS; ++i)
  {
    const auto* row = bgr.ptr<uchar>(std::clamp(top - HALO + i, 0, bgr.rows - 1));
    if (!is_inside)
    {
      const auto copy = [&](int from, int to, int source) {
        std::copy_n(row + CHANNELS * source, CHANNELS * (to - from), &replicated[i][CHANNELS * from]);
      };
      copy(first, last, x0 + first);
      for (int j = 0; j < first; ++j)
      {
        copy(j, j + 1, 0);
      }
      for (int j = last; j < PIXELS; ++j)
      {
        copy(j, j + 1, bgr.cols - 1);
      }
    }
    rows[i] = is_inside ? row + CHANNELS * x0 : replicated[i].data();
  }
  splitRows(rows, planes);
}

/** Gradient of one channel: Sobel and Gaussian in one, separable 5x5 kernels. */
struct ChannelGradient
{
  std::array<std::array<std::int16_t, SIDE>, SIDE> x, y;
};

OMR_VECTORIZED void differentiate(const Plane& plane, ChannelGradient& gradient)
{
  std::array<std::array<std::int16_t, SIDE>, PIXELS> smooth;
  std::array<std::array<std::int16_t, SIDE>, PIXELS> slope;
  for (int i = 0; i < PIXELS; ++i)
  {
    const std::int16_t* p = plane[i].data();
    for (int j = 0; j < SIDE; ++j)
    {
      smooth[i][j] = static_cast<std::int16_t>(p[j] + 4 * p[j + 1] + 6 * p[j + 2] + 4 * p[j + 3] + p[j + 4]);
      slope[i][j] = static_cast<std::int16_t>(p[j + 4] - p[j] + 2 * (p[j + 3] - p[j + 1]));
    }
  }
  for (int i = 0; i < SIDE; ++i)
  {
    for (int j = 0; j < SIDE; ++j)
    {
      gradient.x[i][j] = static_cast<std::int16_t>(slope[i][j] + 4 * slope[i + 1][j] + 6 * slope[i + 2][j] +
                                                   4 * slope[i + 3][j] + slope[i + 4][j]);
      gradient.y[i][j] =
          static_cast<std::int16_t>(smooth[i + 4][j] - smooth[i][j] + 2 * (smooth[i + 3][j] - smooth[i + 1][j]));
    }
  }
}

/** The strongest of the three channels' gradients at each pixel. */
OMR_VECTORIZED void selectStrongest(const std::array<ChannelGradient, CHANNELS>& channels, GradientTile& tile)
{
  for (int i = 0; i < SIDE; ++i)
  {
    for (int j = 0; j < SIDE; ++j)
    {
      int x = channels[0].x[i][j];
      int y = channels[0].y[i][j];
      int strongest = x * x + y * y;
      for (int c = 1; c < CHANNELS; ++c)
      {
        const int other_x = channels[c].x[i][j];
        const int other_y = channels[c].y[i][j];
        const int squared = other_x * other_x + other_y * other_y;
        x = squared > strongest ? other_x : x;
        y = squared > strongest ? other_y : y;
        strongest = squared > strongest ? squared : strongest;
      }
      tile.x[i][j] = static_cast<float>(x);
      tile.y[i][j] = static_cast<float>(y);
      tile.magnitude[i][j] = std::sqrt(static_cast<float>(strongest)) * (1 / GradientTile::KERNEL_SUM);
    }
  }
}
}  // namespace

void computeGradients(const cv::Mat& bgr, int left, int top, GradientTile& tile)
{
  std::array<Plane, CHANNELS> planes;
  readPixels(bgr, left, top, planes);
  std::array<ChannelGradient, CHANNELS> channels;
  for (int c = 0; c < CHANNELS; ++c)
  {
    differentiate(planes[c], channels[c]);
  }
  selectStrongest(channels, tile);
}

float medianMagnitude(const cv::Mat& bgr)
{
  constexpr int TILE = GradientTile::PIXELS;
  const cv::Size grid((bgr.cols + TILE - 1) / TILE, (bgr.rows + TILE - 1) / TILE);
  std::vector<float> sample;
  GradientTile tile;
  const int rows = std::min(grid.height, NOISE_SAMPLES);
  const int cols = std::min(grid.width, NOISE_SAMPLES);
  for (int row = 0; row < rows; ++row)
  {
    for (int col = 0; col < cols; ++col)
    {
      computeGradients(bgr, (2 * col + 1) * grid.width / (2 * cols) * TILE,
                       (2 * row + 1) * grid.height / (2 * rows) * TILE, tile);
      for (int i = 1; i < SIDE; i += 3)
      {
        for (int j = 1; j < SIDE; j += 3)
        {
          sample.push_back(tile.magnitude[i][j]);
        }
      }
    }
  }
  return median(std::move(sample));
}

}  // namespace omr
