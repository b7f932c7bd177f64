#ifndef OUTDOOR_OMR_MARKERS_H
#define OUTDOOR_OMR_MARKERS_H

#include <vector>

#include "outdoor_omr/candidates.h"
#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/step_time.h"
#include "outdoor_omr/target.h"

namespace omr
{
/** All markers of one image. */
struct Markers
{
  std::vector<Checkerboard> checkerboards;
  std::vector<Checkerboard> sections;  ///< of boards hidden in part, of unknown size: see findCheckerboards()
  std::vector<Target> targets;
  std::vector<Candidate> candidates;  ///< empty unless Settings::candidate_mode asks for them
  std::vector<StepTime> times;        ///< in the order of the steps
};

}  // namespace omr

#endif
