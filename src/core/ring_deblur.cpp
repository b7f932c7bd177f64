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
}  // namespace

std::vector<cv::Vec3d> deblurredColors(const RingProfile& profile, const std::vector<double>& radii)
{
  const int rings = static_cast<int>(radii.size());
  const int count = std::min(profile.count, static_cast<int>((radii.back() + SURROUNDING) / profile.step));
  const std::vector<cv::Vec3d> samples = medianProfile(profile, count);
  std::vector<cv::Vec3d> colors(static_cast<std::size_t>(rings) + 1);
  for (const bool is_hue : {false, true})
  {
    cv::Mat share(static_cast<int>(samples.size()), rings + 1, CV_64F);
    cv::Mat values(share.rows, is_hue ? 2 : 1, CV_64F);
    for (int i = 0; i < share.rows; ++i)
    {
      double inner = 0;
      for (int k = 0; k <= rings; ++k)
      {
        const double outer =
            k < rings ? blurredDisk(i * profile.step, radii[k], is_hue ? HUE_BLUR : BRIGHTNESS_BLUR) : 1;
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
      const double middle = .5 * ((k > 0 ? radii[k - 1] : 0) + (k < rings ? radii[k] : radii.back() + SURROUNDING));
      const auto i = std::clamp<int>(static_cast<int>(std::lround((k > 0 ? middle : 0) / profile.step)), 0, share.rows - 1);
      normal.at<double>(k, k) += PRIOR;
      for (int c = 0; c < values.cols; ++c)
      {
        right.at<double>(k, c) += PRIOR * values.at<double>(i, c);
      }
    }
    cv::Mat solution;
    cv::solve(normal, right, solution, cv::DECOMP_CHOLESKY);
    for (int k = 0; k <= rings; ++k)
    {
      for (int c = 0; c < values.cols; ++c)
      {
        colors[k][is_hue ? c + 1 : 0] = solution.at<double>(k, c);
      }
    }
  }
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

}  // namespace omr
