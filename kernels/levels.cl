// Where the cells and windows of a level lie, and the lists of windows that are looked at.

#ifndef OUTDOOR_OMR_LEVELS_CL
#define OUTDOOR_OMR_LEVELS_CL

#include "geometry.cl"

/** The sizes of haar_features.h. */
#define LEVELS 6

/** Shared with src/gpu/window_buffers.h. */
typedef struct
{
  uint first_cell;  // of all levels
  int cells_across, cells_down;
  uint first_window;  // of all levels
  int windows_across, windows_down;
} Level;

/** Lengths of the lists of windows, shared with src/gpu/window_buffers.h. */
typedef struct
{
  uint likely;  // what the gate lets pass
  uint beside;  // one with a score that is followed
} Lists;

/** In the place of a score: the bits of a number that none is. */
#define TAKEN 0x7fffffff

typedef struct
{
  int level, x, y;
} WindowAt;

/** @param window number among those of all levels. */
INLINE WindowAt windowAt(global const Level* levels, uint window)
{
  WindowAt at = {0, 0, 0};
  while (at.level + 1 < LEVELS && window >= levels[at.level + 1].first_window)
  {
    ++at.level;
  }
  const int i = window - levels[at.level].first_window;
  at.x = i % levels[at.level].windows_across;
  at.y = i / levels[at.level].windows_across;
  return at;
}

#endif
