// The cells of a window in private memory, and how it resembles itself shifted and turned (paper, section 4.5). A plain
// version: include/outdoor_omr/haar_features.h.

#ifndef OUTDOOR_OMR_WINDOW_CL
#define OUTDOOR_OMR_WINDOW_CL

#include "geometry.cl"

/** The sizes of haar_features.h. */
#define WINDOW_CELLS 8
#define WINDOW_STRIDE 2
#define FIRST_CENTER 5
#define LAST_CENTER 9
#define BEST 3

/** The cells of a window row by row, without gaps, so that two rows are compared at once: a shift is a distance in
 * memory. PADDING may be read before and behind them. */
#define PADDING 8
#define PADDED (WINDOW_CELLS * WINDOW_CELLS + 2 * PADDING)

INLINE int8 magnitude(int8 value)
{
  return value > -value ? value : -value;
}

INLINE ushort8 absolute8(short8 value)
{
  return as_ushort8(value > (short8)-value ? value : (short8)-value);
}

INLINE ushort16 absolute16(short16 value)
{
  return as_ushort16(value > (short16)-value ? value : (short16)-value);
}

INLINE int total(int8 v)
{
  return v.s0 + v.s1 + v.s2 + v.s3 + v.s4 + v.s5 + v.s6 + v.s7;
}

/** The columns that have a partner so many cells to the right (negative: to the left). */
INLINE int8 partners(int shift)
{
  const int8 column = (int8)(0, 1, 2, 3, 4, 5, 6, 7) + shift;
  return column >= 0 && column < WINDOW_CELLS;
}

/** Mean difference from the cells (dx, dy) further. @param cells of the window. */
INLINE float meanDifference(const short* cells, int dx, int dy)
{
  const int rows = WINDOW_CELLS - (int)abs(dy);
  const short* here = cells + max(0, -dy) * WINDOW_CELLS;
  const short* there = here + dy * WINDOW_CELLS + dx;
  ushort16 two = 0;
  for (int y = 0; y + 1 < rows; y += 2)
  {
    two += absolute16(vload16(0, there + y * WINDOW_CELLS) - vload16(0, here + y * WINDOW_CELLS));
  }
  ushort8 sum = two.lo + two.hi;
  if (rows % 2 != 0)
  {
    const int last = (rows - 1) * WINDOW_CELLS;
    sum += absolute8(vload8(0, there + last) - vload8(0, here + last));
  }
  return (float)total(convert_int8(sum) & partners(dx)) / (float)((WINDOW_CELLS - dx) * rows);
}

INLINE void keepSmallest(float* smallest, float value)
{
  for (int i = 0; i < BEST; ++i)
  {
    const float kept = smallest[i];
    smallest[i] = min(kept, value);
    value = max(kept, value);
  }
}

/**
 * The smallest differences from the window turned by 180 degrees, and from the negative of it.
 *
 * Sums of a column stay below 2^16: eight cells of at most twice 2718, which is three logarithms.
 */
INLINE void symmetries(const short* cells, int mean, float* same, float* negative)
{
  short padded[PADDED];
  short* turned = padded + PADDING;
  for (int i = 0; i < PADDED; ++i)
  {
    padded[i] = 0;
  }
  for (int y = 0; y < WINDOW_CELLS; ++y)
  {
    vstore8(vload8(WINDOW_CELLS - 1 - y, cells).s76543210, y, turned);
  }
  for (int i = 0; i < BEST; ++i)
  {
    same[i] = negative[i] = 1e9f;
  }
  const short twice = 2 * mean;
  for (int cy = FIRST_CENTER; cy <= LAST_CENTER; ++cy)
  {
    const int first = max(0, cy - 7);
    const int rows = min(7, cy) - first + 1;
    for (int cx = FIRST_CENTER; cx <= LAST_CENTER; ++cx)
    {
      const short* here = cells + first * WINDOW_CELLS;
      const short* there = turned + (first + 7 - cy) * WINDOW_CELLS + 7 - cx;
      ushort16 two_differences = 0;
      ushort16 two_sums = 0;
      for (int y = 0; y + 1 < rows; y += 2)
      {
        const short16 a = vload16(0, here + y * WINDOW_CELLS);
        const short16 b = vload16(0, there + y * WINDOW_CELLS);
        two_differences += absolute16(a - b);
        two_sums += absolute16(a + b - twice);
      }
      ushort8 difference = two_differences.lo + two_differences.hi;
      ushort8 sum = two_sums.lo + two_sums.hi;
      if (rows % 2 != 0)
      {
        const short8 a = vload8(rows - 1, here);
        const short8 b = vload8(0, there + (rows - 1) * WINDOW_CELLS);
        difference += absolute8(a - b);
        sum += absolute8(a + b - twice);
      }
      const int8 inside = partners(7 - cx);
      const float count = (float)(rows * (WINDOW_CELLS - (int)abs(7 - cx)));
      keepSmallest(same, (float)total(convert_int8(difference) & inside) / count);
      keepSmallest(negative, (float)total(convert_int8(sum) & inside) / count);
    }
  }
}

#endif
