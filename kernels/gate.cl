// The first look at windows: a small network on blocks of cells (paper, section 4.5). A plain version:
// gateInputs() in include/outdoor_omr/haar_features.h, window_scores.h.

#include "cells.cl"
#include "network.cl"

#define GATE_UNITS 16
#define LEAST_BLOCK_CONTRAST 640
#define LARGEST_INPUT 6.0f

/** Of a block of a window, from its first one. */
INLINE int offsetOf(int block, int even)
{
  return (2 * (block / 4) + block % 2) * even + block % 4 / 2;
}

/** Of four rows the sums of the 24 differences of neighbours in the left and in the right half. */
INLINE int2 contrastOfHalves(global const short* first, int cells_across)
{
  short8 rows[4];
  for (int y = 0; y < 4; ++y)
  {
    rows[y] = vload8(0, first + (size_t)y * cells_across);
  }
  ushort8 sum = 0;
  for (int y = 0; y < 4; ++y)
  {
    const short8 right = rows[y].s12335677;
    sum += as_ushort8(max(rows[y], right) - min(rows[y], right));
  }
  for (int y = 0; y < 3; ++y)
  {
    sum += as_ushort8(max(rows[y], rows[y + 1]) - min(rows[y], rows[y + 1]));
  }
  return (int2)((ushort)(sum.s0 + sum.s1 + sum.s2 + sum.s3), (ushort)(sum.s4 + sum.s5 + sum.s6 + sum.s7));
}

/** Whether a window has the contrast that its features need: much of what passes has not. @param colors of its first
 * block. */
INLINE bool hasContrast(global const short* first, int cells_across, global const short* colors, int even)
{
  int2 halves[2] = {contrastOfHalves(first, cells_across),
                    contrastOfHalves(first + (size_t)4 * cells_across, cells_across)};
  for (int block = 0; block < 16; ++block)
  {
    const int color = colors[offsetOf(block, even)];
    halves[block / 8] += block % 4 < 2 ? (int2)(color, 0) : (int2)(0, color);
  }
  const int2 least = min(halves[0], halves[1]);
  return min(least.x, least.y) >= LEAST_CONTRAST * 24;
}

/** The same block of WINDOWS windows: they lie side by side. */
INLINE Ints blocksOf(global const short* at)
{
  return TO_INTS(LOAD(at));
}

/**
 * Which windows of a level may show a marker at the first look: every second one of every second row, one group such a
 * row, WINDOWS of them at a time.
 *
 * @param blocks  as cells.cl gives them; WINDOWS more may be read behind the last one.
 * @param weights bias of the GATE_UNITS units, a row of them for each input, then bias and weights of either output.
 * @param units   0: every window passes.
 * @param likely  receives the windows that pass and have contrast, in any order.
 * @param scores  of all windows: -1.
 */
kernel GROUP void gateWindows(global const short* restrict cells, global const short* restrict blocks,
                              global const Level* restrict levels, int level,
                              global const float* restrict weights, int units, float least_checkerboard,
                              float least_target, global Lists* lists, global uint* restrict likely,
                              global float2* restrict scores)
{
  const int even = evenBlocks(levels[level].cells_across);
  const size_t plane = (size_t)(levels[level].cells_down / 2) * 2 * even;
  const int windows_across = levels[level].windows_across;
  const int looked_across = (windows_across + 1) / 2;
  const int row = get_group_id(0);
  const uint first = levels[level].first_window + 2 * row * windows_across;
  global const short* of_row =
      cells + levels[level].first_cell + (size_t)row * 2 * WINDOW_STRIDE * levels[level].cells_across;
  const int rows = min(2, levels[level].windows_down - 2 * row);
  for (int i = get_local_id(0); i < rows * windows_across; i += LANES)
  {
    scores[first + i] = (float2)(-1, -1);
  }
  for (int i = WINDOWS * get_local_id(0); i < looked_across; i += WINDOWS * LANES)
  {
    global const short* start = blocks + (size_t)2 * row * 2 * even + i;
    Ints sum = 0;
    Ints contrast = 0;
    for (int block = 0; block < 16; ++block)
    {
      global const short* at = start + offsetOf(block, even);
      sum += blocksOf(at);
      contrast += blocksOf(at + 3 * plane) + blocksOf(at + 4 * plane) + blocksOf(at + 5 * plane);
    }
    const Ints mean = sum / 16;
    Ints between = 0;
    for (int block = 0; block < 16; ++block)
    {
      const Ints from_mean = blocksOf(start + offsetOf(block, even)) - mean;
      between += max(from_mean, -from_mean);
    }
    contrast += between / 2;
    Ints pass = contrast >= LEAST_BLOCK_CONTRAST;
    if (units > 0 && ANY(pass))
    {
      const Floats scale = 16 / TO_FLOATS(max(contrast, 1));
      Floats unit[GATE_UNITS];
      for (int u = 0; u < GATE_UNITS; ++u)
      {
        unit[u] = weights[u];
      }
      global const float* weight = weights;
      for (int block = 0; block < 16; ++block)
      {
        global const short* at = start + offsetOf(block, even);
        for (int k = 0; k < BLOCK_PLANES; ++k)
        {
          const Ints value = blocksOf(at + k * plane) - (k == 0 ? mean : 0);
          const Floats input = clamp(TO_FLOATS(value) * scale, -LARGEST_INPUT, LARGEST_INPUT);
          weight += GATE_UNITS;
#pragma unroll
          for (int u = 0; u < GATE_UNITS; ++u)
          {
            unit[u] += input * weight[u];
          }
        }
      }
      weight += GATE_UNITS;
      Floats checkerboard = weight[0];
      Floats target = weight[GATE_UNITS + 1];
      for (int u = 0; u < GATE_UNITS; ++u)
      {
        const Floats active = activation(unit[u]);
        checkerboard += active * weight[u + 1];
        target += active * weight[GATE_UNITS + u + 2];
      }
      // The outputs are compared before their activation, which rises.
      pass &= checkerboard > least_checkerboard || target > least_target;
    }
    IntsOf passes = {units > 0 ? pass : 1};
    if (ANY(passes.all != 0))
    {
      for (int lane = 0; lane < min(WINDOWS, looked_across - i); ++lane)
      {
        if (passes.of[lane] != 0 &&
            hasContrast(of_row + (i + lane) * 2 * WINDOW_STRIDE, levels[level].cells_across,
                        start + lane + 5 * plane, even))
        {
          likely[atomic_inc(&lists->likely)] = first + 2 * (i + lane);
        }
      }
    }
  }
}
