// Second pass over the regions whose area is asked for: distances to the centre (paper, Table 1: mean size, mean
// radius) and the list that goes back to the host.

#include "geometry.cl"
#include "record.cl"

/** Sum of the distances of the pixels start .. end - 1 of a row to a point: dx to the first pixel, dy to the row [px].
 */
INLINE float runDistance(int length, float dx, float dy)
{
  const int16 ramp = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const float16 dy2 = (float16)(dy * dy);
  float16 x = (float16)dx + convert_float16(ramp);
  float16 sum = (float16)0;
  for (int i = 0; i < length; i += 16)
  {
    sum += (int16)(length - i) > ramp ? sqrt(x * x + dy2) : (float16)0;
    x += (float16)16;
  }
  const float8 sum8 = sum.lo + sum.hi;
  const float4 sum4 = sum8.lo + sum8.hi;
  return (sum4.x + sum4.y) + (sum4.z + sum4.w);
}

/** One group a row. The centre is taken relative to the bounding box: a float holds it to 1e-4 px even at 8K. */
kernel GROUP void sumDistances(global const ushort* restrict runs, global const int* restrict row_first,
                               global const int* restrict row_runs, global const int* restrict run_slot,
                               global const int* restrict parent, global const int* restrict slot_record, uint min_area,
                               uint max_area, global RegionSums* records, uint capacity,
                               global const Counters* counters)
{
  if (counters->records > capacity)
  {
    return;
  }
  const int y = get_group_id(0);
  const int end = row_first[y] + row_runs[y];
  for (int run = row_first[y] + (int)get_local_id(0); run < end; run += LANES)
  {
    global RegionSums* sums = records + slot_record[parent[run_slot[run]]];
    const ulong area = sums->area;
    if (area < min_area || area > max_area)
    {
      continue;
    }
    const float center_x = (float)(sums->x - area * sums->min_x) / area;
    const float center_y = (float)(sums->y - area * sums->min_y) / area;
    const int start = runs[2 * (size_t)run];
    const int length = runs[2 * (size_t)run + 1] - start;
    const float distance = runDistance(length, (float)(start - sums->min_x) - center_x, (y - sums->min_y) - center_y);
    add64(&sums->distance, (ulong)(distance * 4096.0f + 0.5f));
  }
}

/** Copies the records in the window of areas, in any order. One group a strip. */
kernel GROUP void reportRegions(int width, int strip_rows, global const int* restrict strip_slots,
                                global const int* restrict parent, global const int* restrict slot_record,
                                uint min_area, uint max_area, global const RegionSums* restrict records, uint capacity,
                                global RegionSums* restrict reported, uint reported_capacity,
                                volatile global Counters* counters)
{
  if (counters->records > capacity)
  {
    return;
  }
  const int first = (int)get_group_id(0) * strip_rows * runsOf(width);
  const int end = first + strip_slots[get_group_id(0)];
  for (int slot = first + (int)get_local_id(0); slot < end; slot += LANES)
  {
    if (parent[slot] != slot)
    {
      continue;
    }
    global const RegionSums* sums = records + slot_record[slot];
    if (sums->area >= min_area && sums->area <= max_area)
    {
      const uint place = atomic_inc(&counters->reported);
      if (place < reported_capacity)
      {
        reported[place] = *sums;
      }
    }
  }
}
