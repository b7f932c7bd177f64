#ifndef OUTDOOR_OMR_CORE_NARROW_RINGS_H
#define OUTDOOR_OMR_CORE_NARROW_RINGS_H

#include <string>
#include <vector>

#include "ink_rest.h"
#include "targets/boundaries/ring_profile.h"

namespace omr
{
/** Rings of the key's inks that explain what is seen. */
struct NarrowRings
{
  std::vector<double> radii;  ///< of the boundaries, ascending [px]
  std::string letters;        ///< of the key; '?' where another explains it nearly as well, or none does
  std::vector<double> rests;  ///< of each ring, what its ink leaves that any colour in its place would not
};

/**
 * Reads rings so narrow that the blur of lens, colour filter and JPEG merges them. What the blur leaves open - a ring
 * of double width may be two, what looks like a ring the mixture of its neighbours - the inks tell.
 *
 * @param found radii of the boundaries that were found, ascending, not empty [px].
 * @param scale pixels of the profile a pixel of the camera.
 * @param ground on which they lie.
 * @param rings receives the result.
 * @return      false if no inks explain what is seen, or rings of two different numbers do.
 */
bool readNarrowRings(const RingProfile& profile, const std::vector<double>& found, double scale, Ground ground,
                     NarrowRings& rings);

}  // namespace omr

#endif
