#include "edge_growth.h"

#include <algorithm>
#include <cmath>

#include "checkerboards/corners/corner_ring.h"
#include "checkerboards/corners/edge_look.h"
#include "lattice_prediction.h"

namespace omr
{
namespace
{
constexpr int PREDICTION_WINDOW = 3;  // nodes
constexpr int MIN_CORNERS = 6;
constexpr int ENOUGH = 16;  // for a plane through them

/**
 * @param ratio of the board's light to its dark, logarithm; 0 before the first corner, which says it.
 * @return      that of this corner; 0 if there is none.
 */
float lookAt(const Frame& frame, const LocalFrame& predicted, int sign, float ratio, CornerLook& corner)
{
  constexpr float MAX_DIFFERENCE = 0.35F;  // of the ratio
  if (!showsEdges(frame, predicted))
  {
    return 0;
  }
  const PyramidView view(frame, squareHeight(predicted));
  CornerEdges edges = lookAtEdges(view, predicted, sign);
  if (ratio > 0 && (!edges.alike || std::abs(edges.ratio - ratio) > MAX_DIFFERENCE * ratio))
  {
    // Of 648 boards that shadows, gloss, poles and sheets hide in part 528 -> 532 are found.
    edges = lookAtKnownEdges(view, predicted, sign, ratio);
  }
  corner.position = edges.position;
  corner.sign = sign;
  corner.contrast = edges.contrast;
  corner.correlation = edges.agreeing;
  return edges.alike ? edges.ratio : 0;
}

/** Of the squares around a corner that alternate, the light ones: see CornerLook::sign. */
int signAt(const Frame& frame, const LocalFrame& corner)
{
  constexpr float OFFSET = 0.3F;  // squares
  const PyramidView view(frame, squareHeight(corner));
  float difference = 0;
  for (int q = 0; q < QUADRANTS; ++q)
  {
    const float value = greyLogarithm(view.sample(corner.at(OFFSET * QUADRANT_U[q], OFFSET * QUADRANT_V[q])));
    difference += q % 2 == 0 ? value : -value;
  }
  return difference > 0 ? 1 : -1;
}

/** Looks at all nodes beside the corners. */
void lookAround(const Frame& frame, float ratio, Lattice& lattice)
{
  const cv::Rect box = lattice.box;
  for (int i = box.y - 1; i <= box.br().y; ++i)
  {
    for (int j = box.x - 1; j <= box.br().x; ++j)
    {
      const Lattice& known = lattice;
      const bool beside =
          known.found(i - 1, j) || known.found(i + 1, j) || known.found(i, j - 1) || known.found(i, j + 1);
      LocalFrame predicted;
      CornerLook corner;
      if (Lattice::admits(i, j) && !known.found(i, j) && beside &&
          predictNode(lattice, i, j, PREDICTION_WINDOW, predicted) &&
          lookAt(frame, predicted, lattice.sign(i, j), ratio, corner) > 0)
      {
        lattice.put(i, j, corner);
      }
    }
  }
}
}  // namespace

bool growByEdges(const Frame& frame, const LocalFrame& seed, Lattice& lattice)
{
  CornerLook corner;
  const float ratio = lookAt(frame, seed, signAt(frame, seed), 0, corner);
  if (ratio <= 0)
  {
    return false;
  }
  lattice.start(seed, corner);
  for (int before = 0; lattice.count() > before && lattice.count() < ENOUGH;)
  {
    before = lattice.count();
    lookAround(frame, ratio, lattice);
  }
  return lattice.count() >= MIN_CORNERS;
}

}  // namespace omr
