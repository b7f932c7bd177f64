// Cells of a level and blocks of 2 x 2 of them, from the integral image (paper, section 4.5). A plain version:
// include/outdoor_omr/haar_features.h.

#include "geometry.cl"

/** Four times the mean of a cell's pixels in a channel. */
INLINE uint cellMean(global const uint* top, global const uint* bottom, int left, int right, int shift)
{
  return (bottom[right] - bottom[left] - top[right] + top[left]) >> shift;
}

/** The planes of blocks of 2 x 2 cells that haarCells writes, in the order of gateInputs() in haar_features.h. */
#define BLOCK_PLANES 6

/** Sum of a block of 2 x 2 cells, and Haar responses across and down. */
typedef struct
{
  int sum, across, down;
} Block;

INLINE int difference(int a, int b)
{
  return max(a, b) - min(a, b);
}

INLINE Block blockAt(global const short* upper, global const short* lower)
{
  const int a = upper[0];
  const int b = upper[1];
  const int c = lower[0];
  const int d = lower[1];
  const Block block = {a + b + c + d, difference(a, b) + difference(c, d), difference(a, c) + difference(b, d)};
  return block;
}

/**
 * The brightness of the cells of a level, and what blocks of them have in common for all windows; one group two rows of
 * cells, which are a row of blocks.
 *
 * @param integral  as integral.cl gives it, of an image of the width.
 * @param logarithm of a cell's mean.
 * @param cells     three planes of cells_down rows of cells_across: b + g + r, r - g, b - g.
 * @param blocks    BLOCK_PLANES planes of cells_down / 2 rows of cells_across / 2.
 */
kernel GROUP void haarCells(global const uint* restrict integral, int width, int level,
                            global const short* restrict logarithm, int cells_across, int cells_down,
                            global short* restrict cells, global short* restrict blocks)
{
  const int block_row = get_group_id(0);
  const int side = 1 << level;  // of a cell in the integral image, which has every second pixel
  const int columns = 3 * (width / 2) + 3;
  const size_t plane = (size_t)cells_down * cells_across;
  for (int y = 2 * block_row; y < min(cells_down, 2 * block_row + 2); ++y)
  {
    global const uint* restrict top = integral + (size_t)y * side * columns;
    global const uint* restrict bottom = top + (size_t)side * columns;
    global short* restrict row = cells + (size_t)y * cells_across;
    for (int x = get_local_id(0); x < cells_across; x += LANES)
    {
      const int left = 3 * side * x;
      const int right = left + 3 * side;
      const short blue = logarithm[cellMean(top, bottom, left, right, 2 * level)];
      const short green = logarithm[cellMean(top, bottom, left + 1, right + 1, 2 * level)];
      const short red = logarithm[cellMean(top, bottom, left + 2, right + 2, 2 * level)];
      row[x] = blue + green + red;
      row[plane + x] = red - green;
      row[2 * plane + x] = blue - green;
    }
  }
  barrier(CLK_GLOBAL_MEM_FENCE);
  const int across = cells_across / 2;
  const size_t block_plane = (size_t)(cells_down / 2) * across;
  if (block_row >= cells_down / 2)
  {
    return;
  }
  global const short* restrict upper = cells + (size_t)2 * block_row * cells_across;
  global const short* restrict lower = upper + cells_across;
  global short* restrict out = blocks + (size_t)block_row * across;
  for (int x = get_local_id(0); x < across; x += LANES)
  {
    const Block light = blockAt(upper + 2 * x, lower + 2 * x);
    const Block red = blockAt(upper + plane + 2 * x, lower + plane + 2 * x);
    const Block blue = blockAt(upper + 2 * plane + 2 * x, lower + 2 * plane + 2 * x);
    out[x] = light.sum;
    out[block_plane + x] = red.sum;
    out[2 * block_plane + x] = blue.sum;
    out[3 * block_plane + x] = light.across;
    out[4 * block_plane + x] = light.down;
    out[5 * block_plane + x] = red.across + red.down + blue.across + blue.down;
  }
}
