#include "edge_chains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "pixel_set.h"

namespace omr
{
namespace
{
constexpr float MIN_COSINE = .85F;     // between the normals of neighbours along an edge
constexpr float MAX_ACROSS = .8F;      // of a step, off the tangent [px]
constexpr float MIN_ALONG = .3F;       // of a step [px]
constexpr std::size_t FIRM_CHAIN = 3;  // edgels on one side: from so many on, a gap is crossed
constexpr std::size_t MIN_CHAIN = 10;  // edgels

/** Where the bits of PixelSet::around() lie. */
struct Offset
{
  cv::Point2f at;
  std::ptrdiff_t pixels;  // further on in the picture
};

std::array<Offset, PixelSet::SIDE * PixelSet::SIDE> offsetsOf(int width)
{
  std::array<Offset, PixelSet::SIDE * PixelSet::SIDE> offsets;
  for (int i = 0; i < static_cast<int>(offsets.size()); ++i)
  {
    const cv::Point at(i % PixelSet::SIDE - PixelSet::REACH, i / PixelSet::SIDE - PixelSet::REACH);
    offsets[i] = {at, static_cast<std::ptrdiff_t>(at.y) * width + at.x};
  }
  return offsets;
}

class Tracer
{
 public:
  /** @param chains receives them. */
  Tracer(const std::vector<Edgel>& edgels, const cv::Size& size, Chains& chains)
      : edgels_(edgels),
        width_(size.width),
        chains_(chains),
        free_(size),
        offsets_(offsetsOf(size.width)),
        visited_(edgels.size(), 0)
  {
    chains.edgels.clear();
    chains.edgels.reserve(edgels.size());
    chains.ends.clear();
    chains.index.resize(std::max(chains.index.size(), static_cast<std::size_t>(size.area())));
    for (std::size_t i = 0; i < edgels.size(); ++i)
    {
      const cv::Point pixel = pixelOf(edgels[i]);
      chains.index[placeOf(pixel)] = static_cast<int>(i);
      free_.set(pixel);
    }
  }

  void run()
  {
    std::vector<const Edgel*> forward;
    std::vector<const Edgel*> backward;
    for (std::size_t i = 0; i < edgels_.size(); ++i)
    {
      if (visited_[i] != 0)
      {
        continue;
      }
      const Edgel& start = edgels_[i];
      leave(start);
      forward.clear();
      backward.clear();
      follow(start, cv::Point2f(-start.ny, start.nx), forward);
      follow(start, cv::Point2f(start.ny, -start.nx), backward);
      if (backward.size() + 1 + forward.size() >= MIN_CHAIN)
      {
        std::vector<const Edgel*>& chained = chains_.edgels;
        chained.insert(chained.end(), backward.rbegin(), backward.rend());
        chained.push_back(&start);
        chained.insert(chained.end(), forward.begin(), forward.end());
        chains_.ends.push_back(chained.size());
      }
    }
  }

 private:
  static cv::Point pixelOf(const Edgel& edgel)
  {
    return {cvRound(edgel.x), cvRound(edgel.y)};
  }

  std::size_t placeOf(const cv::Point& pixel) const
  {
    return static_cast<std::size_t>(pixel.y) * width_ + pixel.x;
  }

  /** An edgel is on one chain only. */
  void leave(const Edgel& edgel)
  {
    const auto i = static_cast<int>(&edgel - edgels_.data());
    visited_[i] = 1;
    const cv::Point pixel = pixelOf(edgel);
    if (chains_.index[placeOf(pixel)] == i)
    {
      free_.reset(pixel);
    }
  }

  void follow(const Edgel& start, cv::Point2f direction, std::vector<const Edgel*>& chain)
  {
    const Edgel* here = &start;
    std::uint32_t around = free_.around(pixelOf(start));
    while (true)
    {
      const Edgel* next = successor(*here, direction, around & PixelSet::NEAREST);
      if (next == nullptr && chain.size() >= FIRM_CHAIN)
      {
        next = successor(*here, direction, around & ~PixelSet::NEAREST);
      }
      if (next == nullptr)
      {
        return;
      }
      around = free_.around(pixelOf(*next));  // before it changes: the processor waits for what was just written
      leave(*next);
      chain.push_back(next);
      const cv::Point2f tangent(-next->ny, next->nx);
      direction = tangent.dot(direction) > 0 ? tangent : -tangent;
      here = next;
    }
  }

  /** The next edgel along the edge: ahead in one of the pixels around. Hardly a branch: none could be foreseen. */
  const Edgel* successor(const Edgel& here, const cv::Point2f& direction, std::uint32_t pixels) const
  {
    const int* index = &chains_.index[placeOf(pixelOf(here))];
    const Edgel* best = nullptr;
    float best_cost = std::numeric_limits<float>::infinity();
    for (; pixels != 0; pixels &= pixels - 1)
    {
      const Offset& offset = offsets_[__builtin_ctz(pixels)];
      const Edgel& edgel = edgels_[index[offset.pixels]];
      const float step_x = edgel.x - here.x;
      const float step_y = edgel.y - here.y;
      const float along = step_x * direction.x + step_y * direction.y;
      const float across = std::abs(step_x * here.nx + step_y * here.ny);
      const float cost = across + .5F * along;
      const bool is_next = (offset.at.x * direction.x + offset.at.y * direction.y > 0) & (along > MIN_ALONG) &
                           (across < MAX_ACROSS) & (across < along) & (cost < best_cost) &
                           (std::abs(edgel.nx * here.nx + edgel.ny * here.ny) > MIN_COSINE);
      best_cost = is_next ? cost : best_cost;
      best = is_next ? &edgel : best;
    }
    return best;
  }

  const std::vector<Edgel>& edgels_;
  int width_;
  Chains& chains_;
  PixelSet free_;  // pixels whose edgel is on no chain yet
  std::array<Offset, PixelSet::SIDE * PixelSet::SIDE> offsets_;
  std::vector<char> visited_;
};

}  // namespace

void edgelsOf(EdgelMap& map, const cv::Size& size, std::vector<Edgel>& edgels)
{
  map.computeAll();
  std::size_t count = 0;
  map.visitTiles(0, 0, size.width - 1, size.height - 1, [&](const EdgelTile& tile) { count += tile.size(); });
  edgels.resize(count);
  Edgel* next = edgels.data();
  map.visitTiles(0, 0, size.width - 1, size.height - 1, [&](const EdgelTile& tile) { next = tile.copyTo(next); });
}

void followEdges(const std::vector<Edgel>& edgels, const cv::Size& size, Chains& chains)
{
  Tracer(edgels, size, chains).run();
}

}  // namespace omr
