#include "ring_samples.h"

#include <algorithm>
#include <array>

#include "median.h"
#include "ring_fit.h"

namespace omr
{
namespace
{
constexpr int ANGLES = RingProfile::ANGLES;

/** Median over the directions of each channel at each radius. */
std::vector<cv::Vec3d> medianProfile(const RingProfile& profile, int count)
{
  std::vector<cv::Vec3d> medians;
  for (int i = 0; i < count; ++i)
  {
    cv::Vec3d middle;
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
      middle[c] = median(values, seen);
    }
    medians.push_back(toHue(middle));
  }
  return medians;
}
}  // namespace

cv::Vec3d toHue(const cv::Vec3d& bgr)
{
  const double brightness = GREY_WEIGHTS[0] * bgr[0] + GREY_WEIGHTS[1] * bgr[1] + GREY_WEIGHTS[2] * bgr[2];
  return {brightness, bgr[2] - brightness, bgr[0] - brightness};
}

cv::Vec3d fromHue(const cv::Vec3d& hue)
{
  const double red = hue[0] + hue[1];
  const double blue = hue[0] + hue[2];
  return {blue, (hue[0] - GREY_WEIGHTS[2] * red - GREY_WEIGHTS[0] * blue) / GREY_WEIGHTS[1], red};
}

std::vector<cv::Vec3d> medianSamples(const RingProfile& profile, const std::vector<double>& radii)
{
  const int count = std::min(profile.count, static_cast<int>((radii.back() + RingFit::SURROUNDING) / profile.step));
  return medianProfile(profile, count);
}

}  // namespace omr
