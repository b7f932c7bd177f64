#ifndef OUTDOOR_OMR_CORE_HAAR_BLOCKS_H
#define OUTDOOR_OMR_CORE_HAAR_BLOCKS_H

#include <cstdlib>

namespace omr
{
/** Of a block of 2 x 2 cells: the sum, and the Haar responses across and down. */
struct HaarBlock
{
  int sum, across, down;
};

/** @param a, b, c, d one channel of the cells, row by row. */
inline HaarBlock haarBlock(int a, int b, int c, int d)
{
  return {a + b + c + d, std::abs(a - b) + std::abs(c - d), std::abs(a - c) + std::abs(b - d)};
}

}  // namespace omr

#endif
