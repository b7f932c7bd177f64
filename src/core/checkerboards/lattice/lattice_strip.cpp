#include "lattice_strip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "border.h"
#include "checkerboards/corners/corner_ring.h"
#include "checkerboards/corners/edge_look.h"
#include "edge_line.h"
#include "lattice_model.h"
#include "lattice_side.h"
#include "median.h"

namespace omr
{
namespace
{
/** Lines side by side of which hardly a corner is found. */
struct Strip
{
  Side side = top;  ///< towards which the first line lies
  int first = 0;
  int last = 0;
};

std::vector<Strip> stripsOf(const Lattice& lattice)
{
  constexpr int MIN_LINES = 2;       // the borders of two boards
  constexpr float MAX_FOUND = 0.2F;  // of a line; things that lie across a gap give a false corner
  std::vector<Strip> strips;
  for (const Side side : {top, left})
  {
    const int end = lineIndex(lattice, side == top ? bottom : right, 0);
    int first = lineIndex(lattice, side, 0);
    for (int line = first; line <= end; ++line)
    {
      const auto found = static_cast<float>(countOnLine(lattice, side, line));
      if (found <= MAX_FOUND * static_cast<float>(lineLength(lattice, side)))
      {
        continue;
      }
      if (line - first >= MIN_LINES && first > lineIndex(lattice, side, 0))
      {
        strips.push_back({side, first, line - 1});
      }
      first = line + 1;
    }
  }
  return strips;
}

/** Mean of the steps from corner to corner that lead to a line. @param towards +1 or -1: from smaller or larger ones.
 */
std::optional<cv::Point2f> stepTo(const Lattice& lattice, Side side, int line, int along, int towards)
{
  constexpr int MAX_STEPS = 3;
  const Node end = nodeOnLine(side, line, along);
  for (int steps = MAX_STEPS; steps > 0; --steps)
  {
    const Node begin = nodeOnLine(side, line - steps * towards, along);
    if (lattice.found(begin.row, begin.col) && lattice.found(end.row, end.col))
    {
      return (lattice.at(end.row, end.col).position - lattice.at(begin.row, begin.col).position) *
             (1.F / static_cast<float>(steps * towards));
    }
  }
  return std::nullopt;
}

/** Whether the way across a strip is not that of its squares; the steps on both sides say how long these are. Not where
 * the places disagree: what covers corners moves those beside it, too. */
bool isUneven(const Lattice& lattice, const Strip& strip)
{
  constexpr float MIN_JUMP = 0.25F;    // squares
  constexpr float MAX_SPREAD = 0.15F;  // of the jump; where poles and gloss made jumps 0.20 and more
  constexpr std::size_t MIN_PLACES = 3;
  std::vector<cv::Point2f> jumps;
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> sizes;
  const int start = lineStart(lattice, strip.side);
  for (int t = start; t < start + lineLength(lattice, strip.side); ++t)
  {
    const auto before = stepTo(lattice, strip.side, strip.first - 1, t, 1);
    const auto behind = stepTo(lattice, strip.side, strip.last + 1, t, -1);
    if (before && behind)
    {
      const Node from = nodeOnLine(strip.side, strip.first - 1, t);
      const Node to = nodeOnLine(strip.side, strip.last + 1, t);
      const auto steps = static_cast<float>(strip.last - strip.first + 2);
      const cv::Point2f step = 0.5F * (*before + *behind);
      jumps.push_back(lattice.at(to.row, to.col).position - lattice.at(from.row, from.col).position - steps * step);
      x.push_back(jumps.back().x);
      y.push_back(jumps.back().y);
      sizes.push_back(length(step));
    }
  }
  if (jumps.size() < MIN_PLACES)
  {
    return false;
  }
  const cv::Point2f jump(median(std::move(x)), median(std::move(y)));
  std::vector<float> rests(jumps.size());
  std::transform(jumps.begin(), jumps.end(), rests.begin(),
                 [&](const cv::Point2f& other) { return length(other - jump); });
  return length(jump) > MIN_JUMP * median(std::move(sizes)) && median(std::move(rests)) <= MAX_SPREAD * length(jump);
}

/** How the squares on one side of a strip end at it. */
struct Ending
{
  /** They end exactly at the lattice line, and in the middle of the strip is something else than their paper. */
  bool ends() const
  {
    constexpr int MIN_PAIRS = 3;
    constexpr float MIN_SHARE = 0.7F;
    return pairs >= MIN_PAIRS && 2 * pairs >= places &&
           static_cast<float>(exact) >= MIN_SHARE * static_cast<float>(pairs) && 2 * ground >= exact;
  }
  bool isMargin() const
  {
    return 4 * light >= 3 * exact;
  }

  int places = 0;
  int pairs = 0;   ///< neighbouring squares that differ in their middles
  int exact = 0;   ///< of these, pairs that differ close to the line as well, and not beyond it
  int light = 0;   ///< of the exact ones, where the light square goes on
  int ground = 0;  ///< of these, where the middle of the strip is not as light
};

/** @param out +1 or -1: from the squares to the strip, at its first or last line. @param shift of the line [squares].
 */
Ending lookAtEnd(const Frame& frame, const LatticeModel& model, const Lattice& lattice, const Strip& strip, int out,
                 float shift)
{
  constexpr float CLOSE = 0.22F;  // squares from the line; blur reaches as far
  constexpr float MIDDLE = 0.5F;
  constexpr float MIN_INSIDE = 0.6F;       // of the difference in the middle of the squares
  constexpr float MAX_OUTSIDE = 0.3F;      // of the same
  constexpr float MIN_DIFFERENCE = 0.15F;  // of logarithms
  const int line = out > 0 ? strip.first : strip.last;
  const float half = 0.5F * static_cast<float>(strip.last - strip.first);
  const int start = lineStart(lattice, strip.side);
  Ending ending;
  ending.places = lineLength(lattice, strip.side);
  for (int t = start; t < start + ending.places; ++t)
  {
    const Node node = nodeOnLine(strip.side, line, t);
    const LocalFrame predicted = model.frameAt(node.row, node.col);
    const auto place = [&](float along, float depth) {
      const float across = shift - static_cast<float>(out) * depth;
      return isRow(strip.side) ? predicted.at(along, across) : predicted.at(across, along);
    };
    if (!showsEdges(frame, predicted) || !isInside(frame.raw_grey, place(0.5F, 1), 2) ||
        !isInside(frame.raw_grey, place(-0.5F, -half), 2))
    {
      continue;
    }
    const PyramidView view(frame, squareHeight(predicted));
    const float to_light = lattice.sign(node.row, node.col) == out ? -0.5F : 0.5F;
    const auto level = [&](float along, float depth) { return greyLogarithm(view.sample(place(along, depth))); };
    const auto difference = [&](float depth) { return level(to_light, depth) - level(-to_light, depth); };
    const float middle = difference(MIDDLE);
    if (middle < MIN_DIFFERENCE)
    {
      continue;
    }
    ++ending.pairs;
    if (difference(CLOSE) >= MIN_INSIDE * middle && std::abs(difference(-CLOSE)) <= MAX_OUTSIDE * middle)
    {
      const float light = level(to_light, CLOSE);
      ++ending.exact;
      ending.light += std::abs(light - level(to_light, -CLOSE)) <= MAX_OUTSIDE * middle ? 1 : 0;
      ending.ground += std::abs(light - level(to_light, -half)) > MAX_OUTSIDE * middle ? 1 : 0;
    }
  }
  return ending;
}

/** Whether squares of the neighbouring sides' rims show in the strip: a label that lies within a board ends so. */
bool showsRim(const Frame& frame, const LatticeModel& model, const Lattice& lattice, const Strip& strip)
{
  constexpr float MIN_DIFFERENCE = 0.3F;  // of logarithms
  const int from = lineStart(lattice, strip.side);
  const int to = from + lineLength(lattice, strip.side) - 1;
  for (int line = strip.first; line < strip.last; ++line)
  {
    const auto level = [&](double along) {
      const LocalFrame place = isRow(strip.side) ? model.frameAt(line + 0.5, along) : model.frameAt(along, line + 0.5);
      return isInside(frame.raw_grey, place.node, 2)
                 ? greyLogarithm(PyramidView(frame, squareHeight(place)).sample(place.node))
                 : 0.F;
    };
    std::vector<float> levels;
    for (int t = from; t < to; ++t)
    {
      levels.push_back(level(t + 0.5));
    }
    const float most = median(std::vector<float>(levels));
    const auto differs = [&](float rim, float beside) {
      return std::abs(rim - beside) >= MIN_DIFFERENCE && std::abs(rim - most) >= MIN_DIFFERENCE;
    };
    if (differs(level(from - 0.5), levels.front()) || differs(level(to + 0.5), levels.back()))
    {
      return true;
    }
  }
  return false;
}

/** Whether the squares on both sides end as those of two boards do. Where a margin is seen on another side, at one. */
bool isBetweenBoards(const Frame& frame, const LatticeModel& model, const Lattice& lattice, const Strip& strip)
{
  constexpr std::array<float, 3> SHIFTS = {0, -0.12F, 0.12F};  // squares; one surface does not fit both boards exactly
  const bool has_margin =
      std::any_of(SIDES.begin(), SIDES.end(), [&](Side side) { return lookAtBorder(lattice, frame, side, 1).ends(); });
  const auto ends = [&](int out) {
    return std::any_of(SHIFTS.begin(), SHIFTS.end(), [&](float shift) {
      const Ending ending = lookAtEnd(frame, model, lattice, strip, out, shift);
      return ending.ends() && (ending.isMargin() || !has_margin);
    });
  };
  return ends(1) && ends(-1) && !showsRim(frame, model, lattice, strip);
}

std::optional<Seam> findGap(const Lattice& lattice, const Frame& frame)
{
  LatticeModel model;
  const std::vector<Strip> strips = stripsOf(lattice);
  if (strips.empty() || !fitEdges(lattice, true, model))
  {
    return {};
  }
  const auto gap = std::find_if(strips.begin(), strips.end(), [&](const Strip& strip) {
    return isUneven(lattice, strip) || isBetweenBoards(frame, model, lattice, strip);
  });
  if (gap == strips.end())
  {
    return {};
  }
  const Side opposite = gap->side == top ? bottom : right;
  return gap->first > Lattice::SEED ? Seam{opposite, gap->first} : Seam{gap->side, gap->last};
}
}  // namespace

std::vector<Seam> splitAtStrips(Lattice& lattice, const Frame& frame)
{
  std::vector<Seam> gaps;
  for (std::optional<Seam> gap = findGap(lattice, frame); gap; gap = findGap(lattice, frame))
  {
    dropBeyond(lattice, *gap);
    gaps.push_back(*gap);
  }
  return gaps;
}

}  // namespace omr
