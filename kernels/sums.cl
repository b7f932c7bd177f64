// Region data (paper, Table 1) as exact integer sums: the order of the additions does not matter. Nothing is written
// when the image needs more records than there are; the host then grows the buffer and repeats the step.

#include "mask.cl"
#include "record.cl"

/** Longest run whose channel sums fit 21 bits each: 8192 * 255 < 2^21. */
#define LONGEST_PIECE 8192

/** Coordinate sums of the pixels start .. end - 1 of row y. */
typedef struct
{
  ulong x, y, xx, xy, yy;
} Moments;

INLINE Moments runMoments(uint start, uint end, uint y)
{
  const ulong length = end - start;
  const ulong x = sumOf(start, end);
  const Moments moments = {x, length * y, squaresOf(start, end), x * y, length * y * y};
  return moments;
}

/** Set bits start .. end - 1 of a row of words. */
INLINE uint bitsBetween(global const ulong* row, int start, int end)
{
  const int first = start >> 6;
  const int last = (end - 1) >> 6;
  const ulong first_bits = ~0UL << (start & 63);
  const ulong last_bits = ~0UL >> (63 - ((end - 1) & 63));
  if (first == last)
  {
    return (uint)popcount(row[first] & first_bits & last_bits);
  }
  uint count = (uint)popcount(row[first] & first_bits) + (uint)popcount(row[last] & last_bits);
  for (int w = first + 1; w < last; ++w)
  {
    count += (uint)popcount(row[w]);
  }
  return count;
}

/** Channel sums of a run, from prefix sums of 21 bits packed in a word. */
INLINE ulong3 channelSums(global const ulong* upto, int start, int end)
{
  ulong3 sums = (ulong3)(0);
  for (int first = start; first < end; first += LONGEST_PIECE)
  {
    const ulong packed = upto[min(end, first + LONGEST_PIECE)] - upto[first];
    sums += (ulong3)(packed & 0x1fffff, (packed >> 21) & 0x1fffff, packed >> 42);
  }
  return sums;
}

/**
 * CPU: sums the runs of a strip into the records of its slots. One group (of one lane) a strip.
 *
 * The channel sums of a run are the difference of two prefix sums over the row, three sums of 21 bits packed in a word:
 * on a busy photograph this takes 0.6 of the time of a sum over every run. The prefix may overflow, the difference
 * does not.
 *
 * @param measures 0: no channel sums and no perimeter, which take two thirds of the time
 * @param scratch  width + 1 + wordsOf(width) words for every strip: the prefix sums of a row, and its pixels beside an edge
 */
kernel GROUP void sumStrip(global const uchar* restrict image, long step, global const ulong* restrict mask, int width,
                           int height, int strip_rows, int measures, global const ushort* restrict runs,
                           global const int* restrict row_first, global const int* restrict row_runs,
                           global const int* restrict run_slot, global const int* restrict slot_record,
                           global ulong* restrict scratch, global RegionSums* restrict records, uint capacity,
                           global const Counters* counters)
{
  if (counters->records > capacity)
  {
    return;
  }
  const int top = (int)get_group_id(0) * strip_rows;
  const int bottom = min(height, top + strip_rows);
  const int words = wordsOf(width);
  global ulong* restrict upto = scratch + get_group_id(0) * (size_t)(width + 1 + words);
  global ulong* restrict outline = upto + width + 1;
  upto[0] = 0;
  for (int y = top; y < bottom; ++y)
  {
    global const uchar* restrict row = image + y * step;
    if (measures != 0)
    {
      ulong sum = 0;
#pragma unroll 4
      for (int x = 0; x < width; ++x)
      {
        sum += (ulong)row[3 * x] + ((ulong)row[3 * x + 1] << 21) + ((ulong)row[3 * x + 2] << 42);
        upto[x + 1] = sum;
      }
      for (int w = 0; w < words; ++w)
      {
        outline[w] = besideEdge(mask, width, height, y, w);
      }
    }
    for (int run = row_first[y]; run < row_first[y] + row_runs[y]; ++run)
    {
      global RegionSums* record = records + slot_record[run_slot[run]];
      const int start = runs[2 * (size_t)run];
      const int end = runs[2 * (size_t)run + 1];
      const Moments m = runMoments(start, end, y);
      const ulong3 colors = measures != 0 ? channelSums(upto, start, end) : (ulong3)(0);
      ((global FirstSums*)record)->sums += (ulong8)(m.x, m.y, m.xx, m.xy, m.yy, colors.x, colors.y, colors.z);
      record->area += end - start;
      record->perimeter += measures != 0 ? bitsBetween(outline, start, end) : 0;
      record->min_x = min(record->min_x, start);
      record->max_x = max(record->max_x, end - 1);
      record->min_y = min(record->min_y, y);
      record->max_y = y;
    }
  }
}

/** Strips: adds the records of the slots that are no root to that of their root. One group a strip. */
kernel GROUP void reduceRecords(int width, int strip_rows, global const int* restrict strip_slots,
                                global const int* restrict parent, global const int* restrict slot_record,
                                global RegionSums* records, uint capacity, global const Counters* counters)
{
  if (counters->records > capacity)
  {
    return;
  }
  const int first = (int)get_group_id(0) * strip_rows * runsOf(width);
  const int end = first + strip_slots[get_group_id(0)];
  for (int slot = first + (int)get_local_id(0); slot < end; slot += LANES)
  {
    if (parent[slot] == slot)
    {
      continue;
    }
    const RegionSums part = records[slot_record[slot]];
    volatile global RegionSums* sums = records + slot_record[parent[slot]];
    add64(&sums->x, part.x);
    add64(&sums->y, part.y);
    add64(&sums->xx, part.xx);
    add64(&sums->xy, part.xy);
    add64(&sums->yy, part.yy);
    add64(&sums->blue, part.blue);
    add64(&sums->green, part.green);
    add64(&sums->red, part.red);
    atomic_add(&sums->area, part.area);
    atomic_add(&sums->perimeter, part.perimeter);
    widen(sums, part.min_x, part.min_y, part.max_x, part.max_y);
  }
}

/**
 * GPU: sums colours and perimeter of the run pieces in a word, and the moments of the runs that start in it, into the
 * records of the regions. One lane a word.
 *
 * @param measures 0: no colours and no perimeter
 */
kernel GROUP void sumWord(global const uchar* restrict image, long step, global const ulong* restrict mask, int width,
                          int height, int measures, global const ushort* restrict runs, global const int* restrict row_first,
                          global const ushort* restrict rank, global const int* restrict parent,
                          global const int* restrict slot_record, global RegionSums* records, uint capacity,
                          global const Counters* counters)
{
  const int words = wordsOf(width);
  const int w = (int)(get_global_id(0) % words);
  const long row_index = (long)(get_global_id(0) / words);
  if (row_index >= height || counters->records > capacity)
  {
    return;
  }
  const int y = (int)row_index;
  global const ulong* row = mask + (size_t)y * words;
  global const uchar* pixels = image + y * step + 192 * (long)w;
  const ulong starts = runStarts(row, w);
  const ulong outline = besideEdge(mask, width, height, y, w);
  int run = row_first[y] + rank[(size_t)y * words + w] - 1;
  ulong rest = row[w];
  while (rest != 0)
  {
    const int first = lowestBit(rest);
    const ulong gaps = ~(rest >> first);
    const int length = gaps == 0 ? 64 : lowestBit(gaps);
    const ulong piece = (length == 64 ? ~0UL : (1UL << length) - 1) << first;
    rest &= ~piece;
    const bool starting = ((starts >> first) & 1) != 0;
    run += starting ? 1 : 0;
    volatile global RegionSums* sums = records + slot_record[parent[run]];
    if (measures != 0)
    {
      uint blue = 0;
      uint green = 0;
      uint red = 0;
      for (int i = first; i < first + length; ++i)
      {
        blue += pixels[3 * i];
        green += pixels[3 * i + 1];
        red += pixels[3 * i + 2];
      }
      add64(&sums->blue, blue);
      add64(&sums->green, green);
      add64(&sums->red, red);
      const uint perimeter = (uint)popcount(outline & piece);
      if (perimeter != 0)
      {
        atomic_add(&sums->perimeter, perimeter);
      }
    }
    if (starting)
    {
      const int start = runs[2 * (size_t)run];
      const int end = runs[2 * (size_t)run + 1];
      const Moments moments = runMoments(start, end, y);
      add64(&sums->x, moments.x);
      add64(&sums->y, moments.y);
      add64(&sums->xx, moments.xx);
      add64(&sums->xy, moments.xy);
      add64(&sums->yy, moments.yy);
      atomic_add(&sums->area, (uint)(end - start));
      widen(sums, start, y, end - 1, y);
    }
  }
}
