// The network that scores windows by their features (paper, section 4.5). A plain version:
// include/outdoor_omr/marker_network.h, window_scores.h.

#include "haar.cl"

#define MAX_HIDDEN 256

/**
 * tanh(x / 2) = 1 - 2 / (1 + e^x). The power is 2^n with the nearest n times a series of 2^f, right to 2e-7: a library's
 * exp() may be a call for each lane, and rint() a dozen instructions. A sum with 1.5 * 2^23 ends in the nearest integer.
 */
INLINE float16 activation(float16 x)
{
  const float to_integer = 12582912.0f;
  const float16 y = clamp(x * 1.44269504f, -60.0f, 60.0f);
  const float16 shifted = y + to_integer;
  const float16 f = (y - (shifted - to_integer)) * 0.693147181f;
  float16 series = f * (1.0f / 720) + 1.0f / 120;
  series = f * series + 1.0f / 24;
  series = f * series + 1.0f / 6;
  series = f * series + 0.5f;
  series = f * series + 1.0f;
  series = f * series + 1.0f;
  return 1 - 2 / (1 + as_float16(as_int16(series) + (as_int16(shifted) << 23)));
}

/** @param weights of 16 hidden units at a time a row for each of the INPUTS, then of each output: one a hidden unit, and the
 * bias; both padded to 16. */
INLINE float2 networkScores(const float* features, global const float* weights, int hidden)
{
  float units[MAX_HIDDEN + 16];
  const int padded = (hidden + 1 + 15) / 16 * 16;
  for (int unit = 0; unit < padded; ++unit)
  {
    units[unit] = 0;
  }
  const int groups = (hidden + 15) / 16;
  for (int group = 0; group < groups; ++group)
  {
    global const float* of_group = weights + group * INPUTS * 16;
    float16 sums[4] = {0, 0, 0, 0};  // which need not wait for each other
    for (int i = 0; i < INPUTS; i += 4)
    {
#pragma unroll
      for (int k = 0; k < 4; ++k)
      {
        sums[k] += features[i + k] * vload16(i + k, of_group);
      }
    }
    vstore16((sums[0] + sums[1]) + (sums[2] + sums[3]), group, units);
  }
  for (int i = 0; i < padded / 16; ++i)
  {
    vstore16(activation(vload16(i, units)), i, units);
  }
  units[hidden] = 1;
  float8 checkerboard = 0;
  float8 target = 0;
  global const float* outputs = weights + groups * INPUTS * 16;
  for (int i = 0; i < padded / 8; ++i)
  {
    checkerboard += vload8(i, outputs) * vload8(i, units);
    target += vload8(i, outputs + padded) * vload8(i, units);
  }
  const float4 c = checkerboard.lo + checkerboard.hi;
  const float4 t = target.lo + target.hi;
  float16 sums = 0;
  sums.s0 = c.x + c.y + c.z + c.w;
  sums.s1 = t.x + t.y + t.z + t.w;
  return activation(sums).s01;
}

/** The scores of one window; -1 where it has too little contrast. */
INLINE float2 windowScores(global const short* window, int cells_across, size_t plane, global const uchar* tables,
                           int crossings, global const float* weights, int hidden)
{
  float features[INPUTS];
  return haarFeatures(window, cells_across, plane, tables, crossings, features)
             ? networkScores(features, weights, hidden)
             : (float2)(-1, -1);
}

/**
 * The scores of every second window of every second row of a level, one group such a row: checkerboard and target, -1
 * to 1.
 *
 * @param passes of each of them, as gateWindows gives them.
 * @param first  of the level in scores.
 */
kernel GROUP void scoreWindows(global const short* restrict cells, int cells_across, int cells_down,
                               global const uchar* restrict tables, int crossings,
                               global const float* restrict weights, int hidden, global const uchar* restrict passes,
                               int windows_across, int first, global float2* restrict scores)
{
  const size_t plane = (size_t)cells_down * cells_across;
  const int row = get_group_id(0);
  const int looked_across = (windows_across + 1) / 2;
  global const short* start = cells + (size_t)2 * row * WINDOW_STRIDE * cells_across;
  global float2* out = scores + first + (size_t)2 * row * windows_across;
  for (int i = get_local_id(0); i < looked_across; i += LANES)
  {
    out[2 * i] = passes[row * looked_across + i] != 0
                     ? windowScores(start + 2 * WINDOW_STRIDE * i, cells_across, plane, tables, crossings, weights,
                                    hidden)
                     : (float2)(-1, -1);
  }
}

/**
 * The scores of the other windows of a level, one group a row: of those beside one that scoreWindows gave a score above
 * followed, whether they pass the gate or not; the rest gets -1.
 */
kernel GROUP void followWindows(global const short* restrict cells, int cells_across, int cells_down,
                                global const uchar* restrict tables, int crossings,
                                global const float* restrict weights, int hidden, float followed, int windows_across,
                                int windows_down, int first, global float2* scores)
{
  const size_t plane = (size_t)cells_down * cells_across;
  const int row = get_group_id(0);
  global const short* start = cells + (size_t)row * WINDOW_STRIDE * cells_across;
  global float2* level = scores + first;
  for (int i = get_local_id(0); i < windows_across; i += LANES)
  {
    if (row % 2 == 0 && i % 2 == 0)
    {
      continue;
    }
    float best = -1;
    for (int y = row - row % 2; y <= min(windows_down - 1, row + row % 2); y += 2)
    {
      for (int x = i - i % 2; x <= min(windows_across - 1, i + i % 2); x += 2)
      {
        const float2 beside = level[y * windows_across + x];
        best = max(best, max(beside.x, beside.y));
      }
    }
    level[row * windows_across + i] =
        best > followed
            ? windowScores(start + WINDOW_STRIDE * i, cells_across, plane, tables, crossings, weights, hidden)
            : (float2)(-1, -1);
  }
}
