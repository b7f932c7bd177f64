// Second pass over the regions whose area is asked for: distances to the centre (paper, Table 1: mean size, mean
// radius) and the list that goes back to the host.

#include "geometry.cl"
#include "record.cl"

/** Sum of the distances of the pixels start .. end - 1 of a row to a point: dx to the first pixel, dy to the row [px].
 */
INLINE float runDistance(int length, float dx, float dy)
{
  const int8 ramp = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  const float8 dy2 = (float8)(dy * dy);
  float8 x = (float8)dx + convert_float8(ramp);
  float8 sum = (float8)0;
  for (int i = 0; i < length; i += 8)
  {
    sum += (int8)(length - i) > ramp ? sqrt(x * x + dy2) : (float8)0;
    x += (float8)8;
  }
  const float4 sum4 = sum.lo + sum.hi;
  return (sum4.x + sum4.y) + (sum4.z + sum4.w);
}

/**
 * Sum of the distances of a run's pixels to the centre of its region [1/4096 px]; 0 where the area is not asked for. The
 * centre is taken relative to the bounding box: a float holds it to 6e-4 px even at 8K.
 */
INLINE ulong distanceToCentre(global const RegionSums* region, uint min_area, uint max_area, int start, int end, int y)
{
  const ulong area = region->area;
  if (area < min_area || area > max_area)
  {
    return 0;
  }
  const float share = 1.0f / area;
  const float center_x = (float)(region->x - area * region->min_x) * share;
  const float center_y = (float)(region->y - area * region->min_y) * share;
  const float dx = (float)(start - region->min_x) - center_x;
  const float dy = (float)(y - region->min_y) - center_y;
  const float distance = end == start + 1 ? sqrt(dx * dx + dy * dy) : runDistance(end - start, dx, dy);
  return (ulong)(distance * 4096.0f + 0.5f);
}

/** Strips: adds the distances up in the slots' own records, without atomics. One group a strip. */
kernel GROUP void sumDistancesStrip(int height, int strip_rows, global const ushort* restrict runs,
                                    global const int* restrict row_first, global const int* restrict row_runs,
                                    global const int* restrict run_slot, global const int* restrict parent,
                                    global const int* restrict slot_record, uint min_area, uint max_area,
                                    global RegionSums* records, uint capacity, global const Counters* counters)
{
  if (counters->records > capacity)
  {
    return;
  }
  const int top = (int)get_group_id(0) * strip_rows;
  for (int y = top; y < min(height, top + strip_rows); ++y)
  {
    for (int run = row_first[y]; run < row_first[y] + row_runs[y]; ++run)
    {
      const int slot = run_slot[run];
      const int start = runs[2 * (size_t)run];
      const int end = runs[2 * (size_t)run + 1];
      records[slot_record[slot]].distance +=
          distanceToCentre(records + slot_record[parent[slot]], min_area, max_area, start, end, y);
    }
  }
}

/** Strips: adds the distances of the slots that are no root to those of their root. One group a strip. */
kernel GROUP void reduceDistances(int width, int strip_rows, global const int* restrict strip_slots,
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
    const ulong distance = records[slot_record[slot]].distance;
    if (parent[slot] != slot && distance != 0)
    {
      add64(&records[slot_record[parent[slot]]].distance, distance);
    }
  }
}

/** GPU: adds the distances of every run to the region's. One group a row. */
kernel GROUP void sumDistancesWord(global const ushort* restrict runs, global const int* restrict row_first,
                                   global const int* restrict row_runs, global const int* restrict parent,
                                   global const int* restrict slot_record, uint min_area, uint max_area,
                                   global RegionSums* records, uint capacity, global const Counters* counters)
{
  if (counters->records > capacity)
  {
    return;
  }
  const int y = get_group_id(0);
  const int last = row_first[y] + row_runs[y];
  for (int run = row_first[y] + (int)get_local_id(0); run < last; run += LANES)
  {
    global RegionSums* region = records + slot_record[parent[run]];
    const int start = runs[2 * (size_t)run];
    const int end = runs[2 * (size_t)run + 1];
    const ulong distance = distanceToCentre(region, min_area, max_area, start, end, y);
    if (distance != 0)
    {
      add64(&region->distance, distance);
    }
  }
}

/** Whether a slot is the root of a region in the window of areas. */
INLINE bool isReported(global const int* parent, global const int* slot_record, global const RegionSums* records,
                       uint min_area, uint max_area, int slot)
{
  if (parent[slot] != slot)
  {
    return false;
  }
  const uint area = records[slot_record[slot]].area;
  return area >= min_area && area <= max_area;
}

/** Counts the regions in the window of areas whose root lies in a strip. One group a strip. */
kernel GROUP void countReports(int width, int strip_rows, global const int* restrict strip_slots,
                               global const int* restrict parent, global const int* restrict slot_record, uint min_area,
                               uint max_area, global const RegionSums* restrict records, uint capacity,
                               global const Counters* counters, global uint* restrict strip_reports)
{
  local uint count;
  if (get_local_id(0) == 0)
  {
    count = 0;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (counters->records <= capacity)
  {
    const int first = (int)get_group_id(0) * strip_rows * runsOf(width);
    const int end = first + strip_slots[get_group_id(0)];
    uint own = 0;
    for (int slot = first + (int)get_local_id(0); slot < end; slot += LANES)
    {
      own += isReported(parent, slot_record, records, min_area, max_area, slot) ? 1 : 0;
    }
    atomic_add(&count, own);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) == 0)
  {
    strip_reports[get_group_id(0)] = count;
  }
}

/**
 * Copies the records in the window of areas in the order of their slots, which is that of their labels: the host need
 * not sort them. One group a strip; where there is no room, nothing is written and the host grows the buffer.
 */
kernel GROUP void reportRegions(int width, int strip_rows, global const int* restrict strip_slots,
                                global const int* restrict parent, global const int* restrict slot_record,
                                uint min_area, uint max_area, global const RegionSums* restrict records,
                                global const uint* restrict strip_reports, global RegionSums* restrict reported,
                                uint reported_capacity, global Counters* counters)
{
  local uint place;
  local uint flags[LANES];
  const int strip = get_group_id(0);
  const int lane = get_local_id(0);
  if (lane == 0)
  {
    place = 0;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  uint before = 0;
  for (int s = lane; s < strip; s += LANES)
  {
    before += strip_reports[s];
  }
  atomic_add(&place, before);
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint count = strip_reports[strip];
  if (strip + 1 == (int)get_num_groups(0) && lane == 0)
  {
    counters->reported = place + count;
  }
  if (count == 0 || place + count > reported_capacity)
  {
    return;  // the whole group: count and place are the same for all lanes
  }
  const int first = strip * strip_rows * runsOf(width);
  const int end = first + strip_slots[strip];
  uint next = place;
  for (int base = first; base < end; base += LANES)
  {
    const int slot = base + lane;
    const bool wanted = slot < end && isReported(parent, slot_record, records, min_area, max_area, slot);
    flags[lane] = wanted ? 1 : 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    uint rank = 0;
    uint all = 0;
    for (int i = 0; i < LANES; ++i)
    {
      rank += i < lane ? flags[i] : 0;
      all += flags[i];
    }
    if (wanted)
    {
      reported[next + rank] = records[slot_record[slot]];
    }
    next += all;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
}
