#include "lattice.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "median.h"

namespace omr
{
Lattice::Lattice() : nodes_(SIZE * SIZE)
{
}

void Lattice::start(const LocalFrame& seed, const CornerLook& corner)
{
  // Most lattices end after a few corners, and all nodes together are 76 kB.
  std::fill(nodes_.begin() + std::min(first_row_, last_row_ + 1) * SIZE, nodes_.begin() + (last_row_ + 1) * SIZE,
            LatticeNode());
  first_row_ = SIZE;
  last_row_ = -1;
  seed_ = seed;
  seed_sign_ = corner.sign;
  count_ = 0;
  box = cv::Rect();
  bends_strongly = false;
  radial.reset();
  put(SEED, SEED, corner);
}

void Lattice::put(int row, int col, const CornerLook& corner)
{
  LatticeNode& node = at(row, col);
  count_ += node.found ? 0 : 1;
  node.found = true;
  node.position = corner.position;
  node.contrast = corner.contrast;
  node.correlation = corner.correlation;
  box |= cv::Rect(col, row, 1, 1);
}

void Lattice::fill()
{
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      LatticeNode& node = at(i, j);
      count_ += node.found ? 0 : 1;
      node.found = true;
    }
  }
}

void Lattice::remove(int row, int col)
{
  LatticeNode& node = at(row, col);
  count_ -= node.found ? 1 : 0;
  node.found = false;
}

float Lattice::medianContrast() const
{
  std::vector<float> contrasts;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      if (found(i, j))
      {
        contrasts.push_back(at(i, j).contrast);
      }
    }
  }
  return contrasts.empty() ? 0 : median(std::move(contrasts));
}

}  // namespace omr
