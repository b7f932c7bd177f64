#include "border.h"

#include <algorithm>

#include "checkerboards/corners/rim_look.h"
#include "lattice_prediction.h"

namespace omr
{
bool BorderLine::mayEnd() const
{
  constexpr float MIN_SHARE = 0.35F;
  return seen >= 3 && goes_on == 0 && static_cast<float>(seen) >= MIN_SHARE * static_cast<float>(places);
}

bool BorderLine::ends() const
{
  constexpr float MIN_SHARE = 0.5F;
  return seen >= 2 && seen > goes_on && goes_on <= MAX_GOING_ON &&
         static_cast<float>(seen) >= MIN_SHARE * static_cast<float>(places);
}

bool BorderLine::endsBare() const
{
  constexpr int MIN_BARE = 4;  // an object over the board ends squares too, but seldom four along one line of them
  constexpr float MIN_SHARE = 0.7F;
  return bare >= MIN_BARE && goes_on == 0 && static_cast<float>(bare) >= MIN_SHARE * static_cast<float>(places);
}

namespace
{
/** The place of a node on a side's border; the dark square inside is the one towards u and v with u * v = -sign.
 *
 * @return false if nothing is forecast there.
 */
bool placeAt(const Lattice& lattice, Side side, const Node& node, int window, RimPlace& place)
{
  const int in = inwards(side);
  const int across = -lattice.sign(node.row, node.col) * in;
  place.along_row = isRow(side);
  place.dark_u = isRow(side) ? across : in;
  place.dark_v = isRow(side) ? in : across;
  return predictNode(lattice, node.row, node.col, window, place.predicted);
}
}  // namespace

BorderLine lookAtLine(const Lattice& lattice, const Frame& frame, Side side, int line, int window)
{
  BorderLine result;
  const int start = lineStart(lattice, side);
  const int end = start + lineLength(lattice, side);
  const float contrast = lattice.medianContrast();
  for (int t = start - 1; t <= end; ++t)
  {
    const Node node = nodeOnLine(side, line, t);
    RimPlace place;
    if (!placeAt(lattice, side, node, window, place))
    {
      continue;
    }
    const int across = isRow(side) ? place.dark_u : place.dark_v;
    const bool is_corner_square = (t == start - 1 && across < 0) || (t == end && across > 0);
    const bool light_follows = across < 0 && t < end;  // each light square once, from the node before it
    result.margins += light_follows && marginFollows(frame, place) ? 1 : 0;
    if (is_corner_square)
    {
      continue;
    }
    if (!isInside(frame.raw_grey, place.predicted.node, 2))
    {
      ++result.outside;
      continue;
    }
    ++result.places;
    const RimLook look = lookAtRim(frame, place, contrast);
    result.seen += look == RimLook::outer_corner ? 1 : 0;
    result.edges += look == RimLook::outer_edge ? 1 : 0;
    result.bare += look == RimLook::bare_edge ? 1 : 0;
    result.goes_on += look == RimLook::inner_corner ? 1 : 0;
  }
  return result;
}

BorderLine lookAtBorder(const Lattice& lattice, const Frame& frame, Side side, int distance)
{
  return lookAtLine(lattice, frame, side, lineIndex(lattice, side, distance), BORDER_WINDOW + distance);
}

int rimBeyond(const Lattice& lattice, const Frame& frame, Side side)
{
  constexpr int CORNERS = 3;  // beyond the border; farther the forecast is too vague
  const int border = lineIndex(lattice, side, 1);
  int most = 0;
  for (const Side neighbor : SIDES)
  {
    if (isRow(neighbor) == isRow(side))
    {
      continue;
    }
    const int rim = lineIndex(lattice, neighbor, 1);
    int seen = 0;
    for (int beyond = 1; beyond <= CORNERS; ++beyond)
    {
      const Node node = nodeOnLine(neighbor, rim, border - beyond * inwards(side));
      RimPlace place;
      const bool is_there = placeAt(lattice, neighbor, node, BORDER_WINDOW + 1 + beyond, place) &&
                            lookAtRim(frame, place, lattice.medianContrast()) == RimLook::outer_corner;
      seen += is_there ? 1 : 0;
    }
    most = std::max(most, seen);
  }
  return most;
}

}  // namespace omr
