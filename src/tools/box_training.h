#ifndef OUTDOOR_OMR_TOOLS_BOX_TRAINING_H
#define OUTDOOR_OMR_TOOLS_BOX_TRAINING_H

#include <array>
#include <vector>

#include "outdoor_omr/candidates.h"
#include "training_pictures.h"

namespace omr
{
/** A box that the network gives, and whether a marker of its kind is there. */
struct LabelledBox
{
  std::array<float, BOX_FEATURES> features;
  MarkerKind kind;
  bool marker;         ///< if not, no marker of any kind is there
  bool among_markers;  ///< the picture shows markers
};

/** The boxes of all pictures, but for those that show a marker partly or one of the other kind. */
std::vector<LabelledBox> labelledBoxes(const TrainingPictures& pictures, unsigned seed, const MarkerNetwork& network);

/** The weights for which the boxes of a kind are most probable (logistic regression). */
std::array<float, BOX_FEATURES + 1> learnEvidence(const std::vector<LabelledBox>& boxes, MarkerKind kind);

/** The evidence that so many boxes a picture without markers have. @param pictures number of these. */
float evidenceOfFalse(const std::vector<LabelledBox>& boxes, const MarkerNetwork& network, int pictures, double rate);

/** Share of the boxes with a marker that have the evidence. */
double shareOfMarkers(const std::vector<LabelledBox>& boxes, const MarkerNetwork& network, MarkerKind kind,
                      float evidence);

}  // namespace omr

#endif
