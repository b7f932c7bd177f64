#ifndef OUTDOOR_OMR_CORE_BOARD_SEARCH_H
#define OUTDOOR_OMR_CORE_BOARD_SEARCH_H

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "checkerboards/corners/corner_look.h"
#include "checkerboards/judgement/board_sections.h"
#include "checkerboards/lattice/lattice.h"
#include "checkerboards/lattice/lattice_extent.h"
#include "checkerboards/seeds/groups.h"
#include "checkerboards/seeds/search_map.h"
#include "outdoor_omr/checkerboard.h"

namespace omr
{
/** A lattice that is a board. */
struct BoardCandidate
{
  Lattice lattice;
  std::array<SideEvidence, 4> sides;
  std::vector<cv::Point2f> outline;
  std::optional<Checkerboard> finished;
};

/** Adds a board; of boards in one place the one with most corners stays. */
void addCandidate(BoardCandidate&& candidate, std::vector<BoardCandidate>& candidates);

/**
 * Grows a lattice from each seed in the open, and adds those that are boards.
 *
 * @param map      where to begin; receives the places of boards and of failures.
 * @param sections receive what may be a part of a board.
 */
void findBoards(const std::vector<Seed>& seeds, CornerLooker& looker, SearchMap& map,
                std::vector<BoardCandidate>& candidates, BoardSections& sections);

}  // namespace omr

#endif
