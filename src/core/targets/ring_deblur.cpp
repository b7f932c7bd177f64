#include "ring_deblur.h"

#include <algorithm>
#include <cmath>

#include "ring_fit.h"
#include "ring_samples.h"

namespace omr
{
namespace
{
// A further boundary must explain this much: at .018 one of 147 targets of the field gets a ring too many, at .025 one
// in "distance" lacks one.
constexpr double LEAST_EXPLAINED = .0225;  // fall of the root mean square, relative to the strongest contrast
constexpr double NOTHING_EXPLAINED =
    .005;                             // by 5 false ones; 727 true ones within 6 px of another explain .006 and more
constexpr double MOST_LEFT = .6;      // of the root mean square
constexpr double MERGED_WIDTH = 1.6;  // of the narrowest ring: least width of two
constexpr double NARROWEST = 2;       // ring [px]
constexpr double SEARCH_STEP = .5;    // [px]

/** Largest difference of two neighbours [grey levels]. */
double strongestContrast(const RingFit::Result& fit)
{
  double contrast = 0;
  for (std::size_t k = 0; k + 1 < fit.colors.size(); ++k)
  {
    contrast = std::max(contrast, cv::norm(fit.colors[k] - fit.colors[k + 1]));
  }
  return contrast;
}
}  // namespace

std::vector<cv::Vec3d> deblurredColors(const RingProfile& profile, const std::vector<double>& radii)
{
  const std::vector<cv::Vec3d> samples = medianSamples(profile, radii);
  std::vector<cv::Vec3d> colors = RingFit(samples, profile.step, radii).fit().colors;
  for (cv::Vec3d& color : colors)
  {
    color = fromHue(color);
    for (int c = 0; c < 3; ++c)
    {
      color[c] = std::clamp(color[c], 0., 255.);
    }
  }
  return colors;
}

double unexplained(const RingProfile& profile, const std::vector<double>& radii)
{
  const std::vector<cv::Vec3d> samples = medianSamples(profile, radii);
  const RingFit::Result whole = RingFit(samples, profile.step, radii).fit();
  return whole.rms / std::max(1., strongestContrast(whole));
}

bool isBlur(const RingProfile& profile, const std::vector<double>& radii, std::size_t k)
{
  const std::vector<cv::Vec3d> samples = medianSamples(profile, radii);
  RingFit fit(samples, profile.step, radii);
  const RingFit::Result with = fit.fit();
  fit.erase(k);
  const RingFit::Result without = fit.fit();
  return without.rms - with.rms < NOTHING_EXPLAINED * strongestContrast(with);
}

double mergedBoundary(const RingProfile& profile, const std::vector<double>& radii)
{
  const std::vector<cv::Vec3d> samples = medianSamples(profile, radii);
  RingFit fit(samples, profile.step, radii);
  const RingFit::Result whole = fit.fit();
  const double narrowest = narrowestRing(radii);
  double best = 0;
  double best_rms = std::min(MOST_LEFT * whole.rms, whole.rms - LEAST_EXPLAINED * strongestContrast(whole));
  for (std::size_t ring = 0; ring < radii.size() && best_rms > 0; ++ring)
  {
    const double inner = ring > 0 ? radii[ring - 1] : 0;
    if (radii[ring] - inner < MERGED_WIDTH * narrowest)
    {
      continue;
    }
    // At least one, also of a ring a little narrower than two: without it one target of 2.2 px in 800 scenes is lost.
    const int places = static_cast<int>((radii[ring] - inner - 2 * NARROWEST) / SEARCH_STEP) + 1;
    for (int i = 0; i < places; ++i)
    {
      const double radius = inner + NARROWEST + i * SEARCH_STEP;
      fit.insert(ring, radius);
      const double rms = fit.fit().rms;
      fit.erase(ring);
      if (rms < best_rms)
      {
        best = radius;
        best_rms = rms;
      }
    }
  }
  return best;
}

}  // namespace omr
