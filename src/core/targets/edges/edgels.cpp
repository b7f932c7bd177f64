#include "edgels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core/hal/intrin.hpp>
#include <utility>

#include "gradient_tile.h"
#include "lane_list.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int TILE = GradientTile::PIXELS;
constexpr int SIDE = GradientTile::SIDE;

// The threshold is this multiple of the median gradient of the picture, which is its noise, within these bounds: below
// 12 the compression of clean pictures gives edgels, above 28 dark rings in the shade have none.
constexpr float NOISE_FACTOR = 3;
constexpr float LOWEST_THRESHOLD = 12;
constexpr float HIGHEST_THRESHOLD = 28;
constexpr std::size_t TILE_LOOKS = 100;  // that computing a tile takes the time of
constexpr int LANES = LaneList::LANES;

/** Pixels side by side, and the magnitudes one step along their gradient and against it. */
struct Neighbours
{
  std::array<float, LANES> ahead, behind;
  std::array<std::int32_t, LANES> is_edgel;  // -1 or 0
};

/** Whether one of the magnitudes reaches the threshold. */
bool anyReaches(const float* magnitudes, float threshold)
{
  const cv::v_float32x4 least = cv::v_setall_f32(threshold);
  return cv::v_check_any((cv::v_load(magnitudes) >= least) | (cv::v_load(magnitudes + LANES / 2) >= least));
}

/**
 * Compares the gradient pixels (j, i) to (j + LANES - 1, i) with their neighbours along the gradient: an edgel is one
 * whose magnitude reaches the threshold and is the largest. Without branches, all lanes at once.
 */
inline void compare(const GradientTile& tile, int i, int j, float threshold, Neighbours& neighbours)
{
  const float* above = &tile.magnitude[i - 1][j];
  const float* row = &tile.magnitude[i][j];
  const float* below = &tile.magnitude[i + 1][j];
  const float* x = &tile.x[i][j];
  const float* y = &tile.y[i][j];
  for (int lane = 0; lane < LANES; ++lane)
  {
    const float here = row[lane];
    const float ax = std::abs(x[lane]);
    const float ay = std::abs(y[lane]);
    // The two neighbours along the gradient, interpolated on the ring of eight pixels.
    const bool to_right = x[lane] >= 0;
    const bool to_below = y[lane] >= 0;
    const bool along_row = ax >= ay;
    const float t = (along_row ? ay : ax) / (along_row ? ax : ay);
    const float left = row[lane - 1];
    const float right = row[lane + 1];
    const float up = above[lane];
    const float down = below[lane];
    const float up_left = above[lane - 1];
    const float up_right = above[lane + 1];
    const float down_left = below[lane - 1];
    const float down_right = below[lane + 1];
    const float beside_ahead = along_row ? (to_right ? right : left) : (to_below ? down : up);
    const float beside_behind = along_row ? (to_right ? left : right) : (to_below ? up : down);
    const float across_ahead = to_below ? (to_right ? down_right : down_left) : (to_right ? up_right : up_left);
    const float across_behind = to_below ? (to_right ? up_left : up_right) : (to_right ? down_left : down_right);
    const float ahead = (1 - t) * beside_ahead + t * across_ahead;
    const float behind = (1 - t) * beside_behind + t * across_behind;
    neighbours.ahead[lane] = ahead;
    neighbours.behind[lane] = behind;
    neighbours.is_edgel[lane] =
        -(static_cast<int>(here >= threshold) & static_cast<int>(here >= ahead) & static_cast<int>(here > behind));
  }
}

/** Edgels of a tile while they are found. */
struct EdgelBuffer
{
  template <typename T>
  using Values = std::array<T, TILE * TILE>;

  std::size_t count = 0;
  Values<float> x, y;                 // of the pixel, then of the edgel [px]
  Values<float> nx, ny;               // the gradient, then its direction
  Values<float> here, ahead, behind;  // magnitudes

  /** The gradient pixel (j, i), a lane of those compared. */
  void add(const GradientTile& tile, const cv::Point& origin, int i, int j, const Neighbours& neighbours, unsigned lane)
  {
    x[count] = static_cast<float>(origin.x + j - 1);
    y[count] = static_cast<float>(origin.y + i - 1);
    nx[count] = tile.x[i][j];
    ny[count] = tile.y[i][j];
    here[count] = tile.magnitude[i][j];
    ahead[count] = neighbours.ahead[lane];
    behind[count] = neighbours.behind[lane];
    ++count;
  }
};

/** Places each edgel by a parabola through the magnitudes along the gradient. */
OMR_VECTORIZED void placeEdgels(EdgelBuffer& buffer)
{
  for (std::size_t i = 0; i < buffer.count; ++i)
  {
    const float length = buffer.here[i] * GradientTile::KERNEL_SUM;
    const float nx = buffer.nx[i] / length;
    const float ny = buffer.ny[i] / length;
    const float ax = std::abs(nx);
    const float ay = std::abs(ny);
    const float curvature = buffer.ahead[i] + buffer.behind[i] - 2 * buffer.here[i];
    const float vertex = (buffer.behind[i] - buffer.ahead[i]) / (2 * curvature);
    const float bounded = vertex < -.7F ? -.7F : (vertex > .7F ? .7F : vertex);
    const float offset = curvature < -1e-3F ? bounded : 0.F;
    const float step = offset / (ax >= ay ? ax : ay);
    buffer.x[i] += step * nx;
    buffer.y[i] += step * ny;
    buffer.nx[i] = nx;
    buffer.ny[i] = ny;
  }
}

/** The edgels of the gradient pixels in an area. */
OMR_VECTORIZED void findEdgels(const GradientTile& tile, const cv::Rect& area, const cv::Point& origin, float threshold,
                               EdgelBuffer& buffer)
{
  constexpr std::array<int, 4> BLOCKS = {1, 1 + LANES, 1 + 2 * LANES, SIDE - 1 - LANES};  // the last two overlap
  std::array<unsigned, BLOCKS.size()> lanes;                                              // of the area
  int next = area.x;
  for (std::size_t b = 0; b < BLOCKS.size(); ++b)
  {
    const int first = std::max(next, BLOCKS[b]) - BLOCKS[b];
    const int end = std::clamp(area.x + area.width - BLOCKS[b], first, LANES);
    lanes[b] = (1U << end) - (1U << first);
    next = BLOCKS[b] + LANES;
  }
  // Listed without branches, which could not be foreseen: blocks with a pixel that reaches the threshold, their edgels.
  constexpr std::size_t MOST = SIDE * BLOCKS.size();
  struct Block
  {
    int row;
    std::uint32_t index;
  };
  std::array<Block, MOST + 1> strong;
  std::size_t strong_count = 0;
  for (int i = area.y; i < area.y + area.height; ++i)
  {
    for (std::uint32_t b = 0; b < BLOCKS.size(); ++b)
    {
      strong[strong_count] = {i, b};
      strong_count += anyReaches(&tile.magnitude[i][BLOCKS[b]], threshold) ? 1 : 0;
    }
  }
  std::array<Neighbours, MOST> neighbours;
  std::array<std::uint16_t, (MOST + 1) * LANES> edgels;
  std::size_t count = 0;
  for (std::size_t k = 0; k < strong_count; ++k)
  {
    const std::uint32_t b = strong[k].index;
    compare(tile, strong[k].row, BLOCKS[b], threshold, neighbours[k]);
    const unsigned found = LaneList::bitsOf(neighbours[k].is_edgel.data()) & lanes[b];
    count += LaneList::write(found, static_cast<std::uint16_t>(k * LANES), &edgels[count]);
  }
  for (std::size_t e = 0; e < count; ++e)
  {
    const Block& block = strong[edgels[e] / LANES];
    const unsigned lane = edgels[e] % LANES;
    buffer.add(tile, origin, block.row, BLOCKS[block.index] + static_cast<int>(lane), neighbours[edgels[e] / LANES],
               lane);
  }
}
}  // namespace

EdgelMap::Tiles::Tiles(cv::Mat image, const cv::Size& size)
    : bgr(std::move(image)), grid(size), tiles(static_cast<std::size_t>(size.area()))
{
}

EdgelMap::EdgelMap(const cv::Mat& bgr)
    : shared_(std::make_shared<Tiles>(bgr, cv::Size((bgr.cols + TILE - 1) / TILE, (bgr.rows + TILE - 1) / TILE))),
      visited_(shared_->tiles.size(), 0)
{
  threshold_ = std::clamp(NOISE_FACTOR * medianMagnitude(bgr), LOWEST_THRESHOLD, HIGHEST_THRESHOLD);
}

void EdgelMap::join(const EdgelMap& fork)
{
  looks_ += fork.looks_ - fork.looks_before_;
  std::transform(visited_.begin(), visited_.end(), fork.visited_.begin(), visited_.begin(),
                 [](char own, char other) { return own | other; });
}

cv::Rect EdgelMap::tilesOf(double left, double top, double right, double bottom) const
{
  // An edgel may lie up to a pixel outside the tile of the pixel that gave it.
  const auto index = [](double position, int limit) {
    return static_cast<int>(std::clamp(std::floor(position / TILE), 0., limit - 1.));
  };
  const int x0 = index(left - 1, shared_->grid.width);
  const int y0 = index(top - 1, shared_->grid.height);
  return {x0, y0, index(right + 1, shared_->grid.width) - x0 + 1, index(bottom + 1, shared_->grid.height) - y0 + 1};
}

cv::Rect2d EdgelMap::areaOf(int col, int row)
{
  return {col * TILE - 1., row * TILE - 1., TILE + 1., TILE + 1.};
}

const EdgelTile& EdgelMap::tile(int col, int row)
{
  const std::size_t index = static_cast<std::size_t>(row) * shared_->grid.width + col;
  Tile& tile = shared_->tiles[index];
  looks_ += visited_[index] == 0 ? TILE_LOOKS : 0;
  visited_[index] = 1;
  if (!tile.is_computed.load(std::memory_order_acquire))
  {
    const std::lock_guard<std::mutex> lock(shared_->locks[index % shared_->locks.size()]);
    if (!tile.is_computed.load(std::memory_order_relaxed))
    {
      compute(col, row, tile.edgels);
      tile.is_computed.store(true, std::memory_order_release);
    }
  }
  return tile.edgels;
}

void EdgelMap::computeAll()
{
  cv::parallel_for_(cv::Range(0, shared_->grid.height), [&](const cv::Range& range) {
    EdgelMap own = fork();
    for (int row = range.start; row < range.end; ++row)
    {
      for (int col = 0; col < shared_->grid.width; ++col)
      {
        own.tile(col, row);
      }
    }
  });
}

void EdgelMap::compute(int col, int row, EdgelTile& edgels) const
{
  const cv::Mat& bgr = shared_->bgr;
  GradientTile gradients;
  const cv::Point origin(col * TILE, row * TILE);
  computeGradients(bgr, origin.x, origin.y, gradients);
  // The picture's outermost pixels have no neighbours to compare with.
  const cv::Point first(col == 0 ? 2 : 1, row == 0 ? 2 : 1);
  const cv::Point end(std::min(TILE, bgr.cols - 1 - origin.x) + 1, std::min(TILE, bgr.rows - 1 - origin.y) + 1);
  EdgelBuffer buffer;
  findEdgels(gradients, cv::Rect(first, cv::Size(end - first)), origin, threshold_, buffer);
  placeEdgels(buffer);
  edgels.assign(buffer.count, buffer.x.data(), buffer.y.data(), buffer.nx.data(), buffer.ny.data());
}

}  // namespace omr
