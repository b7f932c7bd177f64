// The first look at windows: a small network on blocks of cells (paper, section 4.5). A plain version:
// gateInputs() in include/outdoor_omr/haar_features.h, window_scores.h.

#include "cells.cl"
#include "network.cl"

/** Units of the gate, and windows that are looked at together. */
#define GATE_UNITS 16
#define LEAST_BLOCK_CONTRAST 640
#define LARGEST_INPUT 6.0f

/** 16 blocks side by side in a plane. */
INLINE int16 sixteen(global const short* at)
{
  return convert_int16(vload16(0, at));
}

INLINE int16 magnitude16(int16 value)
{
  return value > -value ? value : -value;
}

/**
 * Which windows of a level may show a marker at the first look: every second one of every second row, one group such a
 * row, 16 of them at a time: their blocks lie side by side.
 *
 * @param blocks  as cells.cl gives them; 16 more may be read behind the last one.
 * @param weights bias of the GATE_UNITS units, a row of them for each input, then bias and weights of either output.
 * @param units   0: every window passes.
 */
kernel GROUP void gateWindows(global const short* restrict blocks, int cells_across, int blocks_down,
                              global const float* restrict weights, int units, float least_checkerboard,
                              float least_target, int looked_across, global uchar* restrict passes)
{
  const int even = evenBlocks(cells_across);
  const size_t plane = (size_t)blocks_down * 2 * even;
  const int row = get_group_id(0);
  global uchar* restrict out = passes + (size_t)row * looked_across;
  for (int i = 16 * get_local_id(0); i < looked_across; i += 16 * LANES)
  {
    global const short* start = blocks + (size_t)2 * row * 2 * even + i;
    int16 sum = 0;
    int16 contrast = 0;
    for (int y = 0; y < 4; ++y)
    {
      for (int x = 0; x < 4; ++x)
      {
        global const short* at = start + (2 * y + x % 2) * even + x / 2;
        sum += sixteen(at);
        contrast += sixteen(at + 3 * plane) + sixteen(at + 4 * plane);
      }
    }
    const int16 mean = sum / 16;
    int16 between = 0;
    for (int y = 0; y < 4; ++y)
    {
      for (int x = 0; x < 4; ++x)
      {
        between += magnitude16(sixteen(start + (2 * y + x % 2) * even + x / 2) - mean);
      }
    }
    contrast += between / 2;
    int16 pass = contrast >= LEAST_BLOCK_CONTRAST;
    if (units > 0 && any(pass))
    {
      const float16 scale = 16 / convert_float16(max(contrast, 1));
      float16 unit[GATE_UNITS];
      for (int u = 0; u < GATE_UNITS; ++u)
      {
        unit[u] = weights[u];
      }
      global const float* weight = weights;
      for (int y = 0; y < 4; ++y)
      {
        for (int x = 0; x < 4; ++x)
        {
          global const short* at = start + (2 * y + x % 2) * even + x / 2;
          for (int k = 0; k < BLOCK_PLANES; ++k)
          {
            const int16 value = sixteen(at + k * plane) - (k == 0 ? mean : 0);
            const float16 input = clamp(convert_float16(value) * scale, -LARGEST_INPUT, LARGEST_INPUT);
            weight += GATE_UNITS;
#pragma unroll
            for (int u = 0; u < GATE_UNITS; ++u)
            {
              unit[u] += input * weight[u];
            }
          }
        }
      }
      weight += GATE_UNITS;
      float16 checkerboard = weight[0];
      float16 target = weight[GATE_UNITS + 1];
      for (int u = 0; u < GATE_UNITS; ++u)
      {
        const float16 active = activation(unit[u]);
        checkerboard += active * weight[u + 1];
        target += active * weight[GATE_UNITS + u + 2];
      }
      // The outputs are compared before their activation, which rises.
      pass &= checkerboard > least_checkerboard || target > least_target;
    }
    pass = units > 0 ? pass : 1;
    int kept[16];
    vstore16(pass, 0, kept);
    for (int lane = 0; lane < min(16, looked_across - i); ++lane)
    {
      out[i + lane] = kept[lane] != 0;
    }
  }
}
