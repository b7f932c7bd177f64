// Colour Sobel edges (paper, section 3.1): the largest |gx| + |gy| of B, G and R above the threshold makes an edge
// pixel; borders replicated. The result is the region mask of mask.cl. The threshold is the paper's fixed one, or, tile
// by tile, a share of the strongest response around.

#include "mask.cl"

/** Rows of a tile, which is 64 pixels wide. A work-item slides down a tile: each row is read once, not three times. */
#define EDGE_ROWS 16

/** The adaptive threshold in percent of the strongest response in 3 x 3 tiles. */
#define ADAPTIVE_PERCENT 45

/** Bytes that edgesStrip takes at a time, and how many of these pieces are 16 and 64 pixels. */
#define EDGE_PIECE 16
#define PIECES_OF_16 3
#define PIECES_OF_WORD 12

// |gx| + |gy| = max(|gx + gy|, |gx - gy|), and both halves are short sums of neighbours:
//   (gx + gy) / 2 = (right - left) + (below + below right) - (above left + above)
//   (gx - gy) / 2 = (right - left) + (above + above right) - (below left + below)
// so a row gives three sums, each of which serves up to three rows: half the operations of gx and gy.

/** Of 16 bytes of a row: right - left, left + centre, centre + right. */
typedef struct
{
  short16 difference, behind, ahead;
} RowSums;

/** 16 bytes at any address in one load: PoCL puts vload16() together from pieces, which doubles the kernel's time. */
typedef struct __attribute__((packed))
{
  uchar16 bytes;
} Bytes16;

INLINE RowSums sumsOf(uchar16 left_bytes, uchar16 centre_bytes, uchar16 right_bytes)
{
  const short16 left = convert_short16(left_bytes);
  const short16 centre = convert_short16(centre_bytes);
  const short16 right = convert_short16(right_bytes);
  const RowSums sums = {right - left, left + centre, centre + right};
  return sums;
}

/** @param inner whether the bytes have neighbours on both sides; a constant, so that no branch is left. */
INLINE RowSums rowSums(global const uchar* row, int first, int bytes, bool inner)
{
  if (inner)
  {
    global const uchar* at = row + first;
    return sumsOf(((global const Bytes16*)(at - 3))->bytes, ((global const Bytes16*)at)->bytes,
                  ((global const Bytes16*)(at + 3))->bytes);
  }
  uchar near[EDGE_PIECE + 6];
  for (int i = 0; i < EDGE_PIECE + 6; ++i)
  {
    const int at = first - 3 + i;
    near[i] = row[at < 0 ? at + 3 : at < bytes ? at : bytes - 3 + at % 3];
  }
  return sumsOf(vload16(0, near), vload16(0, near + 3), vload16(0, near + 6));
}

// PoCL turns abs() and max() on vectors into scalar code, operators into one instruction.
INLINE short16 larger(short16 a, short16 b)
{
  return a > b ? a : b;
}

/** Half of |gx| + |gy| of 16 bytes. */
INLINE short16 halfResponse(RowSums above, RowSums row, RowSums below)
{
  const short16 falling = row.difference + below.ahead - above.behind;
  const short16 rising = row.difference + above.ahead - below.behind;
  return larger(larger(falling, -falling), larger(rising, -rising));
}

/**
 * The threshold of a tile: fixed, or, where a floor below it is given, between the two.
 *
 * @param strength strongest response of every tile.
 */
INLINE int tileThreshold(global const int* strength, int tiles_across, int tiles_down, int i, int j, int floor,
                         int threshold)
{
  if (floor >= threshold)
  {
    return threshold;
  }
  int strongest = 0;
  for (int y = max(i - 1, 0); y <= min(i + 1, tiles_down - 1); ++y)
  {
    for (int x = max(j - 1, 0); x <= min(j + 1, tiles_across - 1); ++x)
    {
      strongest = max(strongest, strength[y * tiles_across + x]);
    }
  }
  return clamp(strongest * ADAPTIVE_PERCENT / 100, floor, threshold);
}

/** Slides down 16 bytes of the rows top .. bottom - 1. @return half the strongest response of each. */
INLINE short16 strongestOf(global const uchar* image, long step, int width, int height, int first, int top, int bottom,
                           bool inner)
{
  const int bytes = 3 * width;
  RowSums above = rowSums(image + max(top - 1, 0) * step, first, bytes, inner);
  RowSums row = rowSums(image + top * step, first, bytes, inner);
  short16 strongest = 0;
  for (int y = top; y < bottom; ++y)
  {
    const RowSums below = rowSums(image + min(y + 1, height - 1) * step, first, bytes, inner);
    strongest = larger(strongest, halfResponse(above, row, below));
    above = row;
    row = below;
  }
  return strongest;
}

/** CPU: one group = one tile; group (j, i). */
kernel GROUP void strengthStrip(global const uchar* restrict image, long step, int width, int height,
                                global int* restrict strength)
{
  const int j = get_group_id(0);
  const int top = (int)get_group_id(1) * EDGE_ROWS;
  const int bottom = min(height, top + EDGE_ROWS);
  const int end = 3 * min(width, 64 * (j + 1));
  short halves[EDGE_PIECE];
  int strongest = 0;
  for (int first = 192 * j; first < end; first += EDGE_PIECE)
  {
    const bool inner = first >= 3 && first + EDGE_PIECE + 3 <= 3 * width;
    vstore16(inner ? strongestOf(image, step, width, height, first, top, bottom, true)
                   : strongestOf(image, step, width, height, first, top, bottom, false),
             0, halves);
    for (int k = 0; k < min(EDGE_PIECE, end - first); ++k)
    {
      strongest = max(strongest, 2 * halves[k]);
    }
  }
  strength[get_group_id(1) * get_num_groups(0) + j] = strongest;
}

/** Slides down 16 bytes of the rows top .. bottom - 1; edge receives -1 where half the response exceeds the limit. */
INLINE void edgePieces(global const uchar* image, long step, int width, int height, int first, int top, int bottom,
                       short16 limit, bool inner, ulong2 edge[EDGE_ROWS][PIECES_OF_WORD], int piece)
{
  const int bytes = 3 * width;
  RowSums above = rowSums(image + max(top - 1, 0) * step, first, bytes, inner);
  RowSums row = rowSums(image + top * step, first, bytes, inner);
  for (int y = top; y < bottom; ++y)
  {
    const RowSums below = rowSums(image + min(y + 1, height - 1) * step, first, bytes, inner);
    edge[y - top][piece] = as_ulong2(convert_char16(halfResponse(above, row, below) > limit));
    above = row;
    row = below;
  }
}

/** 16 region bits from 48 flags (-1 = edge) in the order B G R B G R ... */
INLINE ulong regionBits(ulong2 p, ulong2 q, ulong2 r)
{
  // The flags of one channel lie at different places of the three vectors: masks bring them into one, in which a
  // single permutation sorts them. (A swizzle of several vectors becomes a copy byte by byte.)
  const ulong2 m0 = (ulong2)(0x00ff0000ff0000ffUL, 0xff0000ff0000ff00UL);
  const ulong2 m1 = (ulong2)(0xff0000ff0000ff00UL, 0x0000ff0000ff0000UL);
  const ulong2 m2 = (ulong2)(0x0000ff0000ff0000UL, 0x00ff0000ff0000ffUL);
  const uchar16 blue = as_uchar16((p & m0) | (q & m2) | (r & m1)).s0369cf258be147ad;
  const uchar16 green = as_uchar16((p & m1) | (q & m0) | (r & m2)).s147ad0369cf258be;
  const uchar16 red = as_uchar16((p & m2) | (q & m1) | (r & m0)).s258be147ad0369cf;
  const ulong2 region = as_ulong2(~(blue | green | red)) & (ulong2)0x0101010101010101UL;
  // The product moves bit 0 of each byte into the highest byte.
  const ulong gather = 0x0102040810204080UL;
  return ((region.x * gather) >> 56) | (((region.y * gather) >> 56) << 8);
}

/** CPU: one group = one tile; group (w, i). */
kernel GROUP void edgesStrip(global const uchar* restrict image, long step, int width, int height,
                             global const int* restrict strength, int floor, int threshold, global ulong* restrict mask)
{
  const int w = get_group_id(0);
  const int top = (int)get_group_id(1) * EDGE_ROWS;
  const int bottom = min(height, top + EDGE_ROWS);
  const int sixteens = (min(64, width - 64 * w) + 15) / 16;
  const int tile_threshold =
      tileThreshold(strength, get_num_groups(0), get_num_groups(1), get_group_id(1), w, floor, threshold);
  const short16 limit = (short16)(short)(tile_threshold / 2);
  ulong2 edge[EDGE_ROWS][PIECES_OF_WORD];
  for (int piece = 0; piece < PIECES_OF_16 * sixteens; ++piece)
  {
    const int first = 192 * w + EDGE_PIECE * piece;
    if (first >= 3 && first + EDGE_PIECE + 3 <= 3 * width)
    {
      edgePieces(image, step, width, height, first, top, bottom, limit, true, edge, piece);
    }
    else
    {
      edgePieces(image, step, width, height, first, top, bottom, limit, false, edge, piece);
    }
  }
  const ulong inside = width - 64 * w >= 64 ? ~0UL : (1UL << (width - 64 * w)) - 1;
  for (int y = top; y < bottom; ++y)
  {
    const ulong2* flags = edge[y - top];
    ulong word = 0;
    for (int i = 0; i < sixteens; ++i)
    {
      word |= regionBits(flags[3 * i], flags[3 * i + 1], flags[3 * i + 2]) << (16 * i);
    }
    mask[(size_t)y * wordsOf(width) + w] = word & inside;
  }
}

/** The largest |gx| + |gy| of B, G and R of a pixel. */
INLINE int responseAt(global const uchar* image, long step, int width, int height, int x, int y)
{
  global const uchar* above = image + max(y - 1, 0) * step;
  global const uchar* row = image + y * step;
  global const uchar* below = image + min(y + 1, height - 1) * step;
  const int l = 3 * max(x - 1, 0);
  const int c = 3 * x;
  const int r = 3 * min(x + 1, width - 1);
  int strongest = 0;
  for (int k = 0; k < 3; ++k)
  {
    const int gx = above[r + k] + 2 * row[r + k] + below[r + k] - above[l + k] - 2 * row[l + k] - below[l + k];
    const int gy = below[l + k] + 2 * below[c + k] + below[r + k] - above[l + k] - 2 * above[c + k] - above[r + k];
    strongest = max(strongest, (int)(abs(gx) + abs(gy)));
  }
  return strongest;
}

/** GPU: one group = one tile; group (j, i). */
kernel GROUP void strengthTile(global const uchar* restrict image, long step, int width, int height,
                               global int* restrict strength)
{
  local int strongest;
  const int left = 64 * (int)get_group_id(0);
  const int top = EDGE_ROWS * (int)get_group_id(1);
  const int across = min(64, width - left);
  const int pixels = across * min(EDGE_ROWS, height - top);
  if (get_local_id(0) == 0)
  {
    strongest = 0;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int i = get_local_id(0); i < pixels; i += LANES)
  {
    atomic_max(&strongest, responseAt(image, step, width, height, left + i % across, top + i / across));
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) == 0)
  {
    strength[get_group_id(1) * get_num_groups(0) + get_group_id(0)] = strongest;
  }
}

/** GPU: one group = one word of one row; group (w, y). */
kernel GROUP void edgesWord(global const uchar* restrict image, long step, int width, int height,
                            global const int* restrict strength, int floor, int threshold, global ulong* restrict mask)
{
  local uint halves[2];
  const int w = get_group_id(0);
  const int y = get_group_id(1);
  if (get_local_id(0) == 0)
  {
    halves[0] = halves[1] = 0;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  const int tiles_down = (height + EDGE_ROWS - 1) / EDGE_ROWS;
  const int tile_threshold = tileThreshold(strength, get_num_groups(0), tiles_down, y / EDGE_ROWS, w, floor, threshold);
  for (int bit = get_local_id(0); bit < min(64, width - 64 * w); bit += LANES)
  {
    if (responseAt(image, step, width, height, 64 * w + bit, y) <= tile_threshold)
    {
      atomic_or(&halves[bit >> 5], 1u << (bit & 31));
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) == 0)
  {
    mask[(size_t)y * wordsOf(width) + w] = halves[0] | ((ulong)halves[1] << 32);
  }
}
