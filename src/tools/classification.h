#ifndef OUTDOOR_OMR_TOOLS_CLASSIFICATION_H
#define OUTDOOR_OMR_TOOLS_CLASSIFICATION_H

#include <array>
#include <vector>

#include "outdoor_omr/marker_network.h"
#include "training_windows.h"

namespace omr
{
/** How a kind of marker is told from clutter at one threshold. */
struct Classification
{
  double threshold = 0;
  double recall = 0;      ///< share of the windows with a marker
  double false_rate = 0;  ///< share of the windows without

  /** As if there were as many windows with a marker as without. */
  double accuracy() const
  {
    return (recall + 1 - false_rate) / 2;
  }
  double precision() const
  {
    return recall + false_rate > 0 ? recall / (recall + false_rate) : 1;
  }
};

/** The scores of held-out windows, from which the curve of a kind follows. */
class ScoreCounts
{
 public:
  void add(WindowLabel label, const MarkerScores& scores);

  /** Windows without contrast: clutter without a score. */
  void addPlain(const WindowSet& windows);

  /** Of rising thresholds, -1 to 1. */
  std::vector<Classification> curve(MarkerKind kind) const;

  /** Number of windows. */
  double count(WindowLabel label) const;

 private:
  static constexpr int BINS = 2000;
  using Histogram = std::array<double, BINS + 1>;
  std::array<Histogram, MARKER_KINDS> markers_ = {};
  std::array<Histogram, MARKER_KINDS> clutter_ = {};
  double plain_clutter_ = 0;
  std::array<double, MARKER_KINDS> plain_markers_ = {};
};

}  // namespace omr

#endif
