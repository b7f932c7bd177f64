// Cells of a level and blocks of 2 x 2 of them (paper, section 4.5). A cell's sum is that of four cells of the level
// before, so no integral image is needed: the sums are those that one gives, in a quarter of the time. A plain version,
// from an integral image: include/outdoor_omr/haar_features.h.

#ifndef OUTDOOR_OMR_CELLS_CL
#define OUTDOOR_OMR_CELLS_CL

#include "levels.cl"

/** The planes of blocks of 2 x 2 cells, in the order of gateInputs() in haar_features.h. */
#define BLOCK_PLANES 6

/** Cells that a lane computes at a time, a multiple of 32: on a CPU 16 KiB with their pixels; on a GPU few, so that a
 * row of 1920 px has work for half of the lanes and not for an eighth. */
#define CHUNK (LANES == 1 ? 128 : 32)

/** Blocks in a row of a plane: first those in even columns, then those in odd ones, which the gate reads apart; so many
 * of either, a multiple of 8 since they are computed 16 at a time. */
INLINE int evenBlocks(int cells_across)
{
  return (cells_across / 2 + 15) / 16 * 8;
}

/** The channels of cells from their logarithms. */
INLINE void setCell(short blue, short green, short red, size_t plane, global short* cell)
{
  cell[0] = blue + green + red;
  cell[plane] = red - green;
  cell[2 * plane] = blue - green;
}

INLINE short16 difference(short16 a, short16 b)
{
  return max(a, b) - min(a, b);
}

/** Of 16 blocks in one plane: the sum, and Haar responses across and down. */
typedef struct
{
  short16 sum, across, down;
} Blocks16;

INLINE Blocks16 blocksAt(global const short* upper, global const short* lower)
{
  const short16 a = (short16)(vload16(0, upper).even, vload16(1, upper).even);
  const short16 b = (short16)(vload16(0, upper).odd, vload16(1, upper).odd);
  const short16 c = (short16)(vload16(0, lower).even, vload16(1, lower).even);
  const short16 d = (short16)(vload16(0, lower).odd, vload16(1, lower).odd);
  const Blocks16 blocks = {a + b + c + d, difference(a, b) + difference(c, d), difference(a, c) + difference(b, d)};
  return blocks;
}

INLINE void store(short16 blocks, int even, global short* out)
{
  vstore8(blocks.even, 0, out);
  vstore8(blocks.odd, 0, out + even);
}

/** The blocks of some cells of two rows. @param cells with 32 more behind the last one. @param first a multiple of 32. */
INLINE void setBlocks(global const short* cells, size_t plane, int cells_across, int block_row, int blocks_down,
                      int first, int count, global short* blocks)
{
  const int even = evenBlocks(cells_across);
  const size_t block_plane = (size_t)blocks_down * 2 * even;
  global short* out = blocks + (size_t)block_row * 2 * even + first / 4;
  for (int i = 0; i + 1 < count; i += 32)
  {
    global const short* upper = cells + (size_t)2 * block_row * cells_across + first + i;
    global const short* lower = upper + cells_across;
    const Blocks16 light = blocksAt(upper, lower);
    const Blocks16 red = blocksAt(upper + plane, lower + plane);
    const Blocks16 blue = blocksAt(upper + 2 * plane, lower + 2 * plane);
    store(light.sum, even, out + i / 4);
    store(red.sum, even, out + block_plane + i / 4);
    store(blue.sum, even, out + 2 * block_plane + i / 4);
    store(light.across, even, out + 3 * block_plane + i / 4);
    store(light.down, even, out + 4 * block_plane + i / 4);
    store(red.across + red.down + blue.across + blue.down, even, out + 5 * block_plane + i / 4);
  }
}

/**
 * The cells of the first level, 2 x 2 px each; their blocks; and the sums of the cells of the next level. One group two
 * rows of cells, which are a row of blocks and of the next level's cells.
 *
 * @param logarithm of a cell's mean.
 * @param cells     of a level after the other: three planes of its rows, b + g + r, r - g, b - g. Up to 32 behind the last
 *                  one of a row may be read before they are set; the blocks that depend on them are padding.
 * @param blocks    BLOCK_PLANES planes of cells_down / 2 rows of 2 * evenBlocks().
 * @param sums      of the next level: three planes of cells_down / 2 rows of cells_across / 2.
 */
kernel GROUP void cellsOfImage(global const uchar* restrict image, long step, global const short* restrict logarithm,
                               global const Level* restrict levels, global short* restrict cells,
                               global short* restrict blocks, global uint* restrict sums)
{
  const int block_row = get_group_id(0);
  const int cells_across = levels->cells_across;
  const int cells_down = levels->cells_down;
  const int blocks_down = cells_down / 2;
  const size_t plane = (size_t)cells_down * cells_across;
  const size_t sum_plane = (size_t)blocks_down * (cells_across / 2);
  const int rows = min(2, cells_down - 2 * block_row);
  for (int first = CHUNK * get_local_id(0); first < cells_across; first += CHUNK * LANES)
  {
    const int count = min(CHUNK, cells_across - first);
    ushort four[2][6 * CHUNK];  // every sixth one is a cell's blue
    for (int row = 0; row < rows; ++row)
    {
      global const uchar* restrict upper = image + (4 * block_row + 2 * row) * step + 6 * first;
      global const uchar* restrict lower = upper + step;
      for (int i = 0; i < 6 * count - 3; ++i)
      {
        four[row][i] = upper[i] + upper[i + 3] + lower[i] + lower[i + 3];
      }
      global short* restrict out = cells + (size_t)(2 * block_row + row) * cells_across + first;
#pragma clang loop vectorize(disable)  // a vector of lookups is slower
      for (int x = 0; x < count; ++x)
      {
        const ushort* cell = four[row] + 6 * x;
        setCell(logarithm[cell[0]], logarithm[cell[1]], logarithm[cell[2]], plane, out + x);
      }
    }
    if (rows < 2)
    {
      continue;
    }
    setBlocks(cells, plane, cells_across, block_row, blocks_down, first, count, blocks);
    for (int i = 0; i < 6 * count - 9; ++i)
    {
      four[0][i] += four[0][i + 6] + four[1][i] + four[1][i + 6];
    }
    global uint* restrict out = sums + (size_t)block_row * (cells_across / 2) + first / 2;
#pragma clang loop vectorize(disable)
    for (int x = 0; x < count / 2; ++x)
    {
      out[x] = four[0][12 * x];
      out[sum_plane + x] = four[0][12 * x + 1];
      out[2 * sum_plane + x] = four[0][12 * x + 2];
    }
  }
}

/** The same for a further level. @param own the sums of its cells, as the level before gives them. */
kernel GROUP void cellsOfSums(global const uint* restrict own, int level, global const short* restrict logarithm,
                              global const Level* restrict levels, global short* restrict all_cells,
                              global short* restrict blocks, global uint* restrict sums)
{
  const int block_row = get_group_id(0);
  const int cells_across = levels[level].cells_across;
  const int cells_down = levels[level].cells_down;
  global short* restrict cells = all_cells + levels[level].first_cell;
  const int blocks_down = cells_down / 2;
  const size_t plane = (size_t)cells_down * cells_across;
  const size_t sum_plane = (size_t)blocks_down * (cells_across / 2);
  const int rows = min(2, cells_down - 2 * block_row);
  for (int first = CHUNK * get_local_id(0); first < cells_across; first += CHUNK * LANES)
  {
    const int count = min(CHUNK, cells_across - first);
    const size_t start = (size_t)2 * block_row * cells_across + first;
    for (int row = 0; row < rows; ++row)
    {
      global const uint* restrict sum = own + start + row * cells_across;
      global short* restrict out = cells + start + row * cells_across;
#pragma clang loop vectorize(disable)
      for (int x = 0; x < count; ++x)
      {
        setCell(logarithm[sum[x] >> 2 * level], logarithm[sum[plane + x] >> 2 * level],
                logarithm[sum[2 * plane + x] >> 2 * level], plane, out + x);
      }
    }
    if (rows < 2)
    {
      continue;
    }
    setBlocks(cells, plane, cells_across, block_row, blocks_down, first, count, blocks);
    for (int k = 0; k < 3; ++k)
    {
      global const uint* restrict upper = own + k * plane + start;
      global const uint* restrict lower = upper + cells_across;
      global uint* restrict out = sums + k * sum_plane + (size_t)block_row * (cells_across / 2) + first / 2;
      for (int x = 0; x < count / 2; ++x)
      {
        out[x] = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
      }
    }
  }
}

#endif
