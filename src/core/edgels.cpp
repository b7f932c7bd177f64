#include "edgels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

// The loops over a tile's rows take the widest vectors that the processor has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define OMR_VECTORIZED __attribute__((target_clones("avx2", "default"), optimize("O3")))
#else
#define OMR_VECTORIZED
#endif

namespace omr
{
namespace
{
constexpr int TILE = 30;                 // [px]; a small target touches few tiles, a tile's border costs 44 %
constexpr int HALO = 3;                  // two pixels for the 5x5 kernels, one for the comparison with neighbours
constexpr int GRADIENTS = TILE + 2;      // side of the gradient tile [px]: a multiple of the vectors' length
constexpr int PIXELS = TILE + 2 * HALO;  // side of the pixel tile [px]
constexpr int CHANNELS = 3;
constexpr float KERNEL_SUM = 16;  // of the 3x3 Gaussian, which the 5x5 kernels contain undivided

// The threshold is this multiple of the median gradient of the picture, which is its noise, within these bounds: below
// 12 the compression of clean pictures gives edgels, above 28 dark rings in the shade have none.
constexpr float NOISE_FACTOR = 3;
constexpr float LOWEST_THRESHOLD = 12;
constexpr float HIGHEST_THRESHOLD = 28;
constexpr std::size_t TILE_LOOKS = 100;  // that computing a tile takes the time of
constexpr int NOISE_SAMPLES = 6;         // tiles along each side of the picture

struct GradientTile
{
  std::array<std::array<std::int16_t, GRADIENTS>, GRADIENTS> x, y;
  std::array<std::array<float, GRADIENTS>, GRADIENTS> magnitude;
};

/** One channel of the tile's pixels, replicated beyond the borders. */
using Plane = std::array<std::array<std::int16_t, PIXELS>, PIXELS>;

OMR_VECTORIZED void splitRow(const uchar* row, std::int16_t* blue, std::int16_t* green, std::int16_t* red)
{
  for (int j = 0; j < PIXELS; ++j)
  {
    blue[j] = row[CHANNELS * j];
    green[j] = row[CHANNELS * j + 1];
    red[j] = row[CHANNELS * j + 2];
  }
}

void readPixels(const cv::Mat& bgr, int tile_x, int tile_y, std::array<Plane, CHANNELS>& planes)
{
  const int x0 = tile_x - HALO;
  const bool is_inside = x0 >= 0 && x0 + PIXELS <= bgr.cols;
  std::array<uchar, CHANNELS * PIXELS> replicated;
  for (int i = 0; i < PIXELS; ++i)
  {
    const auto* row = bgr.ptr<uchar>(std::clamp(tile_y - HALO + i, 0, bgr.rows - 1));
    for (int j = 0; j < PIXELS && !is_inside; ++j)
    {
      std::copy_n(row + CHANNELS * std::clamp(x0 + j, 0, bgr.cols - 1), CHANNELS, replicated.data() + CHANNELS * j);
    }
    splitRow(is_inside ? row + CHANNELS * x0 : replicated.data(), planes[0][i].data(), planes[1][i].data(),
             planes[2][i].data());
  }
}

/** Gradient of one channel: Sobel and Gaussian in one, separable 5x5 kernels. */
struct ChannelGradient
{
  std::array<std::array<std::int16_t, GRADIENTS>, GRADIENTS> x, y;
};

OMR_VECTORIZED void differentiate(const Plane& plane, ChannelGradient& gradient)
{
  std::array<std::array<std::int16_t, GRADIENTS>, PIXELS> smooth;
  std::array<std::array<std::int16_t, GRADIENTS>, PIXELS> slope;
  for (int i = 0; i < PIXELS; ++i)
  {
    const std::int16_t* p = plane[i].data();
    for (int j = 0; j < GRADIENTS; ++j)
    {
      smooth[i][j] = static_cast<std::int16_t>(p[j] + 4 * p[j + 1] + 6 * p[j + 2] + 4 * p[j + 3] + p[j + 4]);
      slope[i][j] = static_cast<std::int16_t>(p[j + 4] - p[j] + 2 * (p[j + 3] - p[j + 1]));
    }
  }
  for (int i = 0; i < GRADIENTS; ++i)
  {
    for (int j = 0; j < GRADIENTS; ++j)
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
  for (int i = 0; i < GRADIENTS; ++i)
  {
    for (int j = 0; j < GRADIENTS; ++j)
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
      tile.x[i][j] = static_cast<std::int16_t>(x);
      tile.y[i][j] = static_cast<std::int16_t>(y);
      tile.magnitude[i][j] = std::sqrt(static_cast<float>(strongest)) * (1 / KERNEL_SUM);
    }
  }
}

/** Gradients of the tile's pixels and of one more around. */
void computeGradients(const cv::Mat& bgr, int tile_x, int tile_y, GradientTile& tile)
{
  std::array<Plane, CHANNELS> planes;
  readPixels(bgr, tile_x, tile_y, planes);
  std::array<ChannelGradient, CHANNELS> channels;
  for (int c = 0; c < CHANNELS; ++c)
  {
    differentiate(planes[c], channels[c]);
  }
  selectStrongest(channels, tile);
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

EdgelMap::EdgelMap(const cv::Mat& bgr, std::size_t max_looks)
    : bgr_(bgr),
      max_looks_(max_looks),
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
    looks_ += TILE_LOOKS;
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
