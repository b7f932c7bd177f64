// The cells of windows in private memory, and how they resemble themselves shifted and turned (paper, section 4.5). A
// plain version: include/outdoor_omr/haar_features.h.

#ifndef OUTDOOR_OMR_WINDOW_CL
#define OUTDOOR_OMR_WINDOW_CL

#include "lanes.cl"

/** The sizes of haar_features.h. */
#define WINDOW_CELLS 8
#define WINDOW_STRIDE 2
#define CELLS (WINDOW_CELLS * WINDOW_CELLS)
#define FIRST_CENTER 5
#define LAST_CENTER 9
#define BEST 3

/** Where the windows lie of which a lane looks at so many together. */
typedef struct
{
  global const short* first[WINDOWS];  // cell in the plane of light
  int across[WINDOWS];                 // cells in a row of the level
  size_t plane[WINDOWS];
} Places;

/** The cells of a plane, row by row. */
INLINE void loadCells(const Places* places, int plane, Shorts* cells)
{
  for (int window = 0; window < WINDOWS; ++window)
  {
    global const short* first = places->first[window] + plane * places->plane[window];
#pragma clang loop vectorize(disable)  // what is strewn is faster one by one
    for (int i = 0; i < CELLS; ++i)
    {
      ((short*)(cells + i))[window] = first[i / WINDOW_CELLS * places->across[window] + i % WINDOW_CELLS];
    }
  }
}

INLINE Ints total(const Shorts* cells)
{
  Ints sum = 0;
  for (int i = 0; i < CELLS; ++i)
  {
    sum += TO_INTS(cells[i]);
  }
  return sum;
}

/** Mean difference from the cells (dx, dy) further. Sums of a row stay below 2^16: a light is at most 2718, which is
 * three logarithms. */
INLINE Floats meanDifference(const Shorts* light, int dx, int dy)
{
  const int rows = WINDOW_CELLS - (int)abs(dy);
  const Shorts* here = light + max(0, -dy) * WINDOW_CELLS;
  const Shorts* there = here + dy * WINDOW_CELLS + dx;
  Ints sum = 0;
  for (int y = 0; y < rows; ++y)
  {
    UShorts of_row = 0;
    for (int x = 0; x < WINDOW_CELLS - dx; ++x)
    {
      of_row += magnitude(there[y * WINDOW_CELLS + x] - here[y * WINDOW_CELLS + x]);
    }
    sum += TO_INTS(of_row);
  }
  return TO_FLOATS(sum) / (float)((WINDOW_CELLS - dx) * rows);
}

INLINE void keepSmallest(Floats* smallest, Floats value)
{
  for (int i = 0; i < BEST; ++i)
  {
    const Floats kept = smallest[i];
    smallest[i] = min(kept, value);
    value = max(kept, value);
  }
}

/**
 * The smallest differences from the windows turned by 180 degrees, and from the negatives of them. Rows above the
 * centre stand for those below it, too.
 */
INLINE void symmetries(const Shorts* light, Ints mean, Floats* same, Floats* negative)
{
  ShortsOf twice;
  const IntsOf means = {2 * mean};
  for (int i = 0; i < WINDOWS; ++i)
  {
    twice.of[i] = means.of[i];
  }
  for (int i = 0; i < BEST; ++i)
  {
    same[i] = negative[i] = 1e9f;
  }
  for (int cy = FIRST_CENTER; cy <= LAST_CENTER; ++cy)
  {
    for (int cx = FIRST_CENTER; cx <= LAST_CENTER; ++cx)
    {
      const int first = max(0, cx - WINDOW_CELLS + 1);
      const int last = min(WINDOW_CELLS - 1, cx);
      Ints differences = 0;
      Ints sums = 0;
      for (int y = max(0, cy - WINDOW_CELLS + 1); 2 * y <= cy; ++y)
      {
        UShorts difference = 0;
        UShorts sum = 0;
        for (int x = first; x <= last; ++x)
        {
          const Shorts a = light[y * WINDOW_CELLS + x];
          const Shorts b = light[(cy - y) * WINDOW_CELLS + cx - x];
          difference += magnitude(a - b);
          sum += magnitude(a + b - twice.all);
        }
        const int times = 2 * y == cy ? 1 : 2;
        differences += times * TO_INTS(difference);
        sums += times * TO_INTS(sum);
      }
      const float count = (last - first + 1) * (WINDOW_CELLS - (int)abs(cy - WINDOW_CELLS + 1));
      keepSmallest(same, TO_FLOATS(differences) / count);
      keepSmallest(negative, TO_FLOATS(sums) / count);
    }
  }
}

#endif
