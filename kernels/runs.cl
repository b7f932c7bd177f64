// Runs: the maximal horizontal rows of region pixels. Every run belongs to a slot, a node of the union-find; the strips
// of a CPU unite their own runs without atomics, so that a slot is a part of a region within one strip, whereas on a
// GPU every run is a slot. Runs and slots of strip s start at index s * strip_rows * runsOf(width): no prefix sum is
// needed and the order of the indices is the reading order.

#include "mask.cl"

/** Root of a run within its strip, compressing the path; one work-item owns the strip. */
INLINE int stripRoot(global int* run_slot, int run)
{
  int next = run_slot[run];
  while (next != run)
  {
    const int after = run_slot[next];
    run_slot[run] = after;
    run = next;
    next = after;
  }
  return run;
}

/**
 * CPU: finds the runs of a strip and unites those that touch. One group (of one lane) a strip.
 *
 * @param runs        start and end (exclusive) of every run
 * @param row_first   index of the first run of each row
 * @param row_runs    number of runs of each row
 * @param rank        number of runs of the row that start before each word
 * @param run_slot    slot of each run
 * @param parent      of each slot: itself
 * @param slot_label  index of the first pixel of each slot
 * @param strip_slots number of slots of each strip
 */
kernel GROUP void runsStrip(global const ulong* restrict mask, int width, int height, int strip_rows,
                            global ushort* restrict runs, global int* restrict row_first, global int* restrict row_runs,
                            global ushort* restrict rank, global int* restrict run_slot, global int* restrict parent,
                            global int* restrict slot_label, global int* restrict strip_slots)
{
  const int words = wordsOf(width);
  const int top = (int)get_group_id(0) * strip_rows;
  const int bottom = min(height, top + strip_rows);
  const int first_slot = top * runsOf(width);
  int first = first_slot;
  int first_above = 0;
  for (int y = top; y < bottom; ++y)
  {
    global const ulong* row = mask + (size_t)y * words;
    global ushort* row_rank = rank + (size_t)y * words;
    global ushort* ends = runs + 2 * (size_t)first;
    int count = 0;  // transitions so far: starts and ends take turns
    ulong before = 0;
    ulong above_before = 0;
    for (int w = 0; w < words; ++w)
    {
      const ulong word = row[w];
      const int started = (count + 1) >> 1;
      row_rank[w] = (ushort)started;
      ulong transitions = word ^ leftOf(word, before);
      const ulong starts = transitions & word;
      while (transitions != 0)
      {
        ends[count++] = (ushort)(64 * w + lowestBit(transitions));
        transitions &= transitions - 1;
      }
      for (int r = first + started; r < first + ((count + 1) >> 1); ++r)
      {
        run_slot[r] = r;
      }
      if (y > top)
      {
        const ulong above = row[w - words];
        const ulong both = word & above;
        ulong touching = both & ~leftOf(both, before & above_before);
        if (touching != 0)
        {
          const ulong starts_above = above & ~leftOf(above, above_before);
          const int run = first + started - 1;
          const int run_above = first_above + row_rank[w - words] - 1;
          while (touching != 0)
          {
            const ulong upto = touching ^ (touching - 1);
            const int a = stripRoot(run_slot, run_above + (int)popcount(starts_above & upto));
            const int b = stripRoot(run_slot, run + (int)popcount(starts & upto));
            run_slot[max(a, b)] = min(a, b);
            touching &= touching - 1;
          }
        }
        above_before = above;
      }
      before = word;
    }
    if (count & 1)
    {
      ends[count++] = (ushort)width;
    }
    row_first[y] = first;
    row_runs[y] = count >> 1;
    first_above = first;
    first += count >> 1;
  }
  // A parent has the smaller index, so it has become a slot already when its child is reached.
  int slot = first_slot;
  for (int y = top; y < bottom; ++y)
  {
    for (int r = row_first[y]; r < row_first[y] + row_runs[y]; ++r)
    {
      const int up = run_slot[r];
      if (up == r)
      {
        parent[slot] = slot;
        slot_label[slot] = y * width + runs[2 * (size_t)r];
        run_slot[r] = slot++;
      }
      else
      {
        run_slot[r] = run_slot[up];
      }
    }
  }
  strip_slots[get_group_id(0)] = slot - first_slot;
}

/** GPU: finds the runs of a row; every run is a slot of its own. One group a row; arguments as above, strips of a row.
 */
kernel GROUP void runsWord(global const ulong* restrict mask, int width, global ushort* restrict runs,
                           global int* restrict row_first, global int* restrict row_runs, global ushort* restrict rank,
                           global int* restrict run_slot, global int* restrict parent, global int* restrict slot_label,
                           global int* restrict strip_slots)
{
  local int counts[LANES];
  const int lane = get_local_id(0);
  const int y = get_group_id(0);
  const int words = wordsOf(width);
  const int first = y * runsOf(width);
  global const ulong* row = mask + (size_t)y * words;
  int started = 0;
  for (int base = 0; base < words; base += LANES)
  {
    const int w = base + lane;
    const int count = w < words ? (int)popcount(runStarts(row, w)) : 0;
    counts[lane] = count;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (int distance = 1; distance < LANES; distance *= 2)
    {
      const int left = lane >= distance ? counts[lane - distance] : 0;
      barrier(CLK_LOCAL_MEM_FENCE);
      counts[lane] += left;
      barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (w < words)
    {
      const int before = started + counts[lane] - count;
      rank[(size_t)y * words + w] = (ushort)before;
      int next = first + before;
      ulong transitions = row[w] ^ leftOf(row[w], w > 0 ? row[w - 1] : 0);
      while (transitions != 0)
      {
        const int bit = lowestBit(transitions);
        const int x = 64 * w + bit;
        if ((row[w] >> bit) & 1)
        {
          runs[2 * (size_t)next] = (ushort)x;
          run_slot[next] = parent[next] = next;
          slot_label[next] = y * width + x;
          ++next;
        }
        else
        {
          runs[2 * (size_t)next - 1] = (ushort)x;
        }
        transitions &= transitions - 1;
      }
      if (w == words - 1 && (row[w] >> 63) != 0)
      {
        runs[2 * (size_t)next - 1] = (ushort)width;
      }
    }
    started += counts[LANES - 1];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (lane == 0)
  {
    row_first[y] = first;
    row_runs[y] = strip_slots[y] = started;
  }
}
