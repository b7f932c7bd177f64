#include "classification.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace omr
{
Classification atPrecision(const std::vector<Classification>& curve, double precision, double share)
{
  auto chosen = curve.end() - 1;
  while (chosen != curve.begin() && (chosen - 1)->precision(share) >= precision)
  {
    --chosen;
  }
  return *chosen;
}

void ScoreCounts::add(WindowLabel label, const MarkerScores& scores)
{
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    const int bin = static_cast<int>(std::lround(std::clamp(scores[kind] * .5F + .5F, 0.F, 1.F) * BINS));
    if (label == WindowLabel::clutter)
    {
      clutter_[kind][bin] += 1;
    }
    else if (static_cast<int>(label) == kind)
    {
      markers_[kind][bin] += 1;
    }
  }
}

void ScoreCounts::addPlain(const WindowSet& windows)
{
  plain_clutter_ += static_cast<double>(windows.plain_clutter);
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    plain_markers_[kind] += static_cast<double>(windows.plain_markers[kind]);
  }
}

std::vector<Classification> ScoreCounts::curve(MarkerKind kind) const
{
  const int k = static_cast<int>(kind);
  const double markers = count(static_cast<WindowLabel>(k));
  const double clutter = count(WindowLabel::clutter);
  std::vector<Classification> curve(BINS);
  double found = 0;
  double wrong = 0;
  for (int bin = BINS; bin > 0; --bin)
  {
    found += markers_[k][bin];
    wrong += clutter_[k][bin];
    curve[bin - 1] = {2 * (bin - .5) / BINS - 1, markers > 0 ? found / markers : 0, clutter > 0 ? wrong / clutter : 0};
  }
  return curve;
}

double ScoreCounts::count(WindowLabel label) const
{
  const auto sum = [](const Histogram& counts) { return std::accumulate(counts.begin(), counts.end(), 0.); };
  const int kind = static_cast<int>(label);
  return label == WindowLabel::clutter ? sum(clutter_[0]) + plain_clutter_ : sum(markers_[kind]) + plain_markers_[kind];
}

}  // namespace omr
