// The label image: the smallest pixel index of the region; an edge pixel keeps its own index. One group a row.

#include "mask.cl"

/** 8 labels at any address in one store. */
typedef struct __attribute__((packed))
{
  int8 labels;
} Labels8;

/** Writes value, value + slope, ... to pixels x .. end - 1; may overshoot within the row, which is written left to
 * right. */
INLINE void fillPixels(global int* row, int width, int x, int end, int value, int slope)
{
  int8 values = (int8)value + (int8)slope * (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  for (; x < end && x <= width - 8; x += 8)
  {
    ((global Labels8*)(row + x))->labels = values;
    values += (int8)(8 * slope);
    value += 8 * slope;
  }
  for (; x < end; ++x)
  {
    row[x] = value;
    value += slope;
  }
}

/** CPU: run by run. */
kernel GROUP void labelsByRuns(int width, global const ushort* restrict runs, global const int* restrict row_first,
                               global const int* restrict row_runs, global const int* restrict run_slot,
                               global const int* restrict parent, global const int* restrict slot_label,
                               global int* restrict labels)
{
  const int y = get_group_id(0);
  const int row_start = y * width;
  global int* row = labels + row_start;
  int x = 0;
  for (int run = row_first[y]; run < row_first[y] + row_runs[y]; ++run)
  {
    const int start = runs[2 * (size_t)run];
    const int end = runs[2 * (size_t)run + 1];
    fillPixels(row, width, x, start, row_start + x, 1);
    fillPixels(row, width, start, end, slot_label[parent[run_slot[run]]], 0);
    x = end;
  }
  fillPixels(row, width, x, width, row_start + x, 1);
}

/** GPU: pixel by pixel; the rank of a pixel's run comes from a bit count. */
kernel GROUP void labelsByPixels(global const ulong* restrict mask, int width, global const int* restrict row_first,
                                 global const ushort* restrict rank, global const int* restrict run_slot,
                                 global const int* restrict parent, global const int* restrict slot_label,
                                 global int* restrict labels)
{
  const int y = get_group_id(0);
  const int words = wordsOf(width);
  global const ulong* row = mask + (size_t)y * words;
  for (int x = get_local_id(0); x < width; x += LANES)
  {
    const int w = x >> 6;
    int label = y * width + x;
    if ((row[w] >> (x & 63)) & 1)
    {
      const ulong starts = runStarts(row, w) & (~0UL >> (63 - (x & 63)));
      const int run = row_first[y] + rank[(size_t)y * words + w] + (int)popcount(starts) - 1;
      label = slot_label[parent[run_slot[run]]];
    }
    labels[(size_t)y * width + x] = label;
  }
}
