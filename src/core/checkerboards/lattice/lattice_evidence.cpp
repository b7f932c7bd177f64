#include "lattice_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "median.h"

namespace omr
{
float Evidence::doubt() const
{
  return (1 - correlation) / 0.05F + unevenness / 0.15F + (1 - fill) / 0.4F;
}

Evidence latticeEvidence(const Lattice& lattice)
{
  Evidence evidence;
  std::vector<float> correlations;
  std::vector<float> unevenness;
  // Third differences as sums of four or six nodes; the scale brings their noise to that of a second difference.
  const auto difference = [&](int i, int j, int di, int dj, int ei, int ej) {
    // d d e: the second difference along d, of two lines one step e apart.
    const bool all = lattice.found(i - di, j - dj) && lattice.found(i, j) && lattice.found(i + di, j + dj) &&
                     lattice.found(i - di + ei, j - dj + ej) && lattice.found(i + ei, j + ej) &&
                     lattice.found(i + di + ei, j + dj + ej);
    if (!all)
    {
      return;
    }
    const cv::Point2f here =
        lattice.at(i - di, j - dj).position - 2 * lattice.at(i, j).position + lattice.at(i + di, j + dj).position;
    const cv::Point2f there = lattice.at(i - di + ei, j - dj + ej).position - 2 * lattice.at(i + ei, j + ej).position +
                              lattice.at(i + di + ei, j + dj + ej).position;
    const float step = length(lattice.at(i + di, j + dj).position - lattice.at(i - di, j - dj).position) / 2;
    const float noise = std::sqrt(di == ei ? 20.F / 6 : 2.F);
    unevenness.push_back(length(there - here) / (noise * std::max(step, 1e-3F)));
  };
  for (int i = lattice.box.y; i < lattice.box.br().y; ++i)
  {
    for (int j = lattice.box.x; j < lattice.box.br().x; ++j)
    {
      if (lattice.found(i, j))
      {
        correlations.push_back(lattice.at(i, j).correlation);
        difference(i, j, 0, 1, 0, 1);
        difference(i, j, 1, 0, 1, 0);
        difference(i, j, 0, 1, 1, 0);
        difference(i, j, 1, 0, 0, 1);
      }
    }
  }
  evidence.fill = static_cast<float>(lattice.count()) / static_cast<float>(std::max(1, lattice.box.area()));
  evidence.correlation = correlations.empty() ? 0 : median(std::move(correlations));
  evidence.unevenness = unevenness.empty() ? std::numeric_limits<float>::infinity() : median(std::move(unevenness));
  return evidence;
}

}  // namespace omr
