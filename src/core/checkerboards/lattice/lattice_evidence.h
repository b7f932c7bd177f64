#ifndef OUTDOOR_OMR_CORE_LATTICE_EVIDENCE_H
#define OUTDOOR_OMR_CORE_LATTICE_EVIDENCE_H

#include "lattice.h"

namespace omr
{
/** How much speaks for a board, and against clutter that happens to alternate. */
struct Evidence
{
  float fill = 0;         ///< found corners per node of the box
  float correlation = 0;  ///< median of the corners
  float unevenness = 0;   ///< median third difference of the positions [squares], see latticeEvidence();
                          ///< infinite where no corners lie so that one is known

  /** Sum of the three shortfalls, each in units of what boards hardly reach; see MAX_DOUBT. */
  float doubt() const;
};

/**
 * Third differences vanish on what perspective, lens and curved plate do to neighbouring squares, where second
 * differences do not (a 180 degree fisheye has 0.26 squares); they are scaled to the noise of a second difference.
 */
Evidence latticeEvidence(const Lattice& lattice);

}  // namespace omr

#endif
