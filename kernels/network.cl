// The network that scores windows by their features (paper, section 4.5). A plain version:
// include/outdoor_omr/marker_network.h, window_scores.h.

#include "haar.cl"
#include "levels.cl"

/** Units that are summed together, so that the sums need not wait for each other. */
#define UNITS 16

/** Inputs that are summed by themselves: the scores are right to 5e-6 so, instead of 1e-5. */
#define PART 16

/**
 * tanh(x / 2) = 1 - 2 / (1 + e^x). The power is 2^n with the nearest n times a series of 2^f, right to 2e-7: a library's
 * exp() may be a call for each lane, and rint() a dozen instructions. A sum with 1.5 * 2^23 ends in the nearest integer.
 */
INLINE Floats activation(Floats x)
{
  const float to_integer = 12582912.0f;
  const Floats y = clamp(x * 1.44269504f, -60.0f, 60.0f);
  const Floats shifted = y + to_integer;
  const Floats f = (y - (shifted - to_integer)) * 0.693147181f;
  Floats series = f * (1.0f / 720) + 1.0f / 120;
  series = f * series + 1.0f / 24;
  series = f * series + 1.0f / 6;
  series = f * series + 0.5f;
  series = f * series + 1.0f;
  series = f * series + 1.0f;
  return 1 - 2 / (1 + AS_FLOATS(AS_INTS(series) + (AS_INTS(shifted) << 23)));
}

/** The two scores of windows. @param weights of UNITS hidden units at a time a row for each of the INPUTS, then of each
 * output: one a hidden unit, and the bias; both padded to UNITS. */
INLINE void networkScores(const Floats* features, global const float* weights, int hidden, Floats* checkerboard,
                          Floats* target)
{
  const int padded = (hidden + UNITS) / UNITS * UNITS;
  global const float* of_checkerboard = weights + (hidden + UNITS - 1) / UNITS * UNITS * INPUTS;
  global const float* of_target = of_checkerboard + padded;
  *checkerboard = of_checkerboard[hidden];
  *target = of_target[hidden];
  for (int first = 0; first < hidden; first += UNITS)
  {
    Floats sums[UNITS];
#pragma unroll
    for (int unit = 0; unit < UNITS; ++unit)
    {
      sums[unit] = 0;
    }
    for (int part = 0; part < INPUTS; part += PART)
    {
      Floats sums_of_part[UNITS];
#pragma unroll
      for (int unit = 0; unit < UNITS; ++unit)
      {
        sums_of_part[unit] = 0;
      }
      for (int i = part; i < min(part + PART, INPUTS); ++i)
      {
        const Floats feature = features[i];
#pragma unroll
        for (int unit = 0; unit < UNITS; ++unit)
        {
          sums_of_part[unit] += feature * weights[unit];
        }
        weights += UNITS;
      }
#pragma unroll
      for (int unit = 0; unit < UNITS; ++unit)
      {
        sums[unit] += sums_of_part[unit];
      }
    }
    for (int unit = 0; unit < min(UNITS, hidden - first); ++unit)
    {
      const Floats active = activation(sums[unit]);
      *checkerboard += active * of_checkerboard[first + unit];
      *target += active * of_target[first + unit];
    }
  }
  *checkerboard = activation(*checkerboard);
  *target = activation(*target);
}

/** The places of the windows of a list from the first one on; where it ends, of the last one again. */
INLINE Places placesOf(global const uint* list, uint first, uint count, global const short* cells,
                       global const Level* levels)
{
  Places places;
  for (int i = 0; i < WINDOWS; ++i)
  {
    const WindowAt at = windowAt(levels, list[min(first + i, count - 1)]);
    global const Level* level = levels + at.level;
    places.across[i] = level->cells_across;
    places.plane[i] = (size_t)level->cells_across * level->cells_down;
    places.first[i] = cells + level->first_cell + WINDOW_STRIDE * ((size_t)at.y * level->cells_across + at.x);
  }
  return places;
}

/** Adds the windows beside one to a list, once: those without a score whose score nobody has taken yet. */
INLINE void follow(global const Level* levels, uint window, global int* scores, global Lists* lists,
                   global uint* beside)
{
  const WindowAt at = windowAt(levels, window);
  global const Level* level = levels + at.level;
  for (int y = max(0, at.y - 1); y <= min(level->windows_down - 1, at.y + 1); ++y)
  {
    for (int x = max(0, at.x - 1); x <= min(level->windows_across - 1, at.x + 1); ++x)
    {
      const uint other = level->first_window + y * level->windows_across + x;
      if ((x % 2 != 0 || y % 2 != 0) && atomic_xchg(scores + 2 * other, TAKEN) != TAKEN)
      {
        beside[atomic_inc(&lists->beside)] = other;
      }
    }
  }
}

/**
 * The scores of the windows that are likely, or then of those beside one with a score above followed: checkerboard and
 * target, -1 to 1. A lane takes WINDOWS of them at a time.
 *
 * @param second whether the second list is looked at.
 * @param scores -1 of all others.
 */
kernel GROUP void scoreWindows(global const short* restrict cells, global const Level* restrict levels,
                               global const uchar* restrict tables, int crossings,
                               global const float* restrict weights, int hidden, float followed, int second,
                               global const uint* likely, global uint* beside, global Lists* lists,
                               global float2* scores)
{
  global const uint* list = second != 0 ? beside : likely;
  const uint count = second != 0 ? lists->beside : lists->likely;
  for (uint first = WINDOWS * get_global_id(0); first < count; first += WINDOWS * get_global_size(0))
  {
    Floats features[INPUTS];
    const Places places = placesOf(list, first, count, cells, levels);
    const Ints has_contrast = haarFeatures(&places, tables, crossings, features);
    FloatsOf checkerboard = {-1};
    FloatsOf target = {-1};
    if (ANY(has_contrast))
    {
      networkScores(features, weights, hidden, &checkerboard.all, &target.all);
      checkerboard.all = has_contrast ? checkerboard.all : (Floats)-1;
      target.all = has_contrast ? target.all : (Floats)-1;
    }
    for (uint i = 0; i < min((uint)WINDOWS, count - first); ++i)
    {
      const uint window = list[first + i];
      scores[window] = (float2)(checkerboard.of[i], target.of[i]);
      if (second == 0 && max(checkerboard.of[i], target.of[i]) > followed)
      {
        follow(levels, window, (global int*)scores, lists, beside);
      }
    }
  }
}
