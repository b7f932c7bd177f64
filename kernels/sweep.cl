// The paper's parallel filling (section 3.2): every pixel starts with its own index; sweeps to the right, left, down
// and up hand the smaller index on, within regions, until nothing changes. One lane a row or a column. The rows and
// columns of one launch are independent, so the result of each round is, too.

#include "mask.cl"
#include "record.cl"

/** Every pixel gets its own index. One group a row. */
kernel GROUP void sweepInit(int width, global int* restrict labels)
{
  const int y = get_group_id(0);
  for (int x = get_local_id(0); x < width; x += LANES)
  {
    labels[(size_t)y * width + x] = y * width + x;
  }
}

INLINE bool isRegion(global const ulong* mask, int words, int x, int y)
{
  return ((mask[(size_t)y * words + (x >> 6)] >> (x & 63)) & 1) != 0;
}

/** Hands the label of the previous pixel on to this one; *previous = INT_MAX stands for an edge. */
INLINE bool handOn(bool region, global int* label, int* previous)
{
  if (!region)
  {
    *previous = INT_MAX;
    return false;
  }
  const int own = *label;
  const bool smaller = *previous < own;
  if (smaller)
  {
    *label = *previous;
  }
  *previous = min(own, *previous);
  return smaller;
}

/** To the right, then to the left. */
kernel GROUP void sweepRows(global const ulong* restrict mask, int width, int height, global int* restrict labels,
                            volatile global Counters* counters)
{
  const int y = get_global_id(0);
  if (y >= height)
  {
    return;
  }
  const int words = wordsOf(width);
  global int* row = labels + (size_t)y * width;
  bool changed = false;
  int previous = INT_MAX;
  for (int x = 0; x < width; ++x)
  {
    changed |= handOn(isRegion(mask, words, x, y), row + x, &previous);
  }
  previous = INT_MAX;
  for (int x = width - 1; x >= 0; --x)
  {
    changed |= handOn(isRegion(mask, words, x, y), row + x, &previous);
  }
  if (changed)
  {
    atomic_or(&counters->changed, 1u);
  }
}

/** Down, then up. */
kernel GROUP void sweepColumns(global const ulong* restrict mask, int width, int height, global int* restrict labels,
                               volatile global Counters* counters)
{
  const int x = get_global_id(0);
  if (x >= width)
  {
    return;
  }
  const int words = wordsOf(width);
  bool changed = false;
  int previous = INT_MAX;
  for (int y = 0; y < height; ++y)
  {
    changed |= handOn(isRegion(mask, words, x, y), labels + (size_t)y * width + x, &previous);
  }
  previous = INT_MAX;
  for (int y = height - 1; y >= 0; --y)
  {
    changed |= handOn(isRegion(mask, words, x, y), labels + (size_t)y * width + x, &previous);
  }
  if (changed)
  {
    atomic_or(&counters->changed, 1u);
  }
}

/** Brings the settled labels into the union-find: every run points to the run that its label lies in. One group a row.
 */
kernel GROUP void adoptLabels(global const ulong* restrict mask, int width, global const int* restrict labels,
                              global const ushort* restrict runs, global const int* restrict row_first,
                              global const int* restrict row_runs, global const ushort* restrict rank,
                              global int* restrict parent)
{
  const int y = get_group_id(0);
  const int words = wordsOf(width);
  const int end = row_first[y] + row_runs[y];
  for (int run = row_first[y] + (int)get_local_id(0); run < end; run += LANES)
  {
    const int label = labels[(size_t)y * width + runs[2 * (size_t)run]];
    const int root_y = label / width;
    const int root_x = label % width;
    const int w = root_x >> 6;
    global const ulong* row = mask + (size_t)root_y * words;
    const ulong starts = runStarts(row, w) & (~0UL >> (63 - (root_x & 63)));
    parent[run] = row_first[root_y] + rank[(size_t)root_y * words + w] + (int)popcount(starts) - 1;
  }
}
