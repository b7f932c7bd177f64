#ifndef OUTDOOR_OMR_TOOLS_MARKER_TRAINING_H
#define OUTDOOR_OMR_TOOLS_MARKER_TRAINING_H

#include "outdoor_omr/marker_network.h"
#include "training_pictures.h"

namespace omr
{
struct TrainingOptions
{
  int hidden = 128;
  int gate = 16;    ///< units of the gate
  int epochs = 12;  ///< passes over the windows in the last training; a third in those before
  int rounds = 2;   ///< trainings; after each, hard clutter is added
  unsigned seed = 1;
};

/** A network with its gate that tells the windows of pictures; it has no thresholds yet. Says on standard output what
 * it learns from. */
MarkerNetwork trainMarkerNetwork(const TrainingPictures& pictures, const TrainingOptions& options);

/** The thresholds at which the gate loses a share of the windows of each kind. */
MarkerScores gateThresholds(const FeedForward& gate, const WindowSet& windows, double lost);

}  // namespace omr

#endif
