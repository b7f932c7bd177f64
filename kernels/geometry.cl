// How the work is cut. Every kernel is launched in work-groups of LANES lanes. The lanes of a group share a row, a strip
// of rows, a tile or a list and walk it with the stride LANES; where each takes a word or a row of its own, the kernel
// says so. A CPU gets LANES = 1 and runs plain loops (PoCL:
// a group costs 4 ns, its own work-item loop vectorises byte kernels 10 to 40 times worse than a loop over the row); a
// GPU gets LANES = 64, a wavefront.

#ifndef OUTDOOR_OMR_GEOMETRY_CL
#define OUTDOOR_OMR_GEOMETRY_CL

#ifndef LANES
#define LANES 64
#endif

/** Functions are inlined always: a call in a row loop keeps PoCL from vectorising it. */
#define INLINE static inline __attribute__((always_inline))

#define GROUP __attribute__((reqd_work_group_size(LANES, 1, 1)))

/** Words of 64 pixels in a row of the region mask. */
INLINE int wordsOf(int width)
{
  return (width + 63) / 64;
}

/** Largest number of runs in a row: they are at least one pixel apart. */
INLINE int runsOf(int width)
{
  return (width + 1) / 2;
}

#endif
