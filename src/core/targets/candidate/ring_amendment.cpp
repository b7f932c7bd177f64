#include "ring_amendment.h"

#include <algorithm>

#include "targets/boundaries/ring_deblur.h"

namespace omr
{
namespace
{
constexpr int MOST_SPLITS = 2;
constexpr double WHOLE = .8;  // of the directions

}  // namespace

void removeBoundary(std::size_t k, RingCandidate& candidate)
{
  candidate.boundaries.erase(candidate.boundaries.begin() + static_cast<std::ptrdiff_t>(k));
  candidate.rings.radii.erase(candidate.rings.radii.begin() + static_cast<std::ptrdiff_t>(k));
}

void splitMergedRings(const AngularSupport& support, RingCandidate& candidate)
{
  for (int split = 0; split < MOST_SPLITS; ++split)
  {
    std::vector<double> radii = radiiOf(candidate.boundaries);
    const double radius = mergedBoundary(*candidate.profile, radii);
    if (radius <= 0)
    {
      return;
    }
    const auto place = std::lower_bound(radii.begin(), radii.end(), radius);
    const auto ring = place - radii.begin();
    // The refinement has moved the boundaries since they were measured.
    const double scale = candidate.rings.radii[ring] / *place;
    radii.insert(place, radius);
    candidate.boundaries.insert(candidate.boundaries.begin() + ring,
                                measureBoundary(*candidate.profile, support, radii, static_cast<std::size_t>(ring)));
    candidate.rings.radii.insert(candidate.rings.radii.begin() + ring, radius * scale);
  }
}

void widenSeam(const AngularSupport& support, RingCandidate& candidate)
{
  std::vector<double> radii = radiiOf(candidate.boundaries);
  std::vector<bool> whole(radii.size());
  std::transform(candidate.boundaries.begin(), candidate.boundaries.end(), whole.begin(),
                 [](const Boundary& boundary) { return share(boundary.agreeing) > WHOLE; });
  const SeamRing seam = seamRing(*candidate.profile, radii, whole);
  if (seam.half_width <= 0)
  {
    return;
  }
  const std::size_t k = seam.boundary;
  const double scale = candidate.rings.radii[k] / radii[k];  // as above
  const double middle = radii[k];
  const auto next = static_cast<std::ptrdiff_t>(k) + 1;
  radii[k] = middle - seam.half_width;
  radii.insert(radii.begin() + next, middle + seam.half_width);
  candidate.rings.radii[k] = radii[k] * scale;
  candidate.rings.radii.insert(candidate.rings.radii.begin() + next, radii[k + 1] * scale);
  candidate.boundaries[k] = measureBoundary(*candidate.profile, support, radii, k);
  candidate.boundaries.insert(candidate.boundaries.begin() + next,
                              measureBoundary(*candidate.profile, support, radii, k + 1));
}

}  // namespace omr
