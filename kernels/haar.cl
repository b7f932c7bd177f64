// Colour Haar features of sliding windows (paper, section 4.5). What the features are, and a plain version of them:
// include/outdoor_omr/haar_features.h.

#include "window.cl"

/** The sizes of haar_features.h. */
#define SHIFTS 40
#define LEAST_CONTRAST 20
#define OCTAVE 256.0f

/** Features, a one for the bias, and zeros up to a multiple of 8. */
#define INPUTS 152
#define FEATURES 148

/** 8 cells at any address in one load. */
typedef struct __attribute__((packed))
{
  short8 cells;
} Shorts8;

INLINE int4 magnitude4(int4 value)
{
  return value > -value ? value : -value;
}

/** Haar responses of a row of four blocks. */
typedef struct
{
  int4 sum, across, down;
} Blocks;

INLINE Blocks blocksOf(int8 upper, int8 lower)
{
  const int8 both = upper + lower;
  const int8 down = magnitude(upper - lower);
  const Blocks blocks = {both.even + both.odd, magnitude4(upper.even - upper.odd) + magnitude4(lower.even - lower.odd),
                         down.even + down.odd};
  return blocks;
}

INLINE int8 rowOf(global const short* cells, int cells_across, int y)
{
  return convert_int8(((global const Shorts8*)(cells + (size_t)y * cells_across))->cells);
}

/** By exchanges without branches: a branch on the values costs more than it saves. */
INLINE void sortAscending(float* values, int count)
{
#pragma unroll
  for (int pass = 0; pass < count; ++pass)
  {
#pragma unroll
    for (int i = pass & 1; i + 1 < count; i += 2)
    {
      const float lower = min(values[i], values[i + 1]);
      values[i + 1] = max(values[i], values[i + 1]);
      values[i] = lower;
    }
  }
}

/** Mean deviation of one colour difference from its mean. */
INLINE float meanDeviation(const int8* rows)
{
  int8 sum = 0;
  for (int y = 0; y < WINDOW_CELLS; ++y)
  {
    sum += rows[y];
  }
  const int mean = total(sum) / (WINDOW_CELLS * WINDOW_CELLS);
  sum = 0;
  for (int y = 0; y < WINDOW_CELLS; ++y)
  {
    sum += magnitude(rows[y] - mean);
  }
  return (float)total(sum) / (WINDOW_CELLS * WINDOW_CELLS);
}

/** The sum of the 24 differences of neighbours in the left or the right half of four rows, the smaller one. */
INLINE int contrastOfHalf(const int8* rows)
{
  int8 across = 0;
  for (int y = 0; y < 4; ++y)
  {
    across += magnitude(rows[y].s12345677 - rows[y]);
  }
  const int8 down =
      magnitude(rows[1] - rows[0]) + magnitude(rows[2] - rows[1]) + magnitude(rows[3] - rows[2]);
  const int left = across.s0 + across.s1 + across.s2 + down.s0 + down.s1 + down.s2 + down.s3;
  const int right = across.s4 + across.s5 + across.s6 + down.s4 + down.s5 + down.s6 + down.s7;
  return min(left, right);
}

/** What is looked up, in one buffer: shifts by length, then crossings of four shifts. */
#define BY_LENGTH 0
#define CROSSINGS 40

/** Of all crossings the largest one, searched in four rows, which need not wait for each other. */
INLINE float largestCrossing(const float* differences, global const uchar* tables, int crossings)
{
  float along[4] = {0, 0, 0, 0};
  float diagonal[4] = {1, 1, 1, 1};
  for (int i = 0; i < crossings; i += 4)
  {
#pragma unroll
    for (int k = 0; k < 4; ++k)
    {
      global const uchar* shifts = tables + CROSSINGS + 4 * min(i + k, crossings - 1);
      const float a = differences[shifts[0]] + differences[shifts[1]];
      const float d = differences[shifts[2]] + differences[shifts[3]];
      const bool larger = a * diagonal[k] > along[k] * d;
      along[k] = larger ? a : along[k];
      diagonal[k] = larger ? d : diagonal[k];
    }
  }
  float largest = -1;
  for (int k = 0; k < 4; ++k)
  {
    largest = max(largest, (along[k] - diagonal[k]) / (along[k] + diagonal[k]));
  }
  return largest;
}

/**
 * The features of a window. @return whether it has contrast; if not, features is not written.
 *
 * @param window its first cell. @param plane cells of a plane.
 */
INLINE bool haarFeatures(global const short* window, int cells_across, size_t plane, global const uchar* tables,
                         int crossings, float* features)
{
  int8 light[WINDOW_CELLS];
  for (int y = 0; y < WINDOW_CELLS; ++y)
  {
    light[y] = rowOf(window, cells_across, y);
  }
  if (min(contrastOfHalf(light), contrastOfHalf(light + 4)) < LEAST_CONTRAST * 24)
  {
    return false;
  }
  short padded[PADDED];
  short* cells = padded + PADDING;
  for (int i = 0; i < PADDED; ++i)
  {
    padded[i] = 0;
  }
  int8 sum = 0;
  for (int y = 0; y < WINDOW_CELLS; ++y)
  {
    vstore8(convert_short8(light[y]), y, cells);
    sum += light[y];
  }
  const int mean = total(sum) / (WINDOW_CELLS * WINDOW_CELLS);

  float differences[SHIFTS];
  float contrast = 0;
  int shift = 0;
  for (int dx = 0; dx <= 4; ++dx)
  {
    for (int dy = dx == 0 ? 1 : -4; dy <= 4; ++dy)
    {
      differences[shift] = meanDifference(cells, dx, dy);
      contrast += differences[shift++];
    }
  }
  contrast /= SHIFTS;
  for (int i = 0; i < SHIFTS; ++i)
  {
    features[i] = differences[tables[BY_LENGTH + i]] / contrast - 1;
  }
  // Numbers that the compiler knows, so that it sorts in registers; the bands of haarTables().
  sortAscending(features, 4);
  sortAscending(features + 4, 8);
  sortAscending(features + 12, 10);
  sortAscending(features + 22, 12);
  sortAscending(features + 34, 6);
  float* next = features + SHIFTS;
  *next++ = largestCrossing(differences, tables, crossings);
  *next++ = contrast / OCTAVE;

  float8 deviation = 0;
  float8 variance = 0;
  for (int y = 0; y < WINDOW_CELLS; ++y)
  {
    const float8 relative = convert_float8(light[y] - mean) / contrast;
    deviation += fabs(relative);
    variance += relative * relative;
  }
  const float8 one = 1;
  *next++ = (dot(deviation.lo, one.lo) + dot(deviation.hi, one.hi)) / (WINDOW_CELLS * WINDOW_CELLS);
  *next++ = (dot(variance.lo, one.lo) + dot(variance.hi, one.hi)) / (WINDOW_CELLS * WINDOW_CELLS);
  float same[BEST];
  float negative[BEST];
  symmetries(cells, mean, same, negative);
  for (int i = 0; i < BEST; ++i)
  {
    *next++ = same[i] / contrast;
    *next++ = negative[i] / contrast;
  }
  int8 red[WINDOW_CELLS];
  int8 blue[WINDOW_CELLS];
  for (int y = 0; y < WINDOW_CELLS; ++y)
  {
    red[y] = rowOf(window + plane, cells_across, y);
    blue[y] = rowOf(window + 2 * plane, cells_across, y);
  }
  *next++ = meanDeviation(red) / contrast;
  *next++ = meanDeviation(blue) / contrast;

  for (int i = 0; i < 4; ++i)
  {
    const Blocks light_blocks = blocksOf(light[2 * i], light[2 * i + 1]);
    const Blocks red_blocks = blocksOf(red[2 * i], red[2 * i + 1]);
    const Blocks blue_blocks = blocksOf(blue[2 * i], blue[2 * i + 1]);
    float values[6][4];
    vstore4(convert_float4(light_blocks.sum - 4 * mean) / (4 * contrast), 0, values[0]);
    vstore4(convert_float4(red_blocks.sum) / (4 * OCTAVE), 0, values[1]);
    vstore4(convert_float4(blue_blocks.sum) / (4 * OCTAVE), 0, values[2]);
    vstore4(convert_float4(light_blocks.across) / (2 * contrast) - 1, 0, values[3]);
    vstore4(convert_float4(light_blocks.down) / (2 * contrast) - 1, 0, values[4]);
    vstore4(convert_float4(red_blocks.across + red_blocks.down + blue_blocks.across + blue_blocks.down) /
                (2 * contrast),
            0, values[5]);
    for (int k = 0; k < 24; ++k)
    {
      *next++ = values[k % 6][k / 6];
    }
  }
  for (int i = FEATURES; i < INPUTS; ++i)
  {
    features[i] = i == FEATURES;
  }
  return true;
}
