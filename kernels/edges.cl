// Colour Sobel edges (paper, section 3.1): the largest |gx| + |gy| of B, G and R above the threshold makes an edge
// pixel; borders replicated. The result is the region mask of mask.cl.

#include "mask.cl"

/** Rows that a work-item of edgesStrip slides down: each row is read once, not three times. */
#define EDGE_ROWS 16

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
    const short16 falling = row.difference + below.ahead - above.behind;
    const short16 rising = row.difference + above.ahead - below.behind;
    const short16 response = larger(larger(falling, -falling), larger(rising, -rising));
    edge[y - top][piece] = as_ulong2(convert_char16(response > limit));
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

/** CPU: one group = 64 pixels x EDGE_ROWS rows; group (w, block of rows). */
kernel GROUP void edgesStrip(global const uchar* restrict image, long step, int width, int height, int threshold,
                             global ulong* restrict mask)
{
  const int w = get_group_id(0);
  const int top = (int)get_group_id(1) * EDGE_ROWS;
  const int bottom = min(height, top + EDGE_ROWS);
  const int sixteens = (min(64, width - 64 * w) + 15) / 16;
  const short16 limit = (short16)(short)(threshold / 2);
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

/** GPU: one group = one word of one row; group (w, y). */
kernel GROUP void edgesWord(global const uchar* restrict image, long step, int width, int height, int threshold,
                            global ulong* restrict mask)
{
  local uint halves[2];
  const int w = get_group_id(0);
  const int y = get_group_id(1);
  if (get_local_id(0) == 0)
  {
    halves[0] = halves[1] = 0;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  global const uchar* above = image + max(y - 1, 0) * step;
  global const uchar* row = image + y * step;
  global const uchar* below = image + min(y + 1, height - 1) * step;
  for (int bit = get_local_id(0); bit < min(64, width - 64 * w); bit += LANES)
  {
    const int x = 64 * w + bit;
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
    if (strongest <= threshold)
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
