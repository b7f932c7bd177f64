#include "edge_arcs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "targets/edges/fast_angle.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr std::size_t MIN_ARC = 7;   // edgels
constexpr std::size_t MAX_ARC = 60;  // edgels; what has not turned by then is straight
constexpr double ARC_TURNING = .4;   // of a whole arc [rad]
constexpr double MIN_TURNING = .2;   // of the last arc of a chain
constexpr double SETBACK = .15;      // turning back that ends an arc [rad]
constexpr std::size_t CORNER_REACH = 4;
constexpr double CORNER = .9;           // turning over twice that many edgels [rad]
constexpr std::size_t ARC_EDGELS = 16;  // of chains, for each arc found in them: there are 17 to 39
constexpr int PARTS = 8;  // of the chains, shared by the threads; the arcs do not depend on how many there are

/** Edgels of a chain and the tangents there. */
struct Links
{
  const Edgel* const* edgels = nullptr;
  std::vector<double> angles;  // continuous along the chain [rad]
};

/** The tangents' directions [rad]. */
OMR_VECTORIZED void findDirections(const float* nx, const float* ny, std::size_t count, double* directions)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    directions[i] = fastAngle(-ny[i], nx[i]) * (CV_PI / 180);
  }
}

/** By how many half turns each direction but the first goes on beside the one before, instead of turning least. */
OMR_VECTORIZED void findHalfTurns(const double* directions, std::size_t count, std::int64_t* half_turns)
{
  for (std::size_t i = 1; i < count; ++i)
  {
    const double turn = directions[i] - directions[i - 1];
    half_turns[i] = (turn > .5 * CV_PI ? 1 : 0) + (turn > 1.5 * CV_PI ? 1 : 0) - (turn < -.5 * CV_PI ? 1 : 0) -
                    (turn < -1.5 * CV_PI ? 1 : 0);
  }
}

/** Tangents along chains, smoothed; the memory serves one chain after the other. */
class Tangents
{
 public:
  const Links& of(const Edgel* const* chain, std::size_t count)
  {
    nx_.resize(count);
    ny_.resize(count);
    raw_.resize(count);
    half_turns_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      nx_[i] = chain[i]->nx;
      ny_[i] = chain[i]->ny;
    }
    findDirections(nx_.data(), ny_.data(), count, raw_.data());
    findHalfTurns(raw_.data(), count, half_turns_.data());
    const Edgel& first = *chain[0];
    const Edgel& second = *chain[1];
    // Along the chain the tangent turns little, whichever side is brighter.
    std::int64_t half_turns = (second.x - first.x) * -first.ny + (second.y - first.y) * first.nx < 0 ? -1 : 0;
    raw_[0] -= CV_PI * static_cast<double>(half_turns);
    for (std::size_t i = 1; i < count; ++i)
    {
      half_turns += half_turns_[i];
      raw_[i] -= CV_PI * static_cast<double>(half_turns);
    }
    links_.edgels = chain;
    links_.angles.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t from = i >= REACH ? i - REACH : 0;
      const std::size_t to = std::min(count, i + REACH + 1);
      links_.angles[i] = std::accumulate(raw_.begin() + from, raw_.begin() + to, 0.) / static_cast<double>(to - from);
    }
    return links_;
  }

 private:
  static constexpr std::size_t REACH = 2;  // of the smoothing, edgels

  std::vector<float> nx_, ny_;
  std::vector<double> raw_;
  std::vector<std::int64_t> half_turns_;
  Links links_;
};

EdgeArc makeArc(const Links& links, std::size_t from, std::size_t to, int chain)
{
  EdgeArc arc;
  arc.chain = chain;
  arc.turning = std::abs(links.angles[to - 1] - links.angles[from]);
  for (std::size_t i = from; i < to; ++i)
  {
    arc.sums.add(*links.edgels[i]);
  }
  arc.sums.close();
  const Edgel& middle = *links.edgels[(from + to) / 2];
  arc.middle = {middle.x, middle.y};
  const double angle = links.angles[(from + to) / 2];
  const double left = links.angles[to - 1] > links.angles[from] ? 1 : -1;
  arc.inwards = {-std::sin(angle) * left, std::cos(angle) * left};
  return arc;
}

/** Cuts a chain where it has a corner, turns back or has turned enough. */
void cutChain(const Links& links, int& chain, std::vector<EdgeArc>& arcs)
{
  const std::size_t count = links.angles.size();
  const auto turning = [&](std::size_t from, std::size_t to) { return links.angles[to] - links.angles[from]; };
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

void traceArcs(const cv::Size& size, ArcTrace& trace)
{
  followEdges(trace.edgels, size, trace.chains);
  const Chains& chains = trace.chains;
  const std::size_t count = chains.ends.size();
  const auto end_of = [&](std::size_t before) { return before > 0 ? chains.ends[before - 1] : 0; };  // of the chains
  std::array<std::vector<EdgeArc>, PARTS> parts;
  cv::parallel_for_(cv::Range(0, PARTS), [&](const cv::Range& range) {
    Tangents tangents;
    for (int part = range.start; part < range.end; ++part)
    {
      int chain = 0;
      const std::size_t first = count * part / PARTS;
      const std::size_t last = count * (part + 1) / PARTS;
      parts[part].reserve((end_of(last) - end_of(first)) / ARC_EDGELS);
      for (std::size_t i = first; i < last; ++i)
      {
        const std::size_t begin = end_of(i);
        cutChain(tangents.of(&chains.edgels[begin], chains.ends[i] - begin), chain, parts[part]);
      }
    }
  });
  std::vector<EdgeArc>& arcs = trace.arcs;
  arcs.clear();
  arcs.reserve(std::accumulate(parts.begin(), parts.end(), std::size_t{0},
                               [](std::size_t sum, const auto& part) { return sum + part.size(); }));
  int chain = 0;  // the last one so far
  for (std::vector<EdgeArc>& part : parts)
  {
    const int before = chain;
    for (EdgeArc& arc : part)
    {
      arc.chain += before;
      chain = arc.chain;
      arcs.push_back(arc);
    }
    part = std::vector<EdgeArc>();  // gives its memory back
  }
}

}  // namespace omr
