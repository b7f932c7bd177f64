// Lock-free union-find over the slots of one image. The smaller index is the root, so that the root of a region is its
// first run in reading order. Work-groups never wait for each other: a lost race repeats an atomic_min, no more.

#ifndef OUTDOOR_OMR_UNION_FIND_CL
#define OUTDOOR_OMR_UNION_FIND_CL

#include "geometry.cl"

/** Root of a slot; reads only. */
INLINE int rootOf(volatile global const int* parent, int slot)
{
  int next;
  while ((next = parent[slot]) != slot)
  {
    slot = next;
  }
  return slot;
}

/**
 * Root of a slot, halving the path on the way. It stores only ancestors, and only into slots that are no root: the race
 * with another work-item is benign. Without it a spiral takes four times as long.
 */
INLINE int rootHalving(volatile global int* parent, int slot)
{
  int next = parent[slot];
  while (next != slot)
  {
    const int after = parent[next];
    if (after != next)
    {
      parent[slot] = after;
    }
    slot = next;
    next = after;
  }
  return slot;
}

INLINE void unite(volatile global int* parent, int a, int b)
{
  while (true)
  {
    a = rootHalving(parent, a);
    b = rootHalving(parent, b);
    if (a == b)
    {
      return;
    }
    const int high = max(a, b);
    const int low = min(a, b);
    const int seen = atomic_min(&parent[high], low);
    if (seen == high)
    {
      return;
    }
    a = seen;  // high was no root any more: what it pointed to must join low as well
    b = low;
  }
}

#endif
