#ifndef OUTDOOR_OMR_CORE_BOARD_SECTIONS_H
#define OUTDOOR_OMR_CORE_BOARD_SECTIONS_H

#include <opencv2/core.hpp>
#include <vector>

#include "checkerboards/lattice/lattice.h"

namespace omr
{
/** Number of the lattice's corners that lie on the board of the outline. */
int countOn(const Lattice& lattice, const std::vector<cv::Point2f>& outline);

/** Lattices that are no boards, since a side of them is hidden, but may be a section of one. */
class BoardSections
{
 public:
  /** Takes a lattice whose extent is settled, if its corners are clear; of two in one place the one with more corners
   * stays. */
  void add(const Lattice& lattice);

  /** Those that share no place with a board. @param boards outlines. */
  std::vector<Lattice> beside(const std::vector<std::vector<cv::Point2f>>& boards) const;

 private:
  struct Section
  {
    Lattice lattice;
    std::vector<cv::Point2f> outline;
  };

  std::vector<Section> sections_;
};

}  // namespace omr

#endif
