#ifndef OUTDOOR_OMR_CORE_ANGLE_BINS_H
#define OUTDOOR_OMR_CORE_ANGLE_BINS_H

#include <cstdint>

namespace omr
{
/** Directions into which angular support is divided: bin i is centred on 2 pi (i + 1/2) / 64 on the plane. */
constexpr int ANGLE_BINS = 64;

/** One bit per direction. */
using AngleBins = std::uint64_t;

/** How many directions. */
inline int countOf(AngleBins bins)
{
  return __builtin_popcountll(bins);
}

/** Share of the directions [0, 1]. */
double share(AngleBins bins);

/** The directions turned by some. @param by [0, ANGLE_BINS) */
AngleBins turned(AngleBins bins, int by);

/** How far the directions lie to one side: 0 where they are evenly spread, .64 in half of the turn [0, 1]. */
double onesidedness(AngleBins bins);

/** Widest run of other directions [share of a turn]. */
double widestGap(AngleBins bins);

/** Longest run of directions, of which single ones may be missing [directions]. */
int longestRun(AngleBins bins);

}  // namespace omr

#endif
