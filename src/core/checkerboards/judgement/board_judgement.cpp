#include "board_judgement.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "checkerboards/lattice/border.h"
#include "checkerboards/lattice/lattice_evidence.h"
#include "checkerboards/lattice/lattice_side.h"

namespace omr
{
namespace
{
// Paper, section 3.4: 5x7 to 21x21 squares; inner corners are one less.
constexpr int MIN_SHORT_SIDE = 4;
constexpr int MIN_LONG_SIDE = 6;
constexpr float MIN_FILL = 0.35F;
// Evidence::doubt() of boards is below 1.2 (99 %), of lattices in clutter above 2.4 (95 %).
constexpr float MAX_DOUBT = 2.3F;
constexpr float MAX_BORDERED_DOUBT = 3.5F;  // with a border on all four sides, which clutter does not have
// With three: a pole across a board hides half of its corners. Of 1347 boards drawn and path-traced below things,
// shadows and light 2 more are found, wrong 17 before and after; nothing in 510 pictures without a board.
constexpr float MAX_MOSTLY_BORDERED_DOUBT = 2.8F;
// Gratings and grids of vents alternate as well, but they have no border and blurred corners.
constexpr float BORDERLESS_CORRELATION = 0.98F;
// Nor are they whole: this many corners without gaps are a board whose border the shadow of a fence hides.
constexpr int BORDERLESS_CORNERS = 40;
constexpr float BORDERLESS_FILL = 0.9F;
// Tiles of a floor or wall are squares as well, and more so: where the picture cuts what shows no border it is a board
// only if little hides it. Of 2090 boards drawn, rendered and photographed 6 are seen so, with 0.92 and more.
constexpr float MIN_CUT_FILL = 0.75F;
// A tiling of round pieces (Truchet) that is cut by the picture all around has all corners, but not on even lines:
// 0.161, where 95 % of the boards are below 0.063. Scaled and cropped photographs without a board: 1 -> 0 boards on
// 1936. Asked of every board without a border it costs 3 of 1641 under shadows, whose ends the picture shows.
constexpr float MAX_CUT_UNEVENNESS = 0.1F;
constexpr float SMALL_SQUARE = 5;  // px; below it nearly all corners must be found
constexpr float SMALL_SQUARE_FILL = 0.85F;
constexpr float MIN_SQUARE = 2;  // px; finer patterns are the sampling's own

bool hasSizeOfBoard(const Lattice& lattice)
{
  const int shorter = std::min(lattice.box.width, lattice.box.height);
  const int longer = std::max(lattice.box.width, lattice.box.height);
  return shorter >= MIN_SHORT_SIDE && longer >= MIN_LONG_SIDE && longer <= MAX_SIDE;
}

float maxDoubt(int borders)
{
  return borders == 4 ? MAX_BORDERED_DOUBT : borders == 3 ? MAX_MOSTLY_BORDERED_DOUBT : MAX_DOUBT;
}

/**
 * Whether the corners are many and few of them hidden; or fewer that lie evenly, as those of small boards that are
 * blurred or have no margin: of 786 boards drawn in scenes of several below things, shadows, gloss and blur 557 -> 570
 * are found. Of 2577 photographs and pictures without a board the lattices as large and as full are none with less than
 * 0.145.
 */
bool isWhole(const Lattice& lattice, const Evidence& evidence)
{
  constexpr int EVEN_CORNERS = 20;
  constexpr float EVEN_FILL = 0.75F;
  constexpr float MAX_EVEN_UNEVENNESS = 0.05F;
  return (lattice.count() >= BORDERLESS_CORNERS && evidence.fill >= BORDERLESS_FILL) ||
         (lattice.count() >= EVEN_CORNERS && evidence.fill >= EVEN_FILL && evidence.unevenness <= MAX_EVEN_UNEVENNESS);
}

/** Whether the corners alone speak for a board, with no border seen. */
bool isClear(const Lattice& lattice, const Evidence& evidence, bool is_cut)
{
  if (is_cut && evidence.fill < MIN_CUT_FILL)
  {
    return false;
  }
  return evidence.correlation >= BORDERLESS_CORRELATION || isWhole(lattice, evidence);
}

}  // namespace

bool liesAcross(const Lattice& lattice)
{
  const cv::Rect& box = lattice.box;
  const int most = std::max(2, std::min(box.width, box.height) / 4);
  const std::array<cv::Point, 4> ends = {box.tl(), cv::Point(box.x, box.br().y - 1), cv::Point(box.br().x - 1, box.y),
                                         box.br() - cv::Point(1, 1)};
  return std::none_of(ends.begin(), ends.end(), [&](const cv::Point& end) {
    for (int i = box.y; i < box.br().y; ++i)
    {
      for (int j = box.x; j < box.br().x; ++j)
      {
        if (lattice.found(i, j) && std::abs(i - end.y) + std::abs(j - end.x) <= most)
        {
          return true;
        }
      }
    }
    return false;
  });
}

bool isOvergrown(const Lattice& lattice)
{
  constexpr int MAX_OVERGROWTH = 4;  // lines
  return std::max(lattice.box.width, lattice.box.height) > MAX_SIDE + MAX_OVERGROWTH;
}

bool mayBePart(const Lattice& lattice, CornerLooker& looker)
{
  if (lattice.count() >= BORDERLESS_CORNERS)
  {
    return true;
  }
  const Evidence evidence = latticeEvidence(lattice);
  return evidence.correlation >= BORDERLESS_CORRELATION || isWhole(lattice, evidence) ||
         std::any_of(SIDES.begin(), SIDES.end(), [&](Side side) {
           const BorderLine border = lookAtBorder(lattice, looker.frame(), side, 1);
           return border.seen >= 2 || border.endsBare();
         });
}

bool isBoard(const Lattice& lattice, const std::array<SideEvidence, 4>& sides)
{
  const Evidence evidence = latticeEvidence(lattice);
  const float height = squareHeight(lattice.seedFrame());
  const auto borders = std::count_if(sides.begin(), sides.end(), [](SideEvidence side) {
    return side == SideEvidence::border || side == SideEvidence::doubtful_border || side == SideEvidence::bare;
  });
  const bool goes_on = std::count(sides.begin(), sides.end(), SideEvidence::none) > 0;
  const auto cuts = std::count(sides.begin(), sides.end(), SideEvidence::cut);
  const bool fills_picture = cuts == 4;
  return hasSizeOfBoard(lattice) && !liesAcross(lattice) && evidence.fill >= MIN_FILL &&
         evidence.doubt() <= maxDoubt(static_cast<int>(borders)) &&
         (borders > 0 || isClear(lattice, evidence, cuts > 0)) && !goes_on &&
         (!fills_picture || evidence.unevenness <= MAX_CUT_UNEVENNESS) && height >= MIN_SQUARE &&
         (height >= SMALL_SQUARE || evidence.fill >= SMALL_SQUARE_FILL);
}

bool isBoardOfEdges(const Lattice& lattice, const std::array<SideEvidence, 4>& sides)
{
  constexpr float MIN_READ_FILL = 0.6F;
  constexpr float MAX_READ_UNEVENNESS = 0.06F;  // 0.08: of 2574 boards below drawn fences 10 more found, 2 more wrong
  constexpr int MIN_BORDERS = 2;
  // Lines that were added up to the edge of a shadow have no corners, they or the next: of some 270 more boards on
  // photographs below drawn fences 4 wrong -> 0.
  constexpr float MIN_LINE_SHARE = 0.33F;
  const bool ends_with_corners = std::all_of(SIDES.begin(), SIDES.end(), [&](Side side) {
    const int last = lineIndex(lattice, side, 0);
    const int found = std::min(countOnLine(lattice, side, last), countOnLine(lattice, side, last + inwards(side)));
    return static_cast<float>(found) >= MIN_LINE_SHARE * static_cast<float>(lineLength(lattice, side));
  });
  const auto count = [&](SideEvidence evidence) { return std::count(sides.begin(), sides.end(), evidence); };
  const Evidence evidence = latticeEvidence(lattice);
  // With cut or narrow rim squares no border is where the lattice has it: of 138 photographs of boards 109 -> 120.
  const bool whole = lattice.count() >= BORDERLESS_CORNERS && evidence.fill >= BORDERLESS_FILL;
  return hasSizeOfBoard(lattice) && !liesAcross(lattice) && ends_with_corners && evidence.fill >= MIN_READ_FILL &&
         evidence.unevenness <= MAX_READ_UNEVENNESS && count(SideEvidence::none) == 0 &&
         (whole || count(SideEvidence::doubtful_border) >= MIN_BORDERS);
}

}  // namespace omr
