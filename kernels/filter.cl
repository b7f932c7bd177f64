// Prefilters (paper, section 4.1) on interleaved B, G, R bytes, borders replicated; the results are those of
// cv::GaussianBlur and cv::medianBlur, bit for bit. One group a row.

#include "geometry.cl"

/** Bytes of a row that a group takes at a time: their column sums stay in the first-level cache. */
#define PIECE 1536

/** Byte index that stands for one left or right of the row: the same channel of the border pixel. */
inline int replicated(int byte, int bytes)
{
  return byte < 0 ? (byte + 6) % 3 : byte >= bytes ? bytes - 3 + byte % 3 : byte;
}

/** Row y of the image; beyond the border the first or last row. */
inline global const uchar* rowAt(global const uchar* image, long step, int height, int y)
{
  return image + clamp(y, 0, height - 1) * step;
}

// The rows around row y, from top to bottom a b c d e.
#define ROWS3                                                             \
  global const uchar* restrict b = rowAt(image, step, height, y - 1);     \
  global const uchar* restrict c = rowAt(image, step, height, y);         \
  global const uchar* restrict d = rowAt(image, step, height, y + 1);
#define ROWS5                                                             \
  ROWS3                                                                   \
  global const uchar* restrict a = rowAt(image, step, height, y - 2);     \
  global const uchar* restrict e = rowAt(image, step, height, y + 2);

/** Binomial filter: down the columns, then along the row, rounded once. */
#define GAUSSIAN(name, radius, ROWS, COLUMN, ROW)                                                                 \
  kernel GROUP void name(global const uchar* restrict image, long step, int width, int height,               \
                         global uchar* restrict filtered)                                                    \
  {                                                                                                          \
    local ushort sums[PIECE + 6 * radius];                                                                   \
    const int halo = 3 * radius;                                                                             \
    const int y = get_group_id(0);                                                                           \
    const int lane = get_local_id(0);                                                                        \
    const int bytes = 3 * width;                                                                             \
    ROWS                                                                                                     \
    global uchar* restrict out = filtered + (size_t)y * bytes;                                               \
    for (int first = 0; first < bytes; first += PIECE)                                                       \
    {                                                                                                        \
      const int count = min(PIECE, bytes - first);                                                           \
      for (int i = lane; i < count; i += LANES)                                                              \
      {                                                                                                      \
        sums[halo + i] = (ushort)COLUMN(first + i);                                                          \
      }                                                                                                      \
      for (int i = lane; i < 2 * halo; i += LANES)                                                           \
      {                                                                                                      \
        const int place = i < halo ? i : count + i;                                                          \
        const int x = replicated(first + place - halo, bytes);                                               \
        sums[place] = (ushort)COLUMN(x);                                                                     \
      }                                                                                                      \
      barrier(CLK_LOCAL_MEM_FENCE);                                                                          \
      for (int i = lane; i < count; i += LANES)                                                              \
      {                                                                                                      \
        out[first + i] = (uchar)(ROW(i));                                                                    \
      }                                                                                                      \
      barrier(CLK_LOCAL_MEM_FENCE);                                                                          \
    }                                                                                                        \
  }

#define COLUMN3(x) (b[x] + 2 * c[x] + d[x])
#define COLUMN5(x) (a[x] + 4 * b[x] + 6 * c[x] + 4 * d[x] + e[x])
#define ROW3(i) ((sums[i] + 2 * sums[i + 3] + sums[i + 6] + 8) >> 4)
#define ROW5(i) ((sums[i] + 4 * sums[i + 3] + 6 * sums[i + 6] + 4 * sums[i + 9] + sums[i + 12] + 128) >> 8)

GAUSSIAN(gaussian3, 1, ROWS3, COLUMN3, ROW3)
GAUSSIAN(gaussian5, 2, ROWS5, COLUMN5, ROW5)

inline void order(uchar* low, uchar* high)
{
  const uchar a = *low;
  const uchar b = *high;
  *low = a < b ? a : b;
  *high = a < b ? b : a;
}

/** Moves the smallest of count values to the front and the largest to the end. */
inline void separateExtremes(uchar* values, int count)
{
#pragma unroll
  for (int i = 0; i < count / 2; ++i)
  {
    order(&values[i], &values[count - 1 - i]);
  }
#pragma unroll
  for (int i = 1; i < (count + 1) / 2; ++i)
  {
    order(&values[0], &values[i]);
  }
#pragma unroll
  for (int i = count / 2; i < count - 1; ++i)
  {
    order(&values[i], &values[count - 1]);
  }
}

/**
 * Median of 9 or 25 values by forgetful selection: among any size / 2 + 2 of them the smallest and the largest are not
 * the median; drop both, take one more in, until one is left. No branches: the loop over a row becomes vector min and max.
 */
inline uchar medianOf(uchar* values, const int size)
{
  const int kept = size / 2 + 2;
#pragma unroll
  for (int count = kept; count > 3; --count)
  {
    separateExtremes(values, count);
    values[0] = values[kept + (kept - count)];
  }
  separateExtremes(values, 3);
  return values[1];
}

/** Median filter; bytes first .. last - 1 need no replicated columns. */
#define MEDIAN(name, radius, size, ROWS, WINDOW)                                                                   \
  kernel GROUP void name(global const uchar* restrict image, long step, int width, int height,               \
                         global uchar* restrict filtered)                                                    \
  {                                                                                                          \
    const int y = get_group_id(0);                                                                           \
    const int bytes = 3 * width;                                                                             \
    const int first = min(bytes, 3 * radius);                                                                \
    const int last = max(first, bytes - 3 * radius);                                                         \
    ROWS                                                                                                     \
    global uchar* restrict out = filtered + (size_t)y * bytes;                                               \
    for (int x = first + (int)get_local_id(0); x < last; x += LANES)                                         \
    {                                                                                                        \
      uchar values[size] = WINDOW(x - 6, x - 3, x, x + 3, x + 6);                                            \
      out[x] = medianOf(values, size);                                                                       \
    }                                                                                                        \
    for (int i = get_local_id(0); i < first + bytes - last; i += LANES)                                      \
    {                                                                                                        \
      const int x = i < first ? i : last + i - first;                                                        \
      uchar values[size] = WINDOW(replicated(x - 6, bytes), replicated(x - 3, bytes), x,                     \
                                  replicated(x + 3, bytes), replicated(x + 6, bytes));                       \
      out[x] = medianOf(values, size);                                                                       \
    }                                                                                                        \
  }

#define WINDOW3(ll, l, x, r, rr) {b[l], b[x], b[r], c[l], c[x], c[r], d[l], d[x], d[r]}
#define WINDOW5(ll, l, x, r, rr)                                                                             \
  {                                                                                                          \
    a[ll], a[l], a[x], a[r], a[rr], b[ll], b[l], b[x], b[r], b[rr], c[ll], c[l], c[x], c[r], c[rr], d[ll],   \
        d[l], d[x], d[r], d[rr], e[ll], e[l], e[x], e[r], e[rr]                                              \
  }

MEDIAN(median3, 1, 9, ROWS3, WINDOW3)
MEDIAN(median5, 2, 25, ROWS5, WINDOW5)
