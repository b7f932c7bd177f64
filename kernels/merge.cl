// Unites the slots of touching runs across the seams between strips (on a GPU: between all rows), then makes every slot
// point to the root of its region.

#include "mask.cl"
#include "record.cl"
#include "union_find.cl"

/**
 * One lane a word of a row that starts a strip (the first strip has no seam).
 *
 * @param strip_rows distance of the seams
 */
kernel GROUP void mergeSeams(global const ulong* restrict mask, int width, int height, int strip_rows,
                             global const int* restrict row_first, global const ushort* restrict rank,
                             global const int* restrict run_slot, volatile global int* parent)
{
  const int words = wordsOf(width);
  const int w = (int)(get_global_id(0) % words);
  const long y = (long)(get_global_id(0) / words + 1) * strip_rows;
  if (y >= height)
  {
    return;
  }
  global const ulong* row = mask + (size_t)y * words;
  global const ulong* above = row - words;
  ulong touching = contacts(row, above, w);
  if (touching == 0)
  {
    return;
  }
  const ulong starts = runStarts(row, w);
  const ulong starts_above = runStarts(above, w);
  global const ushort* row_rank = rank + (size_t)y * words;
  const int run = row_first[y] + row_rank[w] - 1;
  const int run_above = row_first[y - 1] + row_rank[w - words] - 1;
  while (touching != 0)
  {
    const ulong upto = touching ^ (touching - 1);
    unite(parent, run_slot[run_above + (int)popcount(starts_above & upto)],
          run_slot[run + (int)popcount(starts & upto)]);
    touching &= touching - 1;
  }
}

/**
 * Flattens the trees and gives records: one group a strip.
 *
 * @param every_slot  1: every slot sums into a record of its own, which reduceRecords() adds up (strips); 0: only roots
 * @param slot_record receives the index of the slot's record
 * @param capacity    of records
 */
kernel GROUP void findRegions(int width, int strip_rows, global const int* restrict strip_slots,
                              volatile global int* parent, global const int* restrict slot_label, int every_slot,
                              global int* restrict slot_record, global RegionSums* restrict records, uint capacity,
                              volatile global Counters* counters)
{
  const int first = (int)get_group_id(0) * strip_rows * runsOf(width);
  const int end = first + strip_slots[get_group_id(0)];
  uint regions = 0;
  uint needed = 0;
  for (int slot = first + (int)get_local_id(0); slot < end; slot += LANES)
  {
    const int root = rootOf(parent, slot);
    parent[slot] = root;
    regions += root == slot ? 1 : 0;
    needed += every_slot || root == slot ? 1 : 0;
  }
  if (needed == 0)
  {
    return;
  }
  atomic_add(&counters->regions, regions);
  uint record = atomic_add(&counters->records, needed);
  for (int slot = first + (int)get_local_id(0); slot < end; slot += LANES)
  {
    if (every_slot || parent[slot] == slot)
    {
      slot_record[slot] = (int)record;
      if (record < capacity)
      {
        records[record] = emptyRecord(slot_label[slot]);
      }
      ++record;
    }
  }
}
