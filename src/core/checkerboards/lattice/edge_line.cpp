#include "edge_line.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "checkerboards/corners/corner_ring.h"
#include "checkerboards/corners/edge_look.h"
#include "lattice_evidence.h"
#include "median.h"

namespace omr
{
namespace
{
constexpr double RIDGE = 0.1;
constexpr double SMOOTH_RIDGE = 0.5;
constexpr float MAX_BEYOND = 0.4F;  // of sides where boards end 0.38 is the most, where they go on 0.5 the least

/** Counts which of some places are as expected. */
struct Share
{
  void add(bool is_like)
  {
    ++places;
    like += is_like ? 1 : 0;
  }
  float value() const
  {
    return static_cast<float>(like) / static_cast<float>(std::max(1, places));
  }

  int places = 0;
  int like = 0;
};

/** Grey level of a square's middle, the first of its corners given; 0 outside the picture. */
float levelOfSquare(const Frame& frame, const LatticeModel& model, double row, double col)
{
  const LocalFrame middle = model.frameAt(row + 0.5, col + 0.5);
  return isInside(frame.raw_grey, middle.node, 2) ? PyramidView(frame, squareHeight(middle)).sample(middle.node) : 0;
}

/** Median grey level of the light squares between corners. */
float paperLevel(const Frame& frame, const LatticeModel& model, const Lattice& lattice)
{
  const cv::Rect box = lattice.box;
  std::vector<float> levels;
  for (int i = box.y; i + 1 < box.br().y; ++i)
  {
    for (int j = box.x; j + 1 < box.br().x; ++j)
    {
      if (lattice.sign(i, j) > 0)
      {
        levels.push_back(levelOfSquare(frame, model, i, j));
      }
    }
  }
  return levels.empty() ? 0 : median(std::move(levels));
}

/**
 * Whether glare may hide squares beyond a side: half of the last corners are gone, and it is brighter there than the
 * board's paper. Of 2058 boards drawn below things, shadows and gloss 30 wrong -> 24, all six below gloss; 3 of 1655
 * found are lost.
 */
bool mayGoOnInGlare(const Frame& frame, const LatticeModel& model, const Lattice& lattice, Side side)
{
  constexpr float MIN_LEVEL = 245;  // grey levels
  constexpr float MIN_STEP = 20;    // grey levels over the paper
  constexpr float MIN_SHARE = 0.2F;
  const int last = lineIndex(lattice, side, 0);
  if (2 * countOnLine(lattice, side, last) > lineLength(lattice, side))
  {
    return false;
  }
  const float least = std::max(MIN_LEVEL, paperLevel(frame, model, lattice) + MIN_STEP);
  const int rim = inwards(side) > 0 ? last - 1 : last;
  const int start = lineStart(lattice, side);
  Share glare;
  for (int t = start - 1; t < start + lineLength(lattice, side); ++t)
  {
    const Node inner = nodeOnLine(side, rim, t);
    const Node outer = nodeOnLine(side, rim - inwards(side), t);
    glare.add(levelOfSquare(frame, model, inner.row, inner.col) >= least ||
              levelOfSquare(frame, model, outer.row, outer.col) >= least);
  }
  return glare.value() > MIN_SHARE;
}
}  // namespace

bool EdgeLine::ends() const
{
  return dark >= 0.5F && light <= 0.3F && dark - light >= 0.4F && !goesOn();
}

bool EdgeLine::isLast() const
{
  // Of squares cut in half one edge in two is there; where the lattice goes on below a thing 0.61 of the light end.
  return inside >= 0.25F && beyond <= 0.25F * inside && light <= std::max(0.15F, std::min(dark, 0.6F));
}

bool EdgeLine::goesOn() const
{
  // Where a thing covers all but the beginning of the next squares, light ones still end at dark ones and dark ones at
  // light ones: of 2126 joined boards 167 wrong -> 150, of 63 in path-traced scenes 2 -> 1; none is lost.
  constexpr float MIN_ENDING = 0.6F;
  return beyond > MAX_BEYOND || std::min(dark, light) > MIN_ENDING;
}

bool fitEdges(const Lattice& lattice, bool exact, LatticeModel& model)
{
  constexpr int MIN_CORNERS = 6;
  constexpr int MIN_BENT = 20;    // corners
  constexpr int MIN_SMOOTH = 36;  // corners; with fewer a smooth surface follows the edges of shadows
  if (exact && lattice.count() >= MIN_SMOOTH)
  {
    return model.fitSmooth(lattice, SMOOTH_RIDGE);
  }
  const bool bent = exact && lattice.count() >= MIN_BENT;
  return lattice.count() >= MIN_CORNERS &&
         model.fit(lattice, bent ? LatticeModel::quadratic : LatticeModel::robust_homography, RIDGE);
}

float medianRatio(const Frame& frame, const LatticeModel& model, const Lattice& lattice)
{
  std::vector<float> ratios;
  const cv::Rect box = lattice.box;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      const LocalFrame corner = model.frameAt(i, j);
      if (lattice.found(i, j) && showsEdges(frame, corner))
      {
        const PyramidView view(frame, squareHeight(corner));
        ratios.push_back(lookAtEdges(view, corner, lattice.sign(i, j)).ratio);
      }
    }
  }
  return ratios.empty() ? 0 : median(std::move(ratios));
}

EdgeLine lookAtEdgeLine(const Frame& frame, const LatticeModel& model, const Lattice& lattice, Side side, int distance,
                        float ratio)
{
  const int line = lineIndex(lattice, side, distance);
  const int start = lineStart(lattice, side);
  Share dark;
  Share light;
  Share inside;
  Share beyond;
  for (int t = start - 1; t < start + lineLength(lattice, side); ++t)
  {
    const Node node = nodeOnLine(side, line, t);
    const LocalFrame predicted = model.frameAt(node.row, node.col);
    if (!showsEdges(frame, predicted))
    {
      continue;
    }
    const PyramidView view(frame, squareHeight(predicted));
    const int sign = lattice.sign(node.row, node.col);
    // The square towards +u +v of a node is light where its sign is positive.
    const bool is_light = sign == inwards(side);
    const auto look = [&](float u_or_v, bool along_u, Share& share, bool darker_passes) {
      const cv::Point2f place = along_u ? cv::Point2f(u_or_v, 0) : cv::Point2f(0, u_or_v);
      if (isInside(frame.raw_grey, predicted.at(place.x, place.y), 2))
      {
        Edge edge = strongestEdge(view, predicted, place, along_u, u_or_v > 0 ? sign : -sign);
        edge.ratio = darker_passes ? std::min(edge.ratio, ratio) : edge.ratio;
        share.add(edge.isLike(0, ratio));
      }
    };
    for (const float step : {0.2F, 0.4F, 0.6F, 0.8F})
    {
      // Under a shadow that begins there a light square would end all the darker.
      look(step, isRow(side), is_light ? light : dark, is_light);
      if (t >= start)
      {
        const auto in = static_cast<float>(inwards(side));
        look(step * in, !isRow(side), inside, false);
        look(-step * in, !isRow(side), beyond, false);
      }
    }
  }
  return {std::min(dark.places, light.places), dark.value(), light.value(), inside.value(), beyond.value()};
}

void settleRims(const Frame& frame, const Lattice& lattice, std::array<SideEvidence, 4>& sides)
{
  constexpr float MAX_UNEVENNESS = 0.08F;  // 95 % of the boards are below 0.063
  LatticeModel model;
  const bool asked = std::any_of(sides.begin(), sides.end(), [](SideEvidence side) {
    return side == SideEvidence::rim || side == SideEvidence::none;
  });
  if (!asked || !fitEdges(lattice, true, model))
  {
    return;
  }
  const float ratio = medianRatio(frame, model, lattice);
  // An uneven lattice with rims alone may be the middle of a board.
  const bool is_sure = latticeEvidence(lattice).unevenness <= MAX_UNEVENNESS ||
                       std::any_of(sides.begin(), sides.end(), [](SideEvidence side) {
                         return side != SideEvidence::rim && side != SideEvidence::none;
                       });
  for (const Side side : SIDES)
  {
    const bool is_rim = sides[side] == SideEvidence::rim;
    if (ratio > 0 && (is_rim || sides[side] == SideEvidence::none))
    {
      const EdgeLine border = lookAtEdgeLine(frame, model, lattice, side, 1, ratio);
      const bool is_known = is_rim && (is_sure || border.places == 0);
      const bool is_last =
          (is_known ? !border.goesOn() : border.isLast()) && !mayGoOnInGlare(frame, model, lattice, side);
      sides[side] = is_last ? SideEvidence::rim : SideEvidence::none;
    }
  }
}

}  // namespace omr
