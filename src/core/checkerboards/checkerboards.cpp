#include "checkerboards.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <opencv2/core.hpp>
#include <utility>

#include "board_search.h"
#include "checkerboards/corners/corner_look.h"
#include "checkerboards/judgement/board_judgement.h"
#include "checkerboards/judgement/board_sections.h"
#include "checkerboards/judgement/regularity.h"
#include "checkerboards/judgement/size_certainty.h"
#include "checkerboards/lattice/checkerboard_order.h"
#include "checkerboards/lattice/corners.h"
#include "checkerboards/lattice/lattice.h"
#include "checkerboards/lattice/lattice_evidence.h"
#include "checkerboards/lattice/lattice_seam.h"
#include "checkerboards/seeds/eroded_squares.h"
#include "checkerboards/seeds/groups.h"
#include "checkerboards/seeds/grown_squares.h"
#include "checkerboards/seeds/saddle_groups.h"
#include "checkerboards/seeds/search_map.h"
#include "checkerboards/seeds/square_shape.h"
#include "resized_part.h"

namespace omr
{
namespace
{
void moveToImage(const ResizedPart& part, Lattice& lattice)
{
  for (int i = lattice.box.y; i < lattice.box.br().y; ++i)
  {
    for (int j = lattice.box.x; j < lattice.box.br().x; ++j)
    {
      lattice.at(i, j).position = cv::Point2f(part.toImage(lattice.at(i, j).position));
    }
  }
}

/** @param part that the candidate was found in, with its frame. @param frame, regions of the image. */
Checkerboard finish(const BoardCandidate& candidate, const Frame& part_frame, const ResizedPart& part,
                    const Frame& frame, const RegionMap& regions)
{
  Lattice lattice = candidate.lattice;  // of the search, which may go on with it
  const bool joined = hasSeam(lattice);
  const std::vector<bool> seen = refineCorners(part_frame, lattice);
  const bool certain = !joined && isSizeCertain(part_frame, lattice, seen, candidate.sides);
  moveToImage(part, lattice);
  Checkerboard board = orderCheckerboard(lattice, seen);
  const Regularity regularity =
      checkRegularity(squareCorners(lattice), board.rows, board.cols, regions, frame.grey.front());
  board.regularity = regularity.share;
  board.squares_seen = regularity.seen;
  const cv::Rect2f picture(0, 0, static_cast<float>(frame.raw_grey.cols - 1),
                           static_cast<float>(frame.raw_grey.rows - 1));
  const bool inside = std::all_of(board.corners.begin(), board.corners.end(),
                                  [&](const auto& corner) { return picture.contains(corner); });
  board.size_certain = inside && certain;
  return board;
}

/**
 * Finds boards whose squares have parted in too much light, where these are grown until they touch. Their size is never
 * certain, as squares of the rim may be gone.
 */
void findEroded(const ErodedPart& eroded, const Frame& frame, const RegionMap& regions, int looks,
                std::vector<BoardCandidate>& candidates)
{
  // A grid of dots has half of the corners of a board that lies across it; of 67 boards found below too much light all
  // have 0.78 at least, 65 nearly all.
  constexpr float MIN_FILL = 0.75F;
  ResizedPart part;
  const Frame grown = growDarkSquares(frame, eroded, part);
  SearchMap map(grown.raw_grey.size());
  CornerLooker looker(grown, looks);
  std::vector<BoardCandidate> found;
  BoardSections sections;
  findBoards(groupSaddlePoints(grown, 0, false, map), looker, map, found, sections);
  for (BoardCandidate& candidate : found)
  {
    candidate.finished = finish(candidate, grown, part, frame, regions);
    candidate.finished->size_certain = false;
    const float fill = latticeEvidence(candidate.lattice).fill;
    if (fill >= MIN_FILL && !leavesRemnants(frame, *candidate.finished))
    {
      moveToImage(part, candidate.lattice);
      candidate.outline = boardOutline(candidate.lattice);
      addCandidate(std::move(candidate), candidates);
    }
  }
}

std::vector<Checkerboard> finishAll(std::vector<BoardCandidate>& candidates, const Frame& frame,
                                    const RegionMap& regions)
{
  cv::parallel_for_(cv::Range(0, static_cast<int>(candidates.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
    {
      if (!candidates[i].finished)
      {
        candidates[i].finished = finish(candidates[i], frame, {}, frame, regions);
      }
    }
  });
  std::vector<Checkerboard> boards;
  boards.reserve(candidates.size());
  for (const BoardCandidate& candidate : candidates)
  {
    boards.push_back(*candidate.finished);
  }
  return boards;
}

std::vector<Checkerboard> finishSections(const BoardSections& sections, const std::vector<BoardCandidate>& boards,
                                         const Frame& frame, const RegionMap& regions)
{
  std::vector<std::vector<cv::Point2f>> outlines;
  std::transform(boards.begin(), boards.end(), std::back_inserter(outlines),
                 [](const BoardCandidate& board) { return board.outline; });
  std::vector<BoardCandidate> candidates;
  for (const Lattice& lattice : sections.beside(outlines))
  {
    if (!liesAcross(lattice) && !isOfDots(frame, lattice))
    {
      candidates.push_back(
          {lattice, {SideEvidence::none, SideEvidence::none, SideEvidence::none, SideEvidence::none}, {}, {}});
    }
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
  constexpr double ERODED_SHARE = .2;  // of each part in too much light
  SearchMap map(frame.raw_grey.size());
  std::vector<BoardCandidate> candidates;
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
  if (settings.checkerboard_second_look)
  {
    for (const ErodedPart& part : findErodedParts(frame, map))
    {
      findEroded(part, frame, regions, static_cast<int>(ERODED_SHARE * settings.checkerboard_looks), candidates);
    }
  }
  if (sections != nullptr)
  {
    *sections = finishSections(found_sections, candidates, frame, regions);
  }
  return finishAll(candidates, frame, regions);
}

}  // namespace omr
