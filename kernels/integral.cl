// Integral image of B, G and R (paper, section 4.5; Viola and Jones 2001): the sum of all pixels above and left of a
// place, modulo 2^32. Cells begin at even pixels, so it is kept for these only: (height / 2 + 1) x (width / 2 + 1) x 3,
// equal to every second row and column of cv::integral().

#include "geometry.cl"

/** The sum of 2 x 2 pixels in a channel. */
INLINE uint sumOfFour(global const uchar* upper, global const uchar* lower)
{
  return upper[0] + upper[3] + lower[0] + lower[3];
}

/** CPU: sums of the columns of a strip of rows, one group a strip. @param sums of each strip: 3 * width. */
kernel GROUP void columnSums(global const uchar* restrict image, long step, int width, int height, int strip_rows,
                             global uint* restrict sums)
{
  const int top = get_group_id(0) * strip_rows;
  const int bottom = min(height, top + strip_rows);
  const int bytes = 3 * width;
  global uint* restrict sum = sums + (size_t)get_group_id(0) * bytes;
  for (int i = get_local_id(0); i < bytes; i += LANES)
  {
    sum[i] = 0;
  }
  for (int y = top; y < bottom; ++y)
  {
    global const uchar* restrict row = image + y * step;
    for (int i = get_local_id(0); i < bytes; i += LANES)
    {
      sum[i] += row[i];
    }
  }
}

/**
 * CPU: the integral image of a strip, one group a strip.
 *
 * @param strip_rows even.
 * @param sums       as columnSums gives them.
 */
kernel GROUP void integralStrip(global const uchar* restrict image, long step, int width, int height, int strip_rows,
                                global const uint* restrict sums, global uint* restrict integral)
{
  const int top = get_group_id(0) * strip_rows / 2;
  const int bottom = min(height / 2, top + strip_rows / 2);
  const int across = width / 2;
  const int columns = 3 * across + 3;
  if (get_local_id(0) != 0)
  {
    return;
  }
  for (int i = 0; top == 0 && i < columns; ++i)
  {
    integral[i] = 0;
  }
  if (top >= bottom)
  {
    return;
  }
  // The row above the strip: all strips before this one, column by column, then along the row. The strip before may
  // write the same values at the same time, so they are kept in place of the first row below.
  global uint* restrict first = integral + (size_t)(top + 1) * columns;
  for (int i = 0; i < columns; ++i)
  {
    first[i] = 0;
  }
  for (int strip = 0; strip < (int)get_group_id(0); ++strip)
  {
    global const uint* restrict sum = sums + (size_t)strip * 3 * width;
    for (int x = 0; x < across; ++x)
    {
      for (int k = 0; k < 3; ++k)
      {
        first[3 * x + 3 + k] += sum[6 * x + k] + sum[6 * x + 3 + k];
      }
    }
  }
  for (int y = top; y < bottom; ++y)
  {
    global const uchar* restrict upper_pixels = image + 2 * y * step;
    global const uchar* restrict lower_pixels = upper_pixels + step;
    // What stands above: in the first row the sums of the columns, in the others the row before.
    global const uint* above = y == top ? first : integral + (size_t)y * columns;
    global uint* out = integral + (size_t)(y + 1) * columns;
    uint blue = 0;
    uint green = 0;
    uint red = 0;
    out[0] = out[1] = out[2] = 0;
    if (y == top)
    {
      for (int x = 0; x < across; ++x)
      {
        blue += above[3 * x + 3] + sumOfFour(upper_pixels + 6 * x, lower_pixels + 6 * x);
        green += above[3 * x + 4] + sumOfFour(upper_pixels + 6 * x + 1, lower_pixels + 6 * x + 1);
        red += above[3 * x + 5] + sumOfFour(upper_pixels + 6 * x + 2, lower_pixels + 6 * x + 2);
        out[3 * x + 3] = blue;
        out[3 * x + 4] = green;
        out[3 * x + 5] = red;
      }
      continue;
    }
    for (int x = 0; x < across; ++x)
    {
      blue += sumOfFour(upper_pixels + 6 * x, lower_pixels + 6 * x);
      green += sumOfFour(upper_pixels + 6 * x + 1, lower_pixels + 6 * x + 1);
      red += sumOfFour(upper_pixels + 6 * x + 2, lower_pixels + 6 * x + 2);
      out[3 * x + 3] = above[3 * x + 3] + blue;
      out[3 * x + 4] = above[3 * x + 4] + green;
      out[3 * x + 5] = above[3 * x + 5] + red;
    }
  }
}

/** GPU: sums along the rows, one group two rows of pixels. */
kernel GROUP void integralRows(global const uchar* restrict image, long step, int width,
                               global uint* restrict integral)
{
  local uint sums[3 * LANES];
  const int lane = get_local_id(0);
  const int y = get_group_id(0);
  const int across = width / 2;
  global const uchar* restrict upper = image + 2 * y * step;
  global const uchar* restrict lower = upper + step;
  global uint* restrict out = integral + (size_t)(y + 1) * (3 * across + 3);
  if (lane < 3)
  {
    out[lane] = 0;
  }
  uint before[3] = {0, 0, 0};
  for (int base = 0; base < across; base += LANES)
  {
    const int x = base + lane;
    for (int k = 0; k < 3; ++k)
    {
      sums[k * LANES + lane] = x < across ? sumOfFour(upper + 6 * x + k, lower + 6 * x + k) : 0;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (int distance = 1; distance < LANES; distance *= 2)
    {
      uint left[3];
      for (int k = 0; k < 3; ++k)
      {
        left[k] = lane >= distance ? sums[k * LANES + lane - distance] : 0;
      }
      barrier(CLK_LOCAL_MEM_FENCE);
      for (int k = 0; k < 3; ++k)
      {
        sums[k * LANES + lane] += left[k];
      }
      barrier(CLK_LOCAL_MEM_FENCE);
    }
    for (int k = 0; k < 3; ++k)
    {
      if (x < across)
      {
        out[3 * x + 3 + k] = before[k] + sums[k * LANES + lane];
      }
      before[k] += sums[k * LANES + LANES - 1];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
  }
}

/** GPU: sums down the columns of what integralRows gives, one lane a column and channel. */
kernel GROUP void integralColumns(int width, int height, global uint* restrict integral)
{
  const int i = get_global_id(0);
  const int columns = 3 * (width / 2) + 3;
  if (i >= columns)
  {
    return;
  }
  uint sum = 0;
  integral[i] = 0;
  for (int y = 1; y <= height / 2; ++y)
  {
    global uint* at = integral + (size_t)y * columns + i;
    sum += *at;
    *at = sum;
  }
}
