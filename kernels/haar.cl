// Colour Haar features of sliding windows (paper, section 4.5). What the features are, and a plain version of them:
// include/outdoor_omr/haar_features.h.

#include "window.cl"

/** The sizes of haar_features.h. */
#define SHIFTS 40
#define LEAST_CONTRAST 20
#define OCTAVE 256.0f

/** Features, and a one for the bias. */
#define FEATURES 212
#define INPUTS (FEATURES + 1)

/** By exchanges without branches: a branch on the values costs more than it saves. */
INLINE void sortAscending(Floats* values, int count)
{
  for (int pass = 0; pass < count; ++pass)
  {
    for (int i = pass & 1; i + 1 < count; i += 2)
    {
      const Floats lower = min(values[i], values[i + 1]);
      values[i + 1] = max(values[i], values[i + 1]);
      values[i] = lower;
    }
  }
}

/** Mean deviation of one colour difference from its mean. */
INLINE Floats meanDeviation(const Shorts* color)
{
  const Ints mean = total(color) / CELLS;
  Ints sum = 0;
  for (int i = 0; i < CELLS; ++i)
  {
    const Ints deviation = TO_INTS(color[i]) - mean;
    sum += max(deviation, -deviation);
  }
  return TO_FLOATS(sum) / CELLS;
}

/** Of a block the sum, and Haar responses across and down. */
typedef struct
{
  Ints sum, across, down;
} Block;

INLINE Block blockOf(const Shorts* cells, int row, int col)
{
  const Shorts* upper = cells + 2 * row * WINDOW_CELLS + 2 * col;
  const Shorts* lower = upper + WINDOW_CELLS;
  const Block block = {TO_INTS(upper[0] + upper[1] + lower[0] + lower[1]),
                       TO_INTS(magnitude(upper[0] - upper[1]) + magnitude(lower[0] - lower[1])),
                       TO_INTS(magnitude(upper[0] - lower[0]) + magnitude(upper[1] - lower[1]))};
  return block;
}

/** Haar responses of the blocks in colour. */
INLINE void colorsOf(const Shorts* red, const Shorts* blue, Ints* colors)
{
  for (int i = 0; i < 16; ++i)
  {
    const Block of_red = blockOf(red, i / 4, i % 4);
    const Block of_blue = blockOf(blue, i / 4, i % 4);
    colors[i] = of_red.across + of_red.down + of_blue.across + of_blue.down;
  }
}

/** The sums of the 24 differences of neighbours in the quarters of the window; each stays below 2^16. */
INLINE void contrastOfQuarters(const Shorts* plane, Ints* quarters)
{
  for (int quarter = 0; quarter < 4; ++quarter)
  {
    const Shorts* first = plane + quarter / 2 * 4 * WINDOW_CELLS + quarter % 2 * 4;
    UShorts contrast = 0;
    for (int i = 0; i < 4; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Shorts* row = first + i * WINDOW_CELLS + k;
        const Shorts* column = first + k * WINDOW_CELLS + i;
        contrast += magnitude(row[1] - row[0]) + magnitude(column[WINDOW_CELLS] - column[0]);
      }
    }
    quarters[quarter] = TO_INTS(contrast);
  }
}

/** The contrast of the quarter that has least, in brightness and in the colours of its blocks. */
INLINE Ints leastContrast(const Ints* quarters, const Ints* colors)
{
  Ints least = INT_MAX;
  for (int quarter = 0; quarter < 4; ++quarter)
  {
    const Ints* upper = colors + quarter / 2 * 8 + quarter % 2 * 2;
    least = min(least, quarters[quarter] + upper[0] + upper[1] + upper[4] + upper[5]);
  }
  return least;
}

INLINE Ints contrastOf(const Shorts* plane)
{
  Ints quarters[4];
  contrastOfQuarters(plane, quarters);
  return quarters[0] + quarters[1] + quarters[2] + quarters[3];
}

/** Puts the colour with the most contrast in the place of brightness where that has less. */
INLINE void chooseMainPlane(const Ints* quarters, const Shorts* red, const Shorts* blue, Shorts* light)
{
  const Ints of_light = quarters[0] + quarters[1] + quarters[2] + quarters[3];
  const Ints of_red = contrastOf(red);
  const Ints of_blue = contrastOf(blue);
  const Ints colored = max(of_red, of_blue) > of_light;
  if (!ANY(colored))
  {
    return;
  }
  for (int i = 0; i < CELLS; ++i)
  {
    const Ints color = of_red >= of_blue ? TO_INTS(red[i]) : TO_INTS(blue[i]);
    light[i] = TO_SHORTS(colored ? color : TO_INTS(light[i]));
  }
}

/** What is looked up, in one buffer: shifts by length, then crossings of four shifts. */
#define BY_LENGTH 0
#define CROSSINGS 40

/** A black square's neighbours along u and v are white, those along u + v and u - v are black. */
INLINE Floats largestCrossing(const Floats* differences, global const uchar* tables, int crossings)
{
  Floats largest = -1;
  for (int i = 0; i < crossings; ++i)
  {
    global const uchar* shifts = tables + CROSSINGS + 4 * i;
    const Floats along = differences[shifts[0]] + differences[shifts[1]];
    const Floats diagonal = differences[shifts[2]] + differences[shifts[3]];
    const Floats crossing = (along - diagonal) / (along + diagonal);
    largest = crossing > largest ? crossing : largest;  // not where both sums are 0
  }
  return largest;
}

/**
 * The features of windows. @return which of them have contrast; of the others they mean nothing.
 */
INLINE Ints haarFeatures(const Places* places, global const uchar* tables, int crossings, Floats* features)
{
  Shorts light[CELLS];
  Shorts red[CELLS];
  Shorts blue[CELLS];
  Ints colors[16];
  Ints quarters[4];
  loadCells(places, 0, light);
  loadCells(places, 1, red);
  loadCells(places, 2, blue);
  colorsOf(red, blue, colors);
  contrastOfQuarters(light, quarters);
  const Ints has_contrast = leastContrast(quarters, colors) >= LEAST_CONTRAST * 24;
  if (!ANY(has_contrast))
  {
    return has_contrast;
  }
  chooseMainPlane(quarters, red, blue, light);
  const Ints mean = total(light) / CELLS;
  Floats differences[SHIFTS];
  Floats contrast = 0;
  int shift = 0;
  for (int dx = 0; dx <= 4; ++dx)
  {
    for (int dy = dx == 0 ? 1 : -4; dy <= 4; ++dy)
    {
      differences[shift] = meanDifference(light, dx, dy);
      contrast += differences[shift++];
    }
  }
  contrast /= SHIFTS;
  const Floats relative = 1 / contrast;
  for (int i = 0; i < SHIFTS; ++i)
  {
    features[i] = differences[tables[BY_LENGTH + i]] * relative - 1;
  }
  // The bands of haarTables().
  sortAscending(features, 4);
  sortAscending(features + 4, 8);
  sortAscending(features + 12, 10);
  sortAscending(features + 22, 12);
  sortAscending(features + 34, 6);
  Floats* next = features + SHIFTS;
  *next++ = largestCrossing(differences, tables, crossings);
  *next++ = contrast / OCTAVE;

  Floats deviation = 0;
  Floats variance = 0;
  for (int i = 0; i < CELLS; ++i)
  {
    const Floats from_mean = TO_FLOATS(TO_INTS(light[i]) - mean) * relative;
    deviation += fabs(from_mean);
    variance += from_mean * from_mean;
  }
  *next++ = deviation / CELLS;
  *next++ = variance / CELLS;
  Floats same[BEST];
  Floats negative[BEST];
  symmetries(light, mean, same, negative);
  for (int i = 0; i < BEST; ++i)
  {
    *next++ = same[i] * relative;
    *next++ = negative[i] * relative;
  }
  *next++ = meanDeviation(red) * relative;
  *next++ = meanDeviation(blue) * relative;

  for (int i = 0; i < 16; ++i)
  {
    const Block of_light = blockOf(light, i / 4, i % 4);
    *next++ = TO_FLOATS(of_light.sum - 4 * mean) * (relative / 4);
    *next++ = TO_FLOATS(blockOf(red, i / 4, i % 4).sum) / (4 * OCTAVE);
    *next++ = TO_FLOATS(blockOf(blue, i / 4, i % 4).sum) / (4 * OCTAVE);
    *next++ = TO_FLOATS(of_light.across) * (relative / 2) - 1;
    *next++ = TO_FLOATS(of_light.down) * (relative / 2) - 1;
    *next++ = TO_FLOATS(colors[i]) * (relative / 2);
  }
  for (int i = 0; i < CELLS; ++i)
  {
    *next++ = TO_FLOATS(TO_INTS(light[i]) - mean) * relative;
  }
  *next = 1;
  return has_contrast;
}
