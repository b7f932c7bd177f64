#include "checkerboards.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "board_judgement.h"
#include "board_sections.h"
#include "border.h"
#include "checkerboard_order.h"
#include "corner_look.h"
#include "corners.h"
#include "edge_growth.h"
#include "edge_line.h"
#include "edge_reading.h"
#include "groups.h"
#include "lattice.h"
#include "lattice_evidence.h"
#include "lattice_extent.h"
#include "lattice_gaps.h"
#include "lattice_growth.h"
#include "lattice_seam.h"
#include "regularity.h"
#include "saddle_groups.h"
#include "search_map.h"
#include "size_certainty.h"

namespace omr
{
namespace
{
constexpr float MAX_GROWING_DOUBT = 2.6F;
constexpr float MAX_GROWN_DOUBT = 2.3F;  // from 36 corners on
constexpr int MIN_CORNERS = 6;           // within reach of one another, or it is no lattice
constexpr int UNLIMITED = Lattice::SIZE * Lattice::SIZE;

struct Candidate
{
  Lattice lattice;
  std::array<SideEvidence, 4> sides;
  std::vector<cv::Point2f> outline;
  std::optional<Checkerboard> finished;
};

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
  const std::vector<Seam> seams = splitAtSeams(lattice);
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

/** Adds a board; of boards in one place the one with most corners stays. */
void addCandidate(Candidate&& candidate, std::vector<Candidate>& candidates)
{
  constexpr int MAX_SHARED = 2;  // corners
  const auto shares_place = [&](const Candidate& other) {
    return countOn(candidate.lattice, other.outline) > MAX_SHARED ||
           countOn(other.lattice, candidate.outline) > MAX_SHARED;
  };
  const bool beaten = std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& other) {
    return other.lattice.count() >= candidate.lattice.count() && shares_place(other);
  });
  if (!beaten)
  {
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), shares_place), candidates.end());
    candidates.push_back(std::move(candidate));
  }
}

void findBoards(const std::vector<Seed>& seeds, CornerLooker& looker, SearchMap& map,
                std::vector<Candidate>& candidates, BoardSections& sections)
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
    Candidate candidate{lattice, sides, boardOutline(lattice), {}};
    map.close(candidate.outline);
    looker.setLooksLeft(looks);  // only looks in vain count
    addCandidate(std::move(candidate), candidates);
  }
}

Checkerboard finish(const Candidate& candidate, const Frame& frame, const RegionMap& regions)
{
  Lattice lattice = candidate.lattice;  // of the search, which may go on with it
  const bool joined = hasSeam(lattice);
  const std::vector<bool> seen = refineCorners(frame, lattice);
  Checkerboard board = orderCheckerboard(lattice, seen);
  const Regularity regularity =
      checkRegularity(squareCorners(lattice), board.rows, board.cols, regions, frame.grey.front());
  board.regularity = regularity.share;
  board.squares_seen = regularity.seen;
  const cv::Rect2f picture(0, 0, static_cast<float>(frame.raw_grey.cols - 1),
                           static_cast<float>(frame.raw_grey.rows - 1));
  const bool inside = std::all_of(board.corners.begin(), board.corners.end(),
                                  [&](const auto& corner) { return picture.contains(corner); });
  board.size_certain = inside && !joined && isSizeCertain(frame, lattice, seen, candidate.sides);
  return board;
}

std::vector<Checkerboard> finishAll(std::vector<Candidate>& candidates, const Frame& frame, const RegionMap& regions)
{
  cv::parallel_for_(cv::Range(0, static_cast<int>(candidates.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
    {
      if (!candidates[i].finished)
      {
        candidates[i].finished = finish(candidates[i], frame, regions);
      }
    }
  });
  std::vector<Checkerboard> boards;
  boards.reserve(candidates.size());
  for (const Candidate& candidate : candidates)
  {
    boards.push_back(*candidate.finished);
  }
  return boards;
}

std::vector<Checkerboard> finishSections(const BoardSections& sections, const std::vector<Candidate>& boards,
                                         const Frame& frame, const RegionMap& regions)
{
  std::vector<std::vector<cv::Point2f>> outlines;
  std::transform(boards.begin(), boards.end(), std::back_inserter(outlines),
                 [](const Candidate& board) { return board.outline; });
  std::vector<Candidate> candidates;
  for (const Lattice& lattice : sections.beside(outlines))
  {
    candidates.push_back(
        {lattice, {SideEvidence::none, SideEvidence::none, SideEvidence::none, SideEvidence::none}, {}, {}});
  }
  return finishAll(candidates, frame, regions);
}
}  // namespace

std::vector<Checkerboard> findCheckerboards(const Frame& frame, const RegionMap& regions, const Settings& settings,
                                            const std::function<void(const std::vector<Checkerboard>&)>& use_first,
                                            std::vector<Checkerboard>* sections)
{
  constexpr int MIN_SIDE = 16;  // px of an image that can hold a board
  // Of the allowed looks, those at the saddle points of each level; the second one is for blurred boards: degrade 87 ->
  // 90 of 96, the others for large squares that are soft or faint: degrade 95 -> 96, of 54 boards drawn so 12 -> 22
  // -> 31. Of 268 boards found at the first two none takes more looks in vain, but one with a wrong size; at the others
  // a tenth finds as many as a third and takes half of the time on clutter.
  constexpr std::array<double, 4> SADDLE_SHARES = {.7, .4, .1, .1};
  SearchMap map(frame.raw_grey.size());
  std::vector<Candidate> candidates;
  BoardSections found_sections;
  const auto search = [&](const std::vector<Seed>& seeds, double share) {
    CornerLooker looker(frame, static_cast<int>(share * settings.checkerboard_looks));
    findBoards(seeds, looker, map, candidates, found_sections);
  };
  if (std::min(frame.raw_grey.rows, frame.raw_grey.cols) >= MIN_SIDE)
  {
    search(pairNeighbours(frame, regions), 1);
  }
  if (use_first)
  {
    use_first(finishAll(candidates, frame, regions));
  }
  const int levels = static_cast<int>(std::min(SADDLE_SHARES.size(), frame.grey.size()));
  for (int level = 0; settings.checkerboard_second_look && level < levels; ++level)
  {
    const bool faint = level > 0 && candidates.empty();  // half the size has half the noise
    search(groupSaddlePoints(frame, level, faint, map), SADDLE_SHARES[level]);
  }
  if (sections != nullptr)
  {
    *sections = finishSections(found_sections, candidates, frame, regions);
  }
  return finishAll(candidates, frame, regions);
}

}  // namespace omr
