#include "ring_deblur.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace omr
{
namespace
{
constexpr int ANGLES = RingProfile::ANGLES;
constexpr double BRIGHTNESS_BLUR = 1;  // deviation [px]
constexpr double HUE_BLUR = 2;
constexpr double SURROUNDING = 4;  // of the outermost ring, that takes part [px]
constexpr double PRIOR = .05;      // weight of the ring's blurred colour, in samples
constexpr int DIRECTIONS = 32;     // of the integral over a disk

// A further boundary must explain this much: of 718 rings narrower than 7 px and without one, the best imagined one
// explains .023 of the contrast, and six of seven that hide one .027 to .065.
constexpr double LEAST_EXPLAINED = .025;  // fall of the root mean square, relative to the strongest contrast
constexpr double NOTHING_EXPLAINED =
    .005;                             // by 5 false ones; 727 true ones within 6 px of another explain .006 and more
constexpr double MOST_LEFT = .6;      // of the root mean square
constexpr double MERGED_WIDTH = 1.6;  // of the narrowest ring: least width of two
constexpr double NARROWEST = 2;       // ring [px]
constexpr double SEARCH_STEP = .5;    // [px]

/** Share of the light of a disk of this radius that a point at distance r from its centre receives through the blur. */
double blurredDisk(double r, double radius, double deviation)
{
  if (radius > 4 * deviation)
  {
    return .5 * std::erfc((r - radius) / (deviation * std::sqrt(2.)));
  }
  // In polar coordinates around the point, the Gaussian's radial integral is known.
  const auto beyond = [&](double distance) { return std::exp(-distance * distance / (2 * deviation * deviation)); };
  double sum = 0;
  for (int i = 0; i < DIRECTIONS; ++i)
  {
    const double phi = 2 * CV_PI * (i + .5) / DIRECTIONS;
    const double across = r * std::sin(phi);
    const double inside = radius * radius - across * across;
    if (inside > 0)
    {
      const double to = -r * std::cos(phi) + std::sqrt(inside);
      const double from = -r * std::cos(phi) - std::sqrt(inside);
      sum += to > 0 ? beyond(std::max(0., from)) - beyond(to) : 0;
    }
  }
  return sum / DIRECTIONS;
}

/** Brightness and the differences of red and blue to it. */
cv::Vec3d toHue(const cv::Vec3d& bgr)
{
  const double brightness = .114 * bgr[0] + .587 * bgr[1] + .299 * bgr[2];
  return {brightness, bgr[2] - brightness, bgr[0] - brightness};
}

cv::Vec3d fromHue(const cv::Vec3d& hue)
{
  const double red = hue[0] + hue[1];
  const double blue = hue[0] + hue[2];
  return {blue, (hue[0] - .299 * red - .114 * blue) / .587, red};
}

/** Median over the directions of each channel at each radius. */
std::vector<cv::Vec3d> medianProfile(const RingProfile& profile, int count)
{
  std::vector<cv::Vec3d> medians;
  for (int i = 0; i < count; ++i)
  {
    cv::Vec3d median;
    for (int c = 0; c < 3; ++c)
    {
      std::array<float, ANGLES> values;
      int seen = 0;
      for (int angle = 0; angle < ANGLES; ++angle)
      {
        if (i < profile.inside[angle])
        {
          values[seen++] = profile.greyRay(angle)[i][c];
        }
      }
      if (seen == 0)
      {
        return medians;
      }
      std::nth_element(values.begin(), values.begin() + seen / 2, values.begin() + seen);
      median[c] = values[seen / 2];
    }
    medians.push_back(toHue(median));
  }
  return medians;
}
/** Uniform rings whose blurred image fits the samples best. */
struct Fit
{
  std::vector<cv::Vec3d> colors;  // of the rings and around them: brightness and hue
  double rms = 0;                 // of what is left [grey levels]
};

Fit fitRings(const std::vector<cv::Vec3d>& samples, double step, const std::vector<double>& radii)
{
  const int rings = static_cast<int>(radii.size());
  Fit fit;
  fit.colors.resize(static_cast<std::size_t>(rings) + 1);
  for (const bool is_hue : {false, true})
  {
    cv::Mat share(static_cast<int>(samples.size()), rings + 1, CV_64F);
    cv::Mat values(share.rows, is_hue ? 2 : 1, CV_64F);
    for (int i = 0; i < share.rows; ++i)
    {
      double inner = 0;
      for (int k = 0; k <= rings; ++k)
      {
        const double outer = k < rings ? blurredDisk(i * step, radii[k], is_hue ? HUE_BLUR : BRIGHTNESS_BLUR) : 1;
        share.at<double>(i, k) = outer - inner;
        inner = outer;
      }
      for (int c = 0; c < values.cols; ++c)
      {
        values.at<double>(i, c) = samples[i][is_hue ? c + 1 : 0];
      }
    }
    cv::Mat normal = share.t() * share;
    cv::Mat right = share.t() * values;
    for (int k = 0; k <= rings; ++k)
    {
      const double middle = k == 0 ? 0 : .5 * (radii[k - 1] + (k < rings ? radii[k] : radii.back() + SURROUNDING));
      const int i = std::min(static_cast<int>(std::lround(middle / step)), share.rows - 1);
      normal.at<double>(k, k) += PRIOR;
      right.row(k) += PRIOR * values.row(i);
    }
    cv::Mat solution;
    cv::solve(normal, right, solution, cv::DECOMP_CHOLESKY);
    for (int k = 0; k <= rings; ++k)
    {
      for (int c = 0; c < values.cols; ++c)
      {
        fit.colors[k][is_hue ? c + 1 : 0] = solution.at<double>(k, c);
      }
    }
    fit.rms += std::pow(cv::norm(share * solution - values), 2) / share.rows;
  }
  fit.rms = std::sqrt(fit.rms);
  return fit;
}

/** Largest difference of two neighbours [grey levels]. */
double strongestContrast(const Fit& fit)
{
  double contrast = 0;
  for (std::size_t k = 0; k + 1 < fit.colors.size(); ++k)
  {
    contrast = std::max(contrast, cv::norm(fit.colors[k] - fit.colors[k + 1]));
  }
  return contrast;
}

std::vector<cv::Vec3d> samplesWithin(const RingProfile& profile, const std::vector<double>& radii)
{
  const int count = std::min(profile.count, static_cast<int>((radii.back() + SURROUNDING) / profile.step));
  return medianProfile(profile, count);
}
}  // namespace

std::vector<cv::Vec3d> deblurredColors(const RingProfile& profile, const std::vector<double>& radii)
{
  std::vector<cv::Vec3d> colors = fitRings(samplesWithin(profile, radii), profile.step, radii).colors;
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

bool isBlur(const RingProfile& profile, const std::vector<double>& radii, std::size_t k)
{
  const std::vector<cv::Vec3d> samples = samplesWithin(profile, radii);
  std::vector<double> others = radii;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
  const Fit with = fitRings(samples, profile.step, radii);
  const Fit without = fitRings(samples, profile.step, others);
  return without.rms - with.rms < NOTHING_EXPLAINED * strongestContrast(with);
}

double mergedBoundary(const RingProfile& profile, const std::vector<double>& radii)
{
  const std::vector<cv::Vec3d> samples = samplesWithin(profile, radii);
  const Fit whole = fitRings(samples, profile.step, radii);
  const double narrowest = narrowestRing(radii);
  double best = 0;
  double best_rms = std::min(MOST_LEFT * whole.rms, whole.rms - LEAST_EXPLAINED * strongestContrast(whole));
  std::vector<double> split = radii;
  split.push_back(0);
  for (std::size_t ring = 0; ring < radii.size(); ++ring)
  {
    const double inner = ring > 0 ? radii[ring - 1] : 0;
    if (radii[ring] - inner < MERGED_WIDTH * narrowest)
    {
      continue;
    }
    std::copy(radii.begin(), radii.end(), split.begin());
    std::copy(radii.begin() + static_cast<std::ptrdiff_t>(ring), radii.end(),
              split.begin() + static_cast<std::ptrdiff_t>(ring) + 1);
    const int places = static_cast<int>((radii[ring] - inner - 2 * NARROWEST) / SEARCH_STEP) + 1;
    for (int i = 0; i < places; ++i)
    {
      split[ring] = inner + NARROWEST + i * SEARCH_STEP;
      const Fit fit = fitRings(samples, profile.step, split);
      if (fit.rms < best_rms)
      {
        best = split[ring];
        best_rms = fit.rms;
      }
    }
  }
  return best;
}

}  // namespace omr
