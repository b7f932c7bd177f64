// The exact integer record of a region: the same bytes as RegionSums in include/outdoor_omr/region.h.

#ifndef OUTDOOR_OMR_RECORD_CL
#define OUTDOOR_OMR_RECORD_CL

#include "geometry.cl"

typedef struct
{
  ulong x, y, xx, xy, yy;
  ulong blue, green, red;
  ulong distance;
  int label;
  uint area;
  uint perimeter;
  int min_x, min_y, max_x, max_y;
  uint reserved;
} RegionSums;

/** The counters of one image, shared with src/gpu/fill_buffers.h. */
typedef struct
{
  uint records;   // records that the image needs; beyond the capacity nothing is summed and the host grows the buffer
  uint regions;   // all regions
  uint reported;  // regions in the window of areas
  uint changed;   // set by a round of sweeps that changed a label
} Counters;

/** The eight sums at the start of a record as one vector. */
typedef struct __attribute__((packed))
{
  ulong8 sums;
} FirstSums;

INLINE RegionSums emptyRecord(int label)
{
  const RegionSums record = {0, 0, 0, 0, 0, 0, 0, 0, 0, label, 0, 0, INT_MAX, INT_MAX, -1, -1, 0};
  return record;
}

/** Atomic 64-bit addition in two halves with carry: OpenCL 1.2 promises 32-bit atomics only (little-endian device). */
INLINE void add64(volatile global ulong* sum, ulong value)
{
  volatile global uint* halves = (volatile global uint*)sum;
  const uint low = (uint)value;
  const uint before = atomic_add(halves, low);
  const uint high = (uint)(value >> 32) + (before + low < before ? 1 : 0);
  if (high != 0)
  {
    atomic_add(halves + 1, high);
  }
}

/** Widens a bounding box; reads first, since most calls change nothing and the atomics of a large region collide. */
INLINE void widen(volatile global RegionSums* record, int min_x, int min_y, int max_x, int max_y)
{
  if (min_x < record->min_x)
  {
    atomic_min(&record->min_x, min_x);
  }
  if (min_y < record->min_y)
  {
    atomic_min(&record->min_y, min_y);
  }
  if (max_x > record->max_x)
  {
    atomic_max(&record->max_x, max_x);
  }
  if (max_y > record->max_y)
  {
    atomic_max(&record->max_y, max_y);
  }
}

/** Sum of the whole numbers start .. end - 1. */
INLINE ulong sumOf(uint start, uint end)
{
  return (ulong)(end - start) * (start + end - 1) / 2;
}

/** Sum of the squares of the whole numbers start .. end - 1. */
INLINE ulong squaresOf(ulong start, ulong end)
{
  const ulong n = end - start;
  return n * start * start + start * n * (n - 1) + (n - 1) * n * (2 * n - 1) / 6;
}

#endif
