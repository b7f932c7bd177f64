// The region mask: one bit a pixel, 1 = region, 0 = edge. Pixel x is bit x % 64 of word x / 64 of its row; bits beyond
// the width are 0. 1080p takes 259 kB, which stays in the cache where a byte mask would not.

#ifndef OUTDOOR_OMR_MASK_CL
#define OUTDOOR_OMR_MASK_CL

#include "geometry.cl"

INLINE int lowestBit(ulong bits)
{
  return (int)popcount((bits & -bits) - 1);
}

/** The bits of a word shifted so that each one meets its left neighbour. */
INLINE ulong leftOf(ulong word, ulong word_before)
{
  return (word << 1) | (word_before >> 63);
}

/** Pixels of word w where a run of the row starts. */
INLINE ulong runStarts(global const ulong* row, int w)
{
  return row[w] & ~leftOf(row[w], w > 0 ? row[w - 1] : 0);
}

/**
 * First pixels of word w where a run of the row touches a run of the row above: one bit for each pair of runs that
 * overlap, which makes the union of two rows a walk over these bits.
 */
INLINE ulong contacts(global const ulong* row, global const ulong* above, int w)
{
  const ulong both = row[w] & above[w];
  return both & ~leftOf(both, w > 0 ? row[w - 1] & above[w - 1] : 0);
}

/** Region pixels of word w with an edge pixel among their four neighbours; the image border is no edge. */
INLINE ulong besideEdge(global const ulong* mask, int width, int height, int y, int w)
{
  const int words = wordsOf(width);
  global const ulong* row = mask + (size_t)y * words;
  const ulong word = row[w];
  const ulong left = leftOf(word, w > 0 ? row[w - 1] : ~0UL);
  ulong right = (word >> 1) | ((w + 1 < words ? row[w + 1] : ~0UL) << 63);
  if (w + 1 == words)
  {
    right |= 1UL << ((width - 1) & 63);
  }
  const ulong above = y > 0 ? row[w - words] : ~0UL;
  const ulong below = y + 1 < height ? row[w + words] : ~0UL;
  return word & ~(left & right & above & below);
}

/** Expands the mask to the edge image: 255 = edge, 0 = region. One group a row. */
kernel GROUP void edgeImage(global const ulong* restrict mask, int width, global uchar* restrict edges)
{
  const int y = get_group_id(0);
  global const ulong* row = mask + (size_t)y * wordsOf(width);
  for (int x = get_local_id(0); x < width; x += LANES)
  {
    edges[(size_t)y * width + x] = (row[x >> 6] >> (x & 63)) & 1 ? 0 : 255;
  }
}

#endif
