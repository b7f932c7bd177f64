// Integral image of B, G and R (paper, section 4.5; Viola and Jones 2001): the sum of all pixels above and left of a
// place, modulo 2^32, (height + 1) x (width + 1) x 3, equal to cv::integral().

#include "geometry.cl"

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

/** CPU: the integral image of a strip, one group a strip. @param sums as columnSums gives them. */
kernel GROUP void integralStrip(global const uchar* restrict image, long step, int width, int height, int strip_rows,
                                global const uint* restrict sums, global uint* restrict integral)
{
  const int top = get_group_id(0) * strip_rows;
  const int bottom = min(height, top + strip_rows);
  const int bytes = 3 * width;
  global uint* restrict above = integral + (size_t)top * (bytes + 3);
  if (get_local_id(0) != 0)
  {
    return;
  }
  // The row above the strip: all strips before this one, column by column, then along the row. The strip before may
  // write the same values at the same time, so they are kept in place of the first row below.
  global uint* restrict first = above + bytes + 3;
  for (int i = 0; i < bytes + 3; ++i)
  {
    first[i] = 0;
  }
  for (int strip = 0; strip < (int)get_group_id(0); ++strip)
  {
    global const uint* restrict sum = sums + (size_t)strip * bytes;
    for (int i = 0; i < bytes; ++i)
    {
      first[i + 3] += sum[i];
    }
  }
  uint blue = 0;
  uint green = 0;
  uint red = 0;
  global const uchar* restrict row = image + top * step;
  for (int x = 1; x <= width; ++x)
  {
    blue += first[3 * x] + row[3 * x - 3];
    green += first[3 * x + 1] + row[3 * x - 2];
    red += first[3 * x + 2] + row[3 * x - 1];
    first[3 * x] = blue;
    first[3 * x + 1] = green;
    first[3 * x + 2] = red;
  }
  for (int y = top + 1; y < bottom; ++y)
  {
    row = image + y * step;
    global const uint* restrict upper = integral + (size_t)y * (bytes + 3);
    global uint* restrict lower = integral + (size_t)(y + 1) * (bytes + 3);
    lower[0] = lower[1] = lower[2] = 0;
    blue = green = red = 0;
    for (int x = 1; x <= width; ++x)
    {
      blue += row[3 * x - 3];
      green += row[3 * x - 2];
      red += row[3 * x - 1];
      lower[3 * x] = upper[3 * x] + blue;
      lower[3 * x + 1] = upper[3 * x + 1] + green;
      lower[3 * x + 2] = upper[3 * x + 2] + red;
    }
  }
  if (top == 0)
  {
    for (int i = 0; i < bytes + 3; ++i)
    {
      integral[i] = 0;
    }
  }
}

/** GPU: sums along the rows, one group a row. */
kernel GROUP void integralRows(global const uchar* restrict image, long step, int width,
                               global uint* restrict integral)
{
  local uint sums[3 * LANES];
  const int lane = get_local_id(0);
  const int y = get_group_id(0);
  global const uchar* restrict row = image + y * step;
  global uint* restrict out = integral + (size_t)(y + 1) * (3 * width + 3);
  if (lane < 3)
  {
    out[lane] = 0;
  }
  uint before[3] = {0, 0, 0};
  for (int base = 0; base < width; base += LANES)
  {
    const int x = base + lane;
    for (int k = 0; k < 3; ++k)
    {
      sums[k * LANES + lane] = x < width ? row[3 * x + k] : 0;
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
      if (x < width)
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
  const int columns = 3 * width + 3;
  if (i >= columns)
  {
    return;
  }
  uint sum = 0;
  integral[i] = 0;
  for (int y = 1; y <= height; ++y)
  {
    global uint* at = integral + (size_t)y * columns + i;
    sum += *at;
    *at = sum;
  }
}
