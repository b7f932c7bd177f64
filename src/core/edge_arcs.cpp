#include "edge_arcs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "fast_angle.h"
#include "pixel_set.h"

namespace omr
{
namespace
{
constexpr float MIN_COSINE = .85F;        // between the normals of neighbours along an edge
constexpr float MAX_ACROSS = .8F;         // of a step, off the tangent [px]
constexpr float MIN_ALONG = .3F;          // of a step [px]
constexpr int PADDING = PixelSet::REACH;  // around the image: a step over a gap is as long at most [px]
constexpr std::size_t FIRM_CHAIN = 3;     // edgels on one side: from so many on, a gap is crossed
constexpr std::size_t MIN_CHAIN = 10;     // edgels
constexpr std::size_t MIN_ARC = 7;        // edgels
constexpr std::size_t MAX_ARC = 60;       // edgels; what has not turned by then is straight
constexpr double ARC_TURNING = .4;        // of a whole arc [rad]
constexpr double MIN_TURNING = .2;        // of the last arc of a chain
constexpr double SETBACK = .15;           // turning back that ends an arc [rad]
constexpr std::size_t CORNER_REACH = 4;
constexpr double CORNER = .9;  // turning over twice that many edgels [rad]

/** An edgel of a chain, its tangent along the chain. */
struct Link
{
  const Edgel* edgel = nullptr;
  double angle = 0;  // of the tangent, continuous along the chain [rad]
};

class Tracer
{
 public:
  Tracer(EdgelMap& map, const cv::Size& size)
      : stride_(size.width + 2 * PADDING),
        index_(static_cast<std::size_t>(stride_) * (size.height + 2 * PADDING)),
        free_(size)
  {
    map.visitTiles(0, 0, size.width - 1, size.height - 1, [&](const EdgelTile& tile) {
      for (std::size_t i = 0; i < tile.size(); ++i)
      {
        edgels_.push_back(tile[i]);
        const cv::Point pixel = pixelOf(edgels_.back());
        index_[cellOf(pixel)] = static_cast<int>(edgels_.size());
        free_.set(pixel);
      }
    });
    visited_.assign(edgels_.size(), 0);
  }

  template <typename Visitor>
  void chains(Visitor&& visitor)
  {
    std::vector<const Edgel*> forward;
    std::vector<const Edgel*> chain;
    for (std::size_t i = 0; i < edgels_.size(); ++i)
    {
      if (visited_[i] != 0)
      {
        continue;
      }
      const Edgel& start = edgels_[i];
      leave(start);
      forward.clear();
      chain.clear();
      follow(start, cv::Point2f(-start.ny, start.nx), forward);
      follow(start, cv::Point2f(start.ny, -start.nx), chain);
      std::reverse(chain.begin(), chain.end());
      chain.push_back(&start);
      chain.insert(chain.end(), forward.begin(), forward.end());
      if (chain.size() >= MIN_CHAIN)
      {
        visitor(chain);
      }
    }
  }

 private:
  static cv::Point pixelOf(const Edgel& edgel)
  {
    return {cvRound(edgel.x), cvRound(edgel.y)};
  }

  std::size_t cellOf(const cv::Point& pixel) const
  {
    return static_cast<std::size_t>(pixel.y + PADDING) * stride_ + pixel.x + PADDING;
  }

  /** An edgel is on one chain only. */
  void leave(const Edgel& edgel)
  {
    const auto i = static_cast<int>(&edgel - edgels_.data());
    visited_[i] = 1;
    const cv::Point pixel = pixelOf(edgel);
    if (index_[cellOf(pixel)] == i + 1)
    {
      free_.reset(pixel);
    }
  }

  void follow(const Edgel& start, cv::Point2f direction, std::vector<const Edgel*>& chain)
  {
    const Edgel* here = &start;
    while (true)
    {
      const Edgel* next = successor(*here, direction, PixelSet::NEAREST);
      if (next == nullptr && chain.size() >= FIRM_CHAIN)
      {
        next = successor(*here, direction, ~PixelSet::NEAREST);
      }
      if (next == nullptr)
      {
        return;
      }
      leave(*next);
      chain.push_back(next);
      const cv::Point2f tangent(-next->ny, next->nx);
      direction = tangent.dot(direction) > 0 ? tangent : -tangent;
      here = next;
    }
  }

  /** The next edgel along the edge: ahead in one of the pixels around. */
  const Edgel* successor(const Edgel& here, const cv::Point2f& direction, std::uint32_t pixels) const
  {
    const cv::Point pixel = pixelOf(here);
    const Edgel* best = nullptr;
    float best_cost = std::numeric_limits<float>::infinity();
    for (std::uint32_t bits = free_.around(pixel) & pixels; bits != 0; bits &= bits - 1)
    {
      const int bit = __builtin_ctz(bits);
      const cv::Point offset(bit % PixelSet::SIDE - PixelSet::REACH, bit / PixelSet::SIDE - PixelSet::REACH);
      if (static_cast<float>(offset.x) * direction.x + static_cast<float>(offset.y) * direction.y <= 0)
      {
        continue;
      }
      const Edgel& edgel = edgels_[index_[cellOf(pixel + offset)] - 1];
      const float step_x = edgel.x - here.x;
      const float step_y = edgel.y - here.y;
      const float along = step_x * direction.x + step_y * direction.y;
      const float across = std::abs(step_x * here.nx + step_y * here.ny);
      const float cost = across + .5F * along;
      if (along > MIN_ALONG && across < MAX_ACROSS && across < along && cost < best_cost &&
          std::abs(edgel.nx * here.nx + edgel.ny * here.ny) > MIN_COSINE)
      {
        best_cost = cost;
        best = &edgel;
      }
    }
    return best;
  }

  int stride_;
  std::vector<int> index_;  // of the edgel in each pixel, from 1; with a border
  PixelSet free_;           // pixels whose edgel is on no chain yet
  std::vector<Edgel> edgels_;
  std::vector<char> visited_;
};

/** Tangents along chains, smoothed; the memory serves one chain after the other. */
class Tangents
{
 public:
  const std::vector<Link>& of(const std::vector<const Edgel*>& chain)
  {
    const std::size_t count = chain.size();
    raw_.resize(count);
    std::transform(chain.begin(), chain.end(), raw_.begin(),
                   [](const Edgel* edgel) { return fastAngle(-edgel->ny, edgel->nx) * (CV_PI / 180); });
    const Edgel& first = *chain[0];
    const Edgel& second = *chain[1];
    raw_[0] += (second.x - first.x) * -first.ny + (second.y - first.y) * first.nx < 0 ? CV_PI : 0;
    for (std::size_t i = 1; i < count; ++i)
    {
      // Along the chain the tangent turns little, whichever side is brighter.
      raw_[i] -= CV_PI * cvRound((raw_[i] - raw_[i - 1]) * (1 / CV_PI));
    }
    links_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t from = i >= REACH ? i - REACH : 0;
      const std::size_t to = std::min(count, i + REACH + 1);
      links_[i] = {chain[i],
                   std::accumulate(raw_.begin() + from, raw_.begin() + to, 0.) / static_cast<double>(to - from)};
    }
    return links_;
  }

 private:
  static constexpr std::size_t REACH = 2;  // of the smoothing, edgels

  std::vector<double> raw_;
  std::vector<Link> links_;
};

EdgeArc makeArc(const std::vector<Link>& links, std::size_t from, std::size_t to, int chain)
{
  EdgeArc arc;
  arc.chain = chain;
  arc.turning = std::abs(links[to - 1].angle - links[from].angle);
  for (std::size_t i = from; i < to; ++i)
  {
    arc.sums.add(*links[i].edgel);
  }
  arc.sums.close();
  const Edgel& middle = *links[(from + to) / 2].edgel;
  arc.middle = {middle.x, middle.y};
  const double angle = links[(from + to) / 2].angle;
  const double left = links[to - 1].angle > links[from].angle ? 1 : -1;
  arc.inwards = {-std::sin(angle) * left, std::cos(angle) * left};
  return arc;
}

/** Cuts a chain where it has a corner, turns back or has turned enough. */
void cutChain(const std::vector<Link>& links, int& chain, std::vector<EdgeArc>& arcs)
{
  const std::size_t count = links.size();
  const auto turning = [&](std::size_t from, std::size_t to) { return links[to].angle - links[from].angle; };
  std::size_t from = 0;
  ++chain;
  while (from + MIN_ARC <= count)
  {
    std::size_t to = from + 1;
    std::size_t farthest = from;  // where it had turned most
    double most = 0;
    double sign = 0;
    bool is_corner = false;
    while (to < count && to - from < MAX_ARC)
    {
      if (to >= CORNER_REACH && to + CORNER_REACH < count &&
          std::abs(turning(to - CORNER_REACH, to + CORNER_REACH)) > CORNER)
      {
        is_corner = true;
        break;
      }
      const double turned = turning(from, to);
      if (sign == 0 && std::abs(turned) > SETBACK)
      {
        sign = turned > 0 ? 1 : -1;
      }
      const double signed_turned = sign == 0 ? std::abs(turned) : sign * turned;
      if (signed_turned > most)
      {
        most = signed_turned;
        farthest = to;
      }
      if (sign != 0 && signed_turned < most - SETBACK)
      {
        break;
      }
      if (signed_turned >= ARC_TURNING && to - from + 1 >= MIN_ARC)
      {
        ++to;
        break;
      }
      ++to;
    }
    if (most >= ARC_TURNING && to - from >= MIN_ARC && !is_corner)
    {
      arcs.push_back(makeArc(links, from, to, chain));
      from = to;
      continue;
    }
    if (most >= MIN_TURNING && farthest - from + 1 >= MIN_ARC)
    {
      arcs.push_back(makeArc(links, from, farthest + 1, chain));
    }
    from = is_corner ? to + CORNER_REACH : std::max(from + 1, to - (to - from) / 2);
    ++chain;
  }
}
}  // namespace

std::vector<EdgeArc> traceArcs(EdgelMap& map, const cv::Size& size)
{
  std::vector<EdgeArc> arcs;
  int chain = 0;
  Tangents tangents;
  Tracer tracer(map, size);
  tracer.chains([&](const std::vector<const Edgel*>& edgels) { cutChain(tangents.of(edgels), chain, arcs); });
  return arcs;
}

}  // namespace omr
