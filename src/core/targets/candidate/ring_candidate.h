#ifndef OUTDOOR_OMR_CORE_RING_CANDIDATE_H
#define OUTDOOR_OMR_CORE_RING_CANDIDATE_H

#include <memory>
#include <vector>

#include "ring_growth.h"
#include "targets/boundaries/ring_boundaries.h"
#include "targets/boundaries/ring_profile.h"
#include "targets/seeds/ring_seeds.h"

namespace omr
{
/** What may be a target, with the evidence for it. */
struct RingCandidate
{
  cv::Size image_size;
  Rings rings;
  std::vector<Boundary> boundaries;            ///< one per radius of rings; fewer once readLetters() changed them
  int ring_count = 0;                          ///< of them, that were found without assuming equal rings
  std::shared_ptr<const RingProfile> profile;  ///< of the final family; half a megabyte, which copies share
  bool is_merged = false;     ///< two boundaries of narrow rings, which are a target if inks tell that they are more
  bool is_certain = false;    ///< of the letters of the rings that show, as readLetters() found: no mixture is
  bool is_explained = false;  ///< by inks, as readLetters() found: then the blur hides no narrow ring
  int profile_scale = 1;      ///< pixels of the profile a pixel of the image: small rings are looked at enlarged
  double visible = 0;         ///< share of the directions in which at least half of the boundaries show [0, 1]
  double evidence = 0;  ///< how completely the boundaries show there: mean of coherence x (agreement, support) [0, 1]
};

/** Directions in which at least half of the boundaries show: an occluder hides several rings at once. */
AngleBins visibleDirections(const std::vector<Boundary>& boundaries);

/** Sets visible and evidence as the boundaries have them. */
void weighEvidence(RingCandidate& candidate);

/**
 * Grows a seed to a candidate: edgels give the family, the profile then says which boundaries there are.
 *
 * @param is_boundary the seed's radius is that of a boundary; else only how far to look.
 * @return            false if there are no two boundaries.
 */
bool growCandidate(EdgelMap& map, const cv::Mat& bgr, const RingSeed& seed, bool is_boundary, RingCandidate& candidate);

/**
 * The same from a family of which some boundaries are known.
 *
 * @param radii of those, ascending, at least one [px].
 */
bool growCandidate(EdgelMap& map, const cv::Mat& bgr, const RingFamily& family, const std::vector<double>& radii,
                   RingCandidate& candidate);

}  // namespace omr

#endif
