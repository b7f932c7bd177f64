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

  /** As if a share of all windows showed a marker. Where it is small the many others weigh: accuracy is high without a
   * single marker found, and precision low with few false ones. */
  double accuracy(double share = .5) const
  {
    return share * recall + (1 - share) * (1 - false_rate);
  }
  double precision(double share = .5) const
  {
    const double right = share * recall;
    const double wrong = (1 - share) * false_rate;
    return right + wrong > 0 ? right / (right + wrong) : 1;
  }
};

/** The smallest threshold of a curve from which on the precision holds where a share of all windows shows a marker; the
 * largest one if none does. */
Classification atPrecision(const std::vector<Classification>& curve, double precision, double share = .5);

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
