// Colour Sobel edges (paper, section 3.1): the largest |gx| + |gy| of B, G and R above the threshold makes an edge
// pixel; borders replicated. The result is the region mask of mask.cl.

#include "mask.cl"

/** Rows that a work-item of edgesStrip slides down: each row is read once, not three times. */
#define EDGE_ROWS 16

/** Horizontal difference (right - left) and sum (left + 2 centre + right) of 16 pixels: 48 bytes in three vectors. */
typedef struct
{
  short16 difference[3];
  short16 sum[3];
} SobelRow;

// PoCL turns abs() on vectors into scalar code; operators take 0.4 of its time.
INLINE short16 magnitude(short16 value)
{
  const short16 sign = value >> (short16)15;
  return (value ^ sign) - sign;
}

/** @param inner whether the 16 pixels from x on have neighbours on both sides; constant, so that no branch is left. */
INLINE SobelRow sobelRow(global const uchar* row, int x, int width, bool inner)
{
  uchar bytes[54];
  if (!inner)
  {
    for (int i = 0; i < 18; ++i)
    {
      const int from = 3 * clamp(x - 1 + i, 0, width - 1);
      bytes[3 * i] = row[from];
      bytes[3 * i + 1] = row[from + 1];
      bytes[3 * i + 2] = row[from + 2];
    }
  }
  SobelRow result;
#pragma unroll
  for (int k = 0; k < 3; ++k)
  {
    global const uchar* at = row + 3 * x + 16 * k;
    const short16 left = convert_short16(inner ? vload16(0, at - 3) : vload16(0, bytes + 16 * k));
    const short16 centre = convert_short16(inner ? vload16(0, at) : vload16(0, bytes + 16 * k + 3));
    const short16 right = convert_short16(inner ? vload16(0, at + 3) : vload16(0, bytes + 16 * k + 6));
    result.difference[k] = right - left;
    result.sum[k] = left + centre + centre + right;
  }
  return result;
}

/** 16 region bits from 48 byte flags (-1 = edge) in the order B G R B G R ... */
INLINE ulong regionBits(char16 p, char16 q, char16 r)
{
  const char16 blue = (char16)(p.s0369, p.scf, q.s258b, q.se, r.s147a, r.sd);
  const char16 green = (char16)(p.s147a, p.sd, q.s0369, q.scf, r.s258b, r.se);
  const char16 red = (char16)(p.s258b, p.se, q.s147a, q.sd, r.s0369, r.scf);
  const uchar16 weights = (uchar16)(1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128);
  ulong2 bits = as_ulong2(as_uchar16(~(blue | green | red)) & weights);
  bits |= bits >> 32;
  bits |= bits >> 16;
  bits |= bits >> 8;
  bits &= (ulong2)255;
  return bits.x | (bits.y << 8);
}

/** Slides down 16 columns from x on and adds their region bits to the words of the rows top .. bottom - 1. */
INLINE void edgeColumns(global const uchar* image, long step, int width, int height, int x, int top, int bottom,
                        short16 limit, bool inner, ulong* word)
{
  SobelRow above = sobelRow(image + max(top - 1, 0) * step, x, width, inner);
  SobelRow row = sobelRow(image + top * step, x, width, inner);
  for (int y = top; y < bottom; ++y)
  {
    const SobelRow below = sobelRow(image + min(y + 1, height - 1) * step, x, width, inner);
    char16 edge[3];
#pragma unroll
    for (int k = 0; k < 3; ++k)
    {
      const short16 gx = above.difference[k] + row.difference[k] + row.difference[k] + below.difference[k];
      const short16 gy = below.sum[k] - above.sum[k];
      edge[k] = convert_char16(magnitude(gx) + magnitude(gy) > limit);
    }
    word[y - top] |= regionBits(edge[0], edge[1], edge[2]) << (x & 63);
    above = row;
    row = below;
  }
}

/** CPU: one group = 64 pixels x EDGE_ROWS rows; group (w, block of rows). */
kernel GROUP void edgesStrip(global const uchar* restrict image, long step, int width, int height, int threshold,
                             global ulong* restrict mask)
{
  const int w = get_group_id(0);
  const int top = (int)get_group_id(1) * EDGE_ROWS;
  const int bottom = min(height, top + EDGE_ROWS);
  const short16 limit = (short16)(short)threshold;
  ulong word[EDGE_ROWS] = {0};
  for (int x = 64 * w; x < min(width, 64 * w + 64); x += 16)
  {
    if (x > 0 && x + 16 < width)
    {
      edgeColumns(image, step, width, height, x, top, bottom, limit, true, word);
    }
    else
    {
      edgeColumns(image, step, width, height, x, top, bottom, limit, false, word);
    }
  }
  const ulong inside = width - 64 * w >= 64 ? ~0UL : (1UL << (width - 64 * w)) - 1;
  for (int y = top; y < bottom; ++y)
  {
    mask[(size_t)y * wordsOf(width) + w] = word[y - top] & inside;
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
