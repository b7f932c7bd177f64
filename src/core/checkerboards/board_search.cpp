#include "board_search.h"

#include <algorithm>
#include <utility>

#include "checkerboards/judgement/board_judgement.h"
#include "checkerboards/judgement/edge_reading.h"
#include "checkerboards/lattice/border.h"
#include "checkerboards/lattice/checkerboard_order.h"
#include "checkerboards/lattice/edge_growth.h"
#include "checkerboards/lattice/edge_line.h"
#include "checkerboards/lattice/lattice_evidence.h"
#include "checkerboards/lattice/lattice_gaps.h"
#include "checkerboards/lattice/lattice_growth.h"
#include "checkerboards/lattice/lattice_seam.h"
#include "checkerboards/lattice/lattice_strip.h"
#include "checkerboards/seeds/square_shape.h"

namespace omr
{
namespace
{
constexpr float MAX_GROWING_DOUBT = 2.6F;
constexpr float MAX_GROWN_DOUBT = 2.3F;  // from 36 corners on
constexpr int MIN_CORNERS = 6;           // within reach of one another, or it is no lattice
constexpr int UNLIMITED = Lattice::SIZE * Lattice::SIZE;

void noteFailure(const Lattice& lattice, int failures, SearchMap& map)
{
  const float height = squareHeight(lattice.seedFrame());
  map.addFailure(lattice.seedFrame().node, height, failures);
  for (int i = lattice.box.y; i < lattice.box.br().y; ++i)
  {
    for (int j = lattice.box.x; j < lattice.box.br().x; ++j)
    {
      if (lattice.found(i, j))
      {
        map.addFailure(lattice.at(i, j).position, height, failures);
      }
    }
  }
}

enum class Growth
{
  none,      // too few corners
  doubtful,  // given up
  grown
};

/** Grows a lattice from the seed, giving up as early as clutter shows. @return what it is. */
Growth growFromSeed(const Seed& seed, CornerLooker& looker, Lattice& lattice, SearchMap& map)
{
  CornerQuery query;
  query.tolerance = 0.3F;
  query.search = !seed.is_saddle_point;
  const CornerLook corner = looker.look(seed.frame, query);
  if (!corner.found)
  {
    map.addFailure(seed.frame.node, squareHeight(seed.frame));
    return Growth::none;
  }
  lattice.start(seed.frame, corner);
  // Lattices on clutter end at the first of these stages: they cost 20 looks instead of 500.
  for (int count = 9; count < UNLIMITED; count *= 2)
  {
    growLattice(lattice, looker, count);
    if (lattice.count() < MIN_CORNERS)
    {
      map.addFailure(seed.frame.node, squareHeight(seed.frame));
      return Growth::none;
    }
    Evidence evidence = latticeEvidence(lattice);
    evidence.fill = 1;  // holes are not judged before the gaps are jumped
    if (evidence.doubt() > (lattice.count() < 36 ? MAX_GROWING_DOUBT : MAX_GROWN_DOUBT) || isOvergrown(lattice))
    {
      noteFailure(lattice, 1, map);
      return Growth::doubtful;
    }
    if (lattice.count() < count)
    {
      break;
    }
  }
  return Growth::grown;
}

/** Settles a grown lattice by its corners. @param sides receive what is seen of its sides. @param sections receive what
 * may be a part of a board. */
bool settleByCorners(Lattice& lattice, CornerLooker& looker, SearchMap& map, std::array<SideEvidence, 4>& sides,
                     BoardSections& sections)
{
  if (!mayBePart(lattice, looker))
  {
    noteFailure(lattice, 1, map);
    return false;
  }
  jumpGaps(lattice, looker);
  fillHoles(lattice, looker);
  splitAtBorders(lattice, looker.frame());
  std::vector<Seam> seams = splitAtSeams(lattice);
  const std::vector<Seam> gaps = splitAtStrips(lattice, looker.frame());
  seams.insert(seams.end(), gaps.begin(), gaps.end());
  dropOutliers(lattice);
  sides = settleExtent(lattice, looker);
  settleRims(looker.frame(), lattice, sides);
  for (const Seam& seam : seams)
  {
    // The squares of the next board look as if this one went on.
    if (sides[seam.beyond] == SideEvidence::none && lineIndex(lattice, seam.beyond, 1) == seam.line)
    {
      sides[seam.beyond] = SideEvidence::rim;
    }
  }
  if (!isBoard(lattice, sides))
  {
    sections.add(lattice);
    noteFailure(lattice, 2, map);
    return false;
  }
  return true;
}

/** The same by the edges of its squares, which say what corners do not under hard shadows; a border where both say so.
 */
bool settleByEdges(Lattice& lattice, const Frame& frame, std::array<SideEvidence, 4>& sides)
{
  if (!readByEdges(frame, lattice, sides) || !isBoardOfEdges(lattice, sides))
  {
    return false;
  }
  fitReadCorners(frame, lattice);
  for (const Side side : SIDES)
  {
    if (sides[side] == SideEvidence::doubtful_border && lookAtBorder(lattice, frame, side, 1).ends() &&
        rimBeyond(lattice, frame, side) == 0)
    {
      sides[side] = SideEvidence::border;
    }
  }
  return true;
}
}  // namespace

void addCandidate(BoardCandidate&& candidate, std::vector<BoardCandidate>& candidates)
{
  constexpr int MAX_SHARED = 2;  // corners
  const auto shares_place = [&](const BoardCandidate& other) {
    return countOn(candidate.lattice, other.outline) > MAX_SHARED ||
           countOn(other.lattice, candidate.outline) > MAX_SHARED;
  };
  const bool beaten = std::any_of(candidates.begin(), candidates.end(), [&](const BoardCandidate& other) {
    return other.lattice.count() >= candidate.lattice.count() && shares_place(other);
  });
  if (!beaten)
  {
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), shares_place), candidates.end());
    candidates.push_back(std::move(candidate));
  }
}

void findBoards(const std::vector<Seed>& seeds, CornerLooker& looker, SearchMap& map,
                std::vector<BoardCandidate>& candidates, BoardSections& sections)
{
  Lattice lattice;
  for (const Seed& seed : seeds)
  {
    if (looker.looksLeft() == 0)
    {
      return;
    }
    const int looks = looker.looksLeft();
    if (!map.isOpen(seed.frame.node))
    {
      continue;
    }
    std::array<SideEvidence, 4> sides;
    const Growth growth = growFromSeed(seed, looker, lattice, map);
    const bool settled = (growth == Growth::grown && settleByCorners(lattice, looker, map, sides, sections)) ||
                         ((growth != Growth::none || growByEdges(looker.frame(), seed.frame, lattice)) &&
                          settleByEdges(lattice, looker.frame(), sides));
    if (!settled)
    {
      continue;
    }
    BoardCandidate candidate{lattice, sides, boardOutline(lattice), {}};
    map.close(candidate.outline);
    looker.setLooksLeft(looks);  // only looks in vain count
    if (!isOfDots(looker.frame(), lattice))
    {
      addCandidate(std::move(candidate), candidates);
    }
  }
}

}  // namespace omr
