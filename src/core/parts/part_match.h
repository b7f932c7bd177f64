#ifndef OUTDOOR_OMR_CORE_PART_MATCH_H
#define OUTDOOR_OMR_CORE_PART_MATCH_H

#include <vector>

#include "outdoor_omr/camera.h"
#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/pose.h"
#include "outdoor_omr/target.h"
#include "part_hypothesis.h"

namespace omr
{
/** The markers of one image, and which of them are still to be given to a part. */
struct SeenMarkers
{
  const std::vector<Checkerboard>& checkerboards;
  const std::vector<Target>& targets;
  std::vector<bool> checkerboard_free;
  std::vector<bool> target_free;
};

/** A hypothesis together with the markers that bear it out. */
struct PartMatch
{
  const Part* part = nullptr;
  std::vector<Pose> poses;         ///< of all markers together; two where the flip is a rival; empty: none fits
  std::vector<int> checkerboards;  ///< indices, ascending
  std::vector<int> targets;        ///< indices, ascending
  int contradictions = 0;          ///< targets of other colours, boards a little off, where the part has them

  /** Markers beside the first board that speak for the part. */
  int supports() const;

  /** The same, less those that speak against it. */
  int score() const;
};

/**
 * Looks for the part's other markers where the hypothesis expects them and solves the pose of all together.
 *
 * @param seed index of the board that the hypothesis is of.
 */
PartMatch matchPart(const PartHypothesis& hypothesis, int seed, const SeenMarkers& seen, const Camera& camera);

}  // namespace omr

#endif
