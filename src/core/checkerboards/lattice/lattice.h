#ifndef OUTDOOR_OMR_CORE_LATTICE_H
#define OUTDOOR_OMR_CORE_LATTICE_H

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "checkerboards/corners/corner_look.h"
#include "checkerboards/corners/local_frame.h"
#include "radial_model.h"

namespace omr
{
/** A node of the lattice: a place for an inner corner. */
struct LatticeNode
{
  bool found = false;
  cv::Point2f position;   ///< [px]
  float contrast = 0;     ///< see CornerLook
  float correlation = 0;  ///< see CornerLook
  float weight = 1;       ///< of the corner in a surface through all
  std::uint8_t looks = 0;
};

/**
 * Inner corners of one board by row and column, as they are found. The seed lies in the middle of a fixed grid that
 * holds the largest board (20 x 20 inner corners) wherever in it the seed was.
 */
class Lattice
{
 public:
  static constexpr int SIZE = 52;   ///< rows and columns of the grid
  static constexpr int BORDER = 4;  ///< no node is found nearer to the grid's rim, so that neighbours always exist
  static constexpr int SEED = SIZE / 2;

  Lattice();

  /** Empties the lattice and puts the seed's corner in the middle. */
  void start(const LocalFrame& seed, const CornerLook& corner);

  LatticeNode& at(int row, int col)
  {
    first_row_ = std::min(first_row_, row);
    last_row_ = std::max(last_row_, row);
    return nodes_[row * SIZE + col];
  }
  const LatticeNode& at(int row, int col) const
  {
    return nodes_[row * SIZE + col];
  }
  bool found(int row, int col) const
  {
    return at(row, col).found;
  }
  static bool admits(int row, int col)
  {
    return row >= BORDER && col >= BORDER && row < SIZE - BORDER && col < SIZE - BORDER;
  }

  void put(int row, int col, const CornerLook& corner);

  /** Takes all nodes of the box for found, where they are. */
  void fill();

  /** Takes a corner back; the box stays. */
  void remove(int row, int col);

  /** Expected sign of a corner, see CornerLook::sign. */
  int sign(int row, int col) const
  {
    return (row + col) % 2 == 0 ? seed_sign_ : -seed_sign_;
  }

  int count() const
  {
    return count_;
  }
  /** Columns x, rows y of the nodes; the extents of the board once they are settled. */
  cv::Rect box;

  /** As in the picture of a fisheye. */
  bool bends_strongly = false;
  /** Of a lattice that bends strongly, where its corners lie so. */
  std::optional<RadialModel> radial;

  const LocalFrame& seedFrame() const
  {
    return seed_;
  }

  /** Median contrast of the found corners [grey levels]. */
  float medianContrast() const;

 private:
  std::vector<LatticeNode> nodes_;
  LocalFrame seed_;
  int seed_sign_ = 1;
  int count_ = 0;
  int first_row_ = SIZE;  // that may have been written to since the start
  int last_row_ = -1;
};

}  // namespace omr

#endif
