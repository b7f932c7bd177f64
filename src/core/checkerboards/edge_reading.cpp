#include "edge_reading.h"

#include <algorithm>
#include <vector>

#include "corner_fit.h"
#include "corner_ring.h"
#include "edge_look.h"
#include "lattice_model.h"
#include "lattice_side.h"

namespace omr
{
namespace
{
constexpr int MIN_CORNERS = 6;
constexpr double RIDGE = 0.1;
constexpr double SMOOTH_RIDGE = 0.5;

/** What the edges on and beside a line outside the lattice say, where the board might end. */
struct EdgeLine
{
  bool ends() const
  {
    return dark >= 0.5F && light <= 0.3F && dark - light >= 0.4F && beyond <= 0.4F;
  }
  /** Whether squares lie beside it inside, and none outside: where a shadow's edge runs along the border itself, or the
   * squares of the rim are narrow. Of 1003 sides of boards 0.16 is the most, of 103 where the board goes on all but
   * those read askew have more than 0.4. */
  bool isLast() const
  {
    return inside >= 0.4F && beyond <= 0.15F;
  }

  int places = 0;    // in the picture, the fewer of both kinds
  float dark = 0;    // share of places where a dark square of the rim ends
  float light = 0;   // share of places where a light one ends at a dark one
  float inside = 0;  // share of places between the squares inside where light meets dark
  float beyond = 0;  // the same between the squares that would lie outside
};

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

void clear(Lattice& lattice)
{
  for (int i = lattice.box.y; i < lattice.box.br().y; ++i)
  {
    for (int j = lattice.box.x; j < lattice.box.br().x; ++j)
    {
      lattice.remove(i, j);
    }
  }
}

/** Quick look at a few corners: lattices on clutter end here. */
bool isPromising(const Frame& frame, const LatticeModel& model, const Lattice& lattice)
{
  constexpr int LOOKS = 8;
  constexpr int MIN_ALIKE = 3;
  const int every = std::max(1, lattice.count() / LOOKS);
  int index = 0;
  int looks = 0;
  int alike = 0;
  const cv::Rect box = lattice.box;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      if (!lattice.found(i, j) || index++ % every != 0)
      {
        continue;
      }
      const LocalFrame predicted = model.frameAt(i, j);
      if (!showsEdges(frame, predicted) || looks - alike > LOOKS - MIN_ALIKE)
      {
        return false;
      }
      ++looks;
      const PyramidView view(frame, squareHeight(predicted));
      alike += lookAtEdges(view, predicted, lattice.sign(i, j)).alike ? 1 : 0;
    }
  }
  return MIN_ALIKE * alike >= looks;
}

/**
 * Looks at the nodes of the box that are not found.
 *
 * @param ratio of the board, once the model is exact; 0: not known.
 * @return median ratio of light to dark of the corners found, logarithm; 0 if there are none.
 */
float lookAtNodes(const Frame& frame, const LatticeModel& model, float ratio, Lattice& lattice)
{
  constexpr float MAX_DEVIATION = 0.1F;  // squares, from an exact model
  std::vector<float> ratios;
  const cv::Rect box = lattice.box;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      const LocalFrame predicted = model.frameAt(i, j);
      if (!Lattice::admits(i, j) || lattice.found(i, j) || !showsEdges(frame, predicted))
      {
        continue;
      }
      const PyramidView view(frame, squareHeight(predicted));
      const int sign = lattice.sign(i, j);
      const CornerEdges edges =
          ratio > 0 ? lookAtKnownEdges(view, predicted, sign, ratio) : lookAtEdges(view, predicted, sign);
      if (!edges.alike)
      {
        continue;
      }
      CornerLook corner;
      corner.position = fitCorner(frame.raw_grey, {edges.position, predicted.u, predicted.v}).position;
      corner.contrast = edges.contrast;
      corner.correlation = edges.agreeing;
      if (ratio == 0 || squaresBetween(predicted, corner.position) <= MAX_DEVIATION)
      {
        lattice.put(i, j, corner);
        ratios.push_back(edges.ratio);
      }
    }
  }
  if (ratios.empty())
  {
    return 0;
  }
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

/** @param distance of the line from the outermost corners. */
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

void dropEmptyLines(Lattice& lattice)
{
  constexpr float MIN_SHARE = 0.4F;
  const auto is_empty = [&](Side side) {
    const auto found = static_cast<float>(countOnLine(lattice, side, lineIndex(lattice, side, 0)));
    return found < std::max(2.F, MIN_SHARE * static_cast<float>(lineLength(lattice, side)));
  };
  while (lattice.box.width > 1 && lattice.box.height > 1)
  {
    const auto* const side = std::find_if(SIDES.begin(), SIDES.end(), is_empty);
    if (side == SIDES.end())
    {
      return;
    }
    dropLine(lattice, *side);
  }
}

/** A plane; once its corners are exact, and the more they are, bent as a lens bends it. */
bool fitModel(const Lattice& lattice, bool exact, LatticeModel& model)
{
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

/** Grows and reads until nothing more is found. @param model through the corners @return their ratio; 0 if none. */
float readCorners(const Frame& frame, Lattice& lattice, LatticeModel& model)
{
  constexpr int ROUNDS = 6;
  float ratio = 0;
  for (int round = 0; round < ROUNDS; ++round)
  {
    const cv::Rect before = lattice.box;
    const int count = lattice.count();
    clear(lattice);
    for (const Side side : SIDES)
    {
      addLines(lattice, side, 1);
    }
    ratio = lookAtNodes(frame, model, 0, lattice);
    if (round > 0 && ratio > 0)
    {
      lookAtNodes(frame, model, ratio, lattice);
    }
    dropEmptyLines(lattice);
    if (!fitModel(lattice, true, model))
    {
      return 0;
    }
    if (round > 0 && lattice.box == before && lattice.count() <= count)
    {
      break;
    }
  }
  lookAtNodes(frame, model, ratio, lattice);
  return ratio;
}

SideEvidence sideEvidence(const EdgeLine& line)
{
  if (line.ends())
  {
    return SideEvidence::doubtful_border;
  }
  return line.places == 0 ? SideEvidence::cut : line.isLast() ? SideEvidence::rim : SideEvidence::none;
}
}  // namespace

bool readByEdges(const Frame& frame, Lattice& lattice, std::array<SideEvidence, 4>& sides)
{
  constexpr int MAX_HIDDEN_LINES = 2;
  LatticeModel model;
  if (std::min(lattice.box.width, lattice.box.height) < 2 || !fitModel(lattice, false, model) ||
      !isPromising(frame, model, lattice))
  {
    return false;
  }
  Lattice read = lattice;
  const float ratio = readCorners(frame, read, model);
  if (ratio == 0)
  {
    return false;
  }
  for (const Side side : SIDES)
  {
    EdgeLine border = lookAtEdgeLine(frame, model, read, side, 1, ratio);
    for (int hidden = 1; hidden <= MAX_HIDDEN_LINES && !border.ends(); ++hidden)
    {
      const EdgeLine beyond = lookAtEdgeLine(frame, model, read, side, 1 + hidden, ratio);
      if (beyond.ends())
      {
        addLines(read, side, hidden);
        lookAtNodes(frame, model, ratio, read);
        border = beyond;
      }
    }
    sides[side] = sideEvidence(border);
  }
  lattice = read;
  return true;
}

}  // namespace omr
