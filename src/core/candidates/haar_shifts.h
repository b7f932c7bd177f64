#ifndef OUTDOOR_OMR_CORE_HAAR_SHIFTS_H
#define OUTDOOR_OMR_CORE_HAAR_SHIFTS_H

#include <cstdlib>

namespace omr
{
/** Units of the brightness of a cell in an octave. */
constexpr int OCTAVE = 256;

/** Number of a shift, or of its opposite, in the order in which they are measured; -1 if it is none. */
inline int shiftIndex(int dx, int dy)
{
  if (dx < 0 || (dx == 0 && dy < 0))
  {
    return shiftIndex(-dx, -dy);
  }
  if (dx > 4 || std::abs(dy) > 4 || (dx == 0 && dy == 0))
  {
    return -1;
  }
  return dx == 0 ? dy - 1 : 4 + (dx - 1) * 9 + dy + 4;
}

/** Calls with (dx, dy) in the order of shiftIndex(). */
template <typename Call>
void forEachShift(const Call& call)
{
  for (int dx = 0; dx <= 4; ++dx)
  {
    for (int dy = dx == 0 ? 1 : -4; dy <= 4; ++dy)
    {
      call(dx, dy);
    }
  }
}

}  // namespace omr

#endif
