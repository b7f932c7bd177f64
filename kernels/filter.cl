// Prefilters (paper, section 4.1) on interleaved B, G, R bytes, borders replicated; the results are those of
// cv::GaussianBlur and cv::medianBlur, bit for bit. One group a row.

#include "geometry.cl"

/** Bytes of a row that a group takes at a time: their column sums stay in the first-level cache. */
#define PIECE 1536

/** Byte index that stands for one left or right of the row: the same channel of the border pixel. */
INLINE int replicated(int byte, int bytes)
{
  return byte < 0 ? (byte + 6) % 3 : byte >= bytes ? bytes - 3 + byte % 3 : byte;
}

/** Row y of the image; beyond the border the first or last row. */
INLINE global const uchar* rowAt(global const uchar* image, long step, int height, int y)
{
  return image + clamp(y, 0, height - 1) * step;
}

// The rows around row y, from top to bottom a b c d e.
#define ROWS3                                                         \
  global const uchar* restrict b = rowAt(image, step, height, y - 1); \
  global const uchar* restrict c = rowAt(image, step, height, y);     \
  global const uchar* restrict d = rowAt(image, step, height, y + 1)
#define ROWS5                                                         \
  ROWS3;                                                              \
  global const uchar* restrict a = rowAt(image, step, height, y - 2); \
  global const uchar* restrict e = rowAt(image, step, height, y + 2)

/** Binomial filter: down the columns, then along the row, rounded once. */
#define GAUSSIAN(name, radius, ROWS, COLUMN, ROW)                                              \
  kernel GROUP void name(global const uchar* restrict image, long step, int width, int height, \
                         global uchar* restrict filtered)                                      \
  {                                                                                            \
    local ushort sums[PIECE + 6 * radius];                                                     \
    const int halo = 3 * radius;                                                               \
    const int y = get_group_id(0);                                                             \
    const int lane = get_local_id(0);                                                          \
    const int bytes = 3 * width;                                                               \
    ROWS;                                                                                      \
    global uchar* restrict out = filtered + (size_t)y * bytes;                                 \
    for (int first = 0; first < bytes; first += PIECE)                                         \
    {                                                                                          \
      const int count = min(PIECE, bytes - first);                                             \
      for (int i = lane; i < count; i += LANES)                                                \
      {                                                                                        \
        sums[halo + i] = (ushort)COLUMN(first + i);                                            \
      }                                                                                        \
      for (int i = lane; i < 2 * halo; i += LANES)                                             \
      {                                                                                        \
        const int place = i < halo ? i : count + i;                                            \
        const int x = replicated(first + place - halo, bytes);                                 \
        sums[place] = (ushort)COLUMN(x);                                                       \
      }                                                                                        \
      barrier(CLK_LOCAL_MEM_FENCE);                                                            \
      for (int i = lane; i < count; i += LANES)                                                \
      {                                                                                        \
        out[first + i] = (uchar)(ROW(i));                                                      \
      }                                                                                        \
      barrier(CLK_LOCAL_MEM_FENCE);                                                            \
    }                                                                                          \
  }

#define COLUMN3(x) (b[x] + 2 * c[x] + d[x])
#define COLUMN5(x) (a[x] + 4 * b[x] + 6 * c[x] + 4 * d[x] + e[x])
#define ROW3(i) ((sums[i] + 2 * sums[i + 3] + sums[i + 6] + 8) >> 4)
#define ROW5(i) ((sums[i] + 4 * sums[i + 3] + 6 * sums[i + 6] + 4 * sums[i + 9] + sums[i + 12] + 128) >> 8)

GAUSSIAN(gaussian3, 1, ROWS3, COLUMN3, ROW3)
GAUSSIAN(gaussian5, 2, ROWS5, COLUMN5, ROW5)

// The median by exchanges only, written out on scalars: the loop over a row then becomes vector min and max (private
// arrays and functions keep it scalar, which takes a hundred times as long).
#define ORDER(a, b)                      \
  {                                      \
    const uchar smaller = a < b ? a : b; \
    b = a < b ? b : a;                   \
    a = smaller;                         \
  }
#define SORT5(a, b, c, d, e) \
  ORDER(a, b) ORDER(d, e) ORDER(c, e) ORDER(c, d) ORDER(b, e) ORDER(a, d) ORDER(a, c) ORDER(b, d) ORDER(b, c)

// Forgetful selection: among any size / 2 + 2 of the values the smallest and the largest are not the median; drop both,
// take one more in, until one is left. EXTREMESn moves them to v0 and to the last of n.
// clang-format off
#define EXTREMES8                                                                      \
  ORDER(v0, v7) ORDER(v1, v6) ORDER(v2, v5) ORDER(v3, v4)                              \
  ORDER(v0, v1) ORDER(v0, v2) ORDER(v0, v3) ORDER(v4, v7) ORDER(v5, v7) ORDER(v6, v7)
#define EXTREMES7                                                                      \
  ORDER(v0, v6) ORDER(v1, v5) ORDER(v2, v4)                                            \
  ORDER(v0, v1) ORDER(v0, v2) ORDER(v0, v3) ORDER(v3, v6) ORDER(v4, v6) ORDER(v5, v6)
#define EXTREMES6                                                                      \
  ORDER(v0, v5) ORDER(v1, v4) ORDER(v2, v3)                                            \
  ORDER(v0, v1) ORDER(v0, v2) ORDER(v3, v5) ORDER(v4, v5)
// clang-format on
#define EXTREMES5 ORDER(v0, v4) ORDER(v1, v3) ORDER(v0, v1) ORDER(v0, v2) ORDER(v2, v4) ORDER(v3, v4)
#define EXTREMES4 ORDER(v0, v3) ORDER(v1, v2) ORDER(v0, v1) ORDER(v2, v3)
#define EXTREMES3 ORDER(v0, v2) ORDER(v0, v1) ORDER(v1, v2)

#define MEDIAN3(ll, l, x, r, rr)           \
  {                                        \
    uchar v0 = b[l], v1 = b[x], v2 = b[r]; \
    uchar v3 = c[l], v4 = c[x], v5 = c[r]; \
    EXTREMES6 v0 = d[l];                   \
    EXTREMES5 v0 = d[x];                   \
    EXTREMES4 v0 = d[r];                   \
    EXTREMES3 out[x] = v1;                 \
  }

// With columns and then rows of the window in order, 6 of the 25 values are too small and 6 too large to be the median.
#define MEDIAN5(ll, l, x, r, rr)                                                  \
  {                                                                               \
    uchar a0 = a[ll], a1 = a[l], a2 = a[x], a3 = a[r], a4 = a[rr];                \
    uchar b0 = b[ll], b1 = b[l], b2 = b[x], b3 = b[r], b4 = b[rr];                \
    uchar c0 = c[ll], c1 = c[l], c2 = c[x], c3 = c[r], c4 = c[rr];                \
    uchar d0 = d[ll], d1 = d[l], d2 = d[x], d3 = d[r], d4 = d[rr];                \
    uchar e0 = e[ll], e1 = e[l], e2 = e[x], e3 = e[r], e4 = e[rr];                \
    SORT5(a0, b0, c0, d0, e0)                                                     \
    SORT5(a1, b1, c1, d1, e1)                                                     \
    SORT5(a2, b2, c2, d2, e2)                                                     \
    SORT5(a3, b3, c3, d3, e3)                                                     \
    SORT5(a4, b4, c4, d4, e4)                                                     \
    SORT5(a0, a1, a2, a3, a4)                                                     \
    SORT5(b0, b1, b2, b3, b4)                                                     \
    SORT5(c0, c1, c2, c3, c4)                                                     \
    SORT5(d0, d1, d2, d3, d4)                                                     \
    SORT5(e0, e1, e2, e3, e4)                                                     \
    uchar v0 = a3, v1 = a4, v2 = b2, v3 = b3, v4 = b4, v5 = c1, v6 = c2, v7 = c3; \
    EXTREMES8 v0 = d0;                                                            \
    EXTREMES7 v0 = d1;                                                            \
    EXTREMES6 v0 = d2;                                                            \
    EXTREMES5 v0 = e0;                                                            \
    EXTREMES4 v0 = e1;                                                            \
    EXTREMES3 out[x] = v1;                                                        \
  }

/** Median filter; bytes first .. last - 1 need no replicated columns. */
#define MEDIAN(name, radius, ROWS, MEDIAN_AT)                                                    \
  kernel GROUP void name(global const uchar* restrict image, long step, int width, int height,   \
                         global uchar* restrict filtered)                                        \
  {                                                                                              \
    const int y = get_group_id(0);                                                               \
    const int bytes = 3 * width;                                                                 \
    const int first = min(bytes, 3 * radius);                                                    \
    const int last = max(first, bytes - 3 * radius);                                             \
    ROWS;                                                                                        \
    global uchar* restrict out = filtered + (size_t)y * bytes;                                   \
    for (int x = first + (int)get_local_id(0); x < last; x += LANES)                             \
    {                                                                                            \
      MEDIAN_AT(x - 6, x - 3, x, x + 3, x + 6)                                                   \
    }                                                                                            \
    for (int i = get_local_id(0); i < first + bytes - last; i += LANES)                          \
    {                                                                                            \
      const int x = i < first ? i : last + i - first;                                            \
      MEDIAN_AT(replicated(x - 6, bytes), replicated(x - 3, bytes), x, replicated(x + 3, bytes), \
                replicated(x + 6, bytes))                                                        \
    }                                                                                            \
  }

MEDIAN(median3, 1, ROWS3, MEDIAN3)
MEDIAN(median5, 2, ROWS5, MEDIAN5)
