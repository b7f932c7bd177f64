#include "edge_reading.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "board_judgement.h"
#include "checkerboards/corners/corner_fit.h"
#include "checkerboards/corners/corner_ring.h"
#include "checkerboards/corners/edge_look.h"
#include "checkerboards/lattice/edge_line.h"
#include "checkerboards/lattice/lattice_model.h"
#include "checkerboards/lattice/lattice_side.h"
#include "median.h"

namespace omr
{
namespace
{
constexpr float MAX_DEVIATION = 0.1F;  // squares, from an exact model

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
  constexpr int LEAST_LOOKS = 8;   // at corners spread evenly; up to 15 as the division is rounded down
  constexpr int MAX_UNLIKE = 5;    // before the last look
  constexpr int ONE_ALIKE_OF = 3;  // looks
  const int every = std::max(1, lattice.count() / LEAST_LOOKS);
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
      if (!showsEdges(frame, predicted) || looks - alike > MAX_UNLIKE)
      {
        return false;
      }
      ++looks;
      const PyramidView view(frame, squareHeight(predicted));
      alike += lookAtEdges(view, predicted, lattice.sign(i, j)).alike ? 1 : 0;
    }
  }
  return ONE_ALIKE_OF * alike >= looks;
}

/**
 * Looks at the nodes of the box that are not found.
 *
 * @param ratio of the board, once the model is exact; 0: not known.
 * @return median ratio of light to dark of the corners found, logarithm; 0 if there are none.
 */
float lookAtNodes(const Frame& frame, const LatticeModel& model, float ratio, Lattice& lattice)
{
  // The fit goes astray with the shadows' edges through a corner, and the lattice seems uneven: of 648 boards that
  // shadows, gloss, poles and sheets hide in part 517 -> 532 are found, wrong 17 -> 14.
  constexpr float MAX_MOVE = 0.05F;  // squares
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
      const LocalFrame seen{edges.position, predicted.u, predicted.v};
      const cv::Point2f fitted = fitCorner(frame.raw_grey, seen).position;
      corner.position = squaresBetween(seen, fitted) <= MAX_MOVE ? fitted : edges.position;
      corner.contrast = edges.contrast;
      corner.correlation = edges.agreeing;
      if (ratio == 0 || squaresBetween(predicted, corner.position) <= MAX_DEVIATION)
      {
        lattice.put(i, j, corner);
        ratios.push_back(edges.ratio);
      }
    }
  }
  return ratios.empty() ? 0 : median(std::move(ratios));
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

/** Whether the edges of a lattice that is larger than any board say so, too, before all its corners are fitted: a
 * picture full of squares of 12 px spent nine tenths of its time on these. */
bool isTiling(const Frame& frame, const LatticeModel& model, Lattice lattice)
{
  if (!isOvergrown(lattice))
  {
    return false;
  }
  const cv::Rect box = lattice.box;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      CornerLook corner;
      const LocalFrame predicted = model.frameAt(i, j);
      corner.position = predicted.node;
      const PyramidView view(frame, squareHeight(predicted));
      if (showsEdges(frame, predicted) && lookAtEdges(view, predicted, lattice.sign(i, j)).alike)
      {
        lattice.put(i, j, corner);
      }
      else
      {
        lattice.remove(i, j);
      }
    }
  }
  dropEmptyLines(lattice);
  return isOvergrown(lattice);
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
    if (isOvergrown(lattice) || !fitEdges(lattice, true, model))
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
  if (std::min(lattice.box.width, lattice.box.height) < 2 || !fitEdges(lattice, false, model) ||
      !isPromising(frame, model, lattice) || isTiling(frame, model, lattice))
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
    // Shadows draw a few corners on the border as well: below 90 fences drawn over one board 2 wrong sizes -> 0.
    while (std::min(read.box.width, read.box.height) > 1 && lookAtEdgeLine(frame, model, read, side, 0, ratio).ends())
    {
      dropLine(read, side);
    }
    for (int hidden = 0; hidden <= MAX_HIDDEN_LINES; ++hidden)
    {
      if (lookAtEdgeLine(frame, model, read, side, 1 + hidden, ratio).ends())
      {
        addLines(read, side, hidden);
        lookAtNodes(frame, model, ratio, read);
        break;
      }
    }
  }
  // Lines added or dropped on one side change how long the others are, so these are looked at once all are settled.
  for (const Side side : SIDES)
  {
    sides[side] = sideEvidence(lookAtEdgeLine(frame, model, read, side, 1, ratio));
  }
  lattice = read;
  return true;
}

void fitReadCorners(const Frame& frame, Lattice& lattice)
{
  LatticeModel model;
  if (!fitEdges(lattice, true, model))
  {
    return;
  }
  const cv::Rect box = lattice.box;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      if (!lattice.found(i, j))
      {
        continue;
      }
      const LocalFrame predicted = model.frameAt(i, j);
      const cv::Point2f fitted =
          fitCorner(frame.raw_grey, {lattice.at(i, j).position, predicted.u, predicted.v}).position;
      if (squaresBetween(predicted, fitted) <= MAX_DEVIATION)
      {
        lattice.at(i, j).position = fitted;
      }
    }
  }
}

}  // namespace omr
