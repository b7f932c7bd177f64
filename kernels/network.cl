// The network that scores windows by their features (paper, section 4.5). A plain version:
// include/outdoor_omr/marker_network.h, window_scores.h.

#include "haar.cl"

#define MAX_HIDDEN 256

/** tanh(x / 2). */
INLINE float8 activation(float8 x)
{
  return 1 - 2 / (1 + exp(x));
}

/** @param weights of each hidden unit: INPUTS, then of each output: one a hidden unit, and the bias; padded to 8. */
INLINE float2 networkScores(const float* features, global const float* weights, int hidden)
{
  float units[MAX_HIDDEN + 8];
  const int padded = (hidden + 1 + 7) / 8 * 8;
  for (int unit = 0; unit < padded; ++unit)
  {
    units[unit] = 0;
  }
  for (int unit = 0; unit < hidden; ++unit)
  {
    global const float* row = weights + unit * INPUTS;
    float8 sum = 0;
    for (int i = 0; i < INPUTS / 8; ++i)
    {
      sum += vload8(i, row) * vload8(i, features);
    }
    const float4 half_sum = sum.lo + sum.hi;
    units[unit] = half_sum.x + half_sum.y + half_sum.z + half_sum.w;
  }
  for (int i = 0; i < padded / 8; ++i)
  {
    vstore8(activation(vload8(i, units)), i, units);
  }
  units[hidden] = 1;
  float8 checkerboard = 0;
  float8 target = 0;
  global const float* outputs = weights + hidden * INPUTS;
  for (int i = 0; i < padded / 8; ++i)
  {
    checkerboard += vload8(i, outputs) * vload8(i, units);
    target += vload8(i, outputs + padded) * vload8(i, units);
  }
  const float4 c = checkerboard.lo + checkerboard.hi;
  const float4 t = target.lo + target.hi;
  const float8 scores = activation((float8)(c.x + c.y + c.z + c.w, t.x + t.y + t.z + t.w, 0, 0, 0, 0, 0, 0));
  return scores.s01;
}

/**
 * The scores of the windows of a level, one group a row of windows: checkerboard and target, -1 to 1.
 *
 * @param first of the level in scores.
 */
kernel GROUP void scoreWindows(global const short* restrict cells, int cells_across, int cells_down,
                               global const uchar* restrict tables, int crossings,
                               global const float* restrict weights, int hidden, int windows_across, int first,
                               global float2* restrict scores)
{
  const size_t plane = (size_t)cells_down * cells_across;
  const int row = get_group_id(0);
  global const short* start = cells + (size_t)row * WINDOW_STRIDE * cells_across;
  for (int i = get_local_id(0); i < windows_across; i += LANES)
  {
    float features[INPUTS];
    const bool contrast =
        haarFeatures(start + WINDOW_STRIDE * i, cells_across, plane, tables, crossings, features);
    scores[first + row * windows_across + i] = contrast ? networkScores(features, weights, hidden) : (float2)(-1, -1);
  }
}
