#include "edgels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace omr
{
namespace
{
constexpr int TILE = 32;                 // [px]; a small target touches few tiles, a tile's border costs 40 %
constexpr int HALO = 3;                  // two pixels for the 5x5 kernels, one for the comparison with neighbours
constexpr int GRADIENTS = TILE + 2;      // side of the gradient tile [px]
constexpr int PIXELS = TILE + 2 * HALO;  // side of the pixel tile [px]
constexpr int CHANNELS = 3;
constexpr int ROW_WIDTH = CHANNELS * GRADIENTS;
constexpr float KERNEL_SUM = 16;  // of the 3x3 Gaussian, which the 5x5 kernels contain undivided

// The threshold is this multiple of the median gradient of the picture, which is its noise, within these bounds: below
// 12 the compression of clean pictures gives edgels, above 28 dark rings in the shade have none.
constexpr float NOISE_FACTOR = 3;
constexpr float LOWEST_THRESHOLD = 12;
constexpr float HIGHEST_THRESHOLD = 28;
constexpr int NOISE_SAMPLES = 6;  // tiles along each side of the picture

struct GradientTile
{
  std::array<std::array<std::int16_t, GRADIENTS>, GRADIENTS> x, y;
  std::array<std::array<float, GRADIENTS>, GRADIENTS> magnitude;
};

/** One image row of the tile, replicated beyond the borders. */
void readRow(const cv::Mat& bgr, int x0, int y, std::int16_t* out)
{
  const auto* row = bgr.ptr<uchar>(std::clamp(y, 0, bgr.rows - 1));
  if (x0 >= 0 && x0 + PIXELS <= bgr.cols)
  {
    std::copy_n(row + CHANNELS * x0, CHANNELS * PIXELS, out);
    return;
  }
  for (int i = 0; i < PIXELS; ++i)
  {
    const auto* pixel = row + CHANNELS * std::clamp(x0 + i, 0, bgr.cols - 1);
    std::copy_n(pixel, CHANNELS, out + CHANNELS * i);
  }
}

/** Gradients of the tile's pixels and of one more around; Sobel and Gaussian in one: separable 5x5 kernels. */
void computeGradients(const cv::Mat& bgr, int tile_x, int tile_y, GradientTile& tile)
{
  std::array<std::int16_t, CHANNELS * PIXELS> pixels;
  std::array<std::array<std::int16_t, ROW_WIDTH>, PIXELS> smooth;
  std::array<std::array<std::int16_t, ROW_WIDTH>, PIXELS> slope;
  for (int i = 0; i < PIXELS; ++i)
  {
    readRow(bgr, tile_x - HALO, tile_y - HALO + i, pixels.data());
    const std::int16_t* p = pixels.data();
    for (int j = 0; j < ROW_WIDTH; ++j)
    {
      smooth[i][j] = static_cast<std::int16_t>(p[j] + 4 * p[j + 3] + 6 * p[j + 6] + 4 * p[j + 9] + p[j + 12]);
      slope[i][j] = static_cast<std::int16_t>(p[j + 12] - p[j] + 2 * (p[j + 9] - p[j + 3]));
    }
  }
  std::array<std::int16_t, ROW_WIDTH> gx;
  std::array<std::int16_t, ROW_WIDTH> gy;
  std::array<int, ROW_WIDTH> squared;
  for (int i = 0; i < GRADIENTS; ++i)
  {
    for (int j = 0; j < ROW_WIDTH; ++j)
    {
      gx[j] = static_cast<std::int16_t>(slope[i][j] + 4 * slope[i + 1][j] + 6 * slope[i + 2][j] + 4 * slope[i + 3][j] +
                                        slope[i + 4][j]);
      gy[j] = static_cast<std::int16_t>(smooth[i + 4][j] - smooth[i][j] + 2 * (smooth[i + 3][j] - smooth[i + 1][j]));
    }
    for (int j = 0; j < ROW_WIDTH; ++j)
    {
      squared[j] = gx[j] * gx[j] + gy[j] * gy[j];
    }
    for (int j = 0; j < GRADIENTS; ++j)
    {
      const int c = CHANNELS * j;
      const int first = squared[c + 1] > squared[c] ? c + 1 : c;
      const int strongest = squared[c + 2] > squared[first] ? c + 2 : first;
      tile.x[i][j] = gx[strongest];
      tile.y[i][j] = gy[strongest];
      tile.magnitude[i][j] = static_cast<float>(squared[strongest]);
    }
    for (float& magnitude : tile.magnitude[i])
    {
      magnitude = std::sqrt(magnitude) / KERNEL_SUM;
    }
  }
}

/** Appends the edgel of gradient pixel (j, i) if its magnitude is the largest along the gradient. */
void addEdgel(const GradientTile& tile, int i, int j, int tile_x, int tile_y, std::vector<Edgel>& edgels)
{
  const float here = tile.magnitude[i][j];
  const float length = here * KERNEL_SUM;
  const float nx = tile.x[i][j] / length;
  const float ny = tile.y[i][j] / length;
  const float ax = std::abs(nx);
  const float ay = std::abs(ny);
  // The two neighbours along the gradient, interpolated on the ring of eight pixels.
  const int sx = nx >= 0 ? 1 : -1;
  const int sy = ny >= 0 ? 1 : -1;
  float ahead;
  float behind;
  if (ax >= ay)
  {
    const float t = ay / ax;
    ahead = (1 - t) * tile.magnitude[i][j + sx] + t * tile.magnitude[i + sy][j + sx];
    behind = (1 - t) * tile.magnitude[i][j - sx] + t * tile.magnitude[i - sy][j - sx];
  }
  else
  {
    const float t = ax / ay;
    ahead = (1 - t) * tile.magnitude[i + sy][j] + t * tile.magnitude[i + sy][j + sx];
    behind = (1 - t) * tile.magnitude[i - sy][j] + t * tile.magnitude[i - sy][j - sx];
  }
  if (here < ahead || here <= behind)
  {
    return;
  }
  const float curvature = ahead + behind - 2 * here;
  const float offset = curvature < -1e-3F ? std::clamp((behind - ahead) / (2 * curvature), -.7F, .7F) : 0.F;
  const float step = offset / std::max(ax, ay);
  edgels.push_back({tile_x + j - 1 + step * nx, tile_y + i - 1 + step * ny, nx, ny, here});
}

/** Median magnitude of a few tiles spread over the picture. */
float medianMagnitude(const cv::Mat& bgr, const cv::Size& grid)
{
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
      for (int i = 1; i < GRADIENTS; i += 3)
      {
        for (int j = 1; j < GRADIENTS; j += 3)
        {
          sample.push_back(tile.magnitude[i][j]);
        }
      }
    }
  }
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  return *middle;
}
}  // namespace

EdgelMap::EdgelMap(const cv::Mat& bgr)
    : bgr_(bgr),
      grid_((bgr.cols + TILE - 1) / TILE, (bgr.rows + TILE - 1) / TILE),
      tiles_(static_cast<std::size_t>(grid_.area()))
{
  threshold_ = std::clamp(NOISE_FACTOR * medianMagnitude(bgr, grid_), LOWEST_THRESHOLD, HIGHEST_THRESHOLD);
}

cv::Rect EdgelMap::tilesOf(double left, double top, double right, double bottom) const
{
  // An edgel may lie up to a pixel outside the tile of the pixel that gave it.
  const auto index = [](double position, int limit) {
    return static_cast<int>(std::clamp(std::floor(position / TILE), 0., limit - 1.));
  };
  const int x0 = index(left - 1, grid_.width);
  const int y0 = index(top - 1, grid_.height);
  return {x0, y0, index(right + 1, grid_.width) - x0 + 1, index(bottom + 1, grid_.height) - y0 + 1};
}

const std::vector<Edgel>& EdgelMap::tile(int col, int row)
{
  Tile& tile = tiles_[static_cast<std::size_t>(row) * grid_.width + col];
  if (!tile.computed)
  {
    tile.computed = true;
    GradientTile gradients;
    computeGradients(bgr_, col * TILE, row * TILE, gradients);
    // The picture's outermost pixels have no neighbours to compare with.
    const int last_row = std::min(TILE, bgr_.rows - 1 - row * TILE);
    const int last_col = std::min(TILE, bgr_.cols - 1 - col * TILE);
    for (int i = row == 0 ? 2 : 1; i <= last_row; ++i)
    {
      for (int j = col == 0 ? 2 : 1; j <= last_col; ++j)
      {
        if (gradients.magnitude[i][j] >= threshold_)
        {
          addEdgel(gradients, i, j, col * TILE, row * TILE, tile.edgels);
        }
      }
    }
  }
  return tile.edgels;
}

}  // namespace omr
