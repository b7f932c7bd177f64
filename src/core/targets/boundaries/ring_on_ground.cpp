#include "ring_on_ground.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ring_samples.h"

namespace omr
{
namespace
{
constexpr int ANGLES = RingProfile::ANGLES;
// Of 3310 targets in 1160 drawn and 87 path-traced scenes, A and the evaluation 20 of 105 with another number of rings
// have such an arc, and 2 others. Without the limits that halos of sharpening give 21 and 12 have; so, at .75 or .95 of
// the brightness 18 and 21 with another number and 12 and 16 others, with arcs of .25 or .4 24 and 14, 22 and 5.
// Relative to the brightest ring: white sheets are brighter, and their rims pass for circles.
constexpr double DARK_GROUND = .85;
constexpr double STEP = .5;    // from circle to circle [px]
constexpr double EDGE = 1.2;   // blur to either side of a circle [px]
constexpr double FLANK = 1.5;  // the outermost boundary's [px]
// Sharpening leaves a halo of up to .16 of the step of the outermost boundary, most of it nearer than this.
constexpr double HALO_REACH = 3.5;      // [px of the profile]
constexpr double HALO_STEP = .17;       // relative to that step
constexpr double LEAST_WIDTH = 2;       // of a further ring [px]
constexpr double LEAST_SHARE = .6;      // likewise, relative to the narrowest
constexpr double MOST_SHARE = 2.5;      // relative to the widest
constexpr double OUTSIDE = 2;           // width of what is compared with it [px]
constexpr double OUTSIDE_SHARE = .4;    // likewise, relative to the narrowest
constexpr double LEAST_CONTRAST = .04;  // of the logarithms
constexpr double LONG_ARC = .3;         // of the directions that agree side by side
constexpr int LEAST_SEEN = ANGLES / 2;  // directions
constexpr double LEAST_ALONG = .4;      // of a step that agrees, relative to the median
constexpr double MOST_ALONG = 2.5;      // likewise
constexpr double LEAST_LOCAL = .35;     // likewise, of what it has at the circle

/** Mean colours of parts of the rays. */
class RayMeans
{
 public:
  explicit RayMeans(const RingProfile& profile)
      : step_(profile.step), stride_(profile.count + 1), sums_(static_cast<std::size_t>(ANGLES) * stride_)
  {
    for (int angle = 0; angle < ANGLES; ++angle)
    {
      cv::Vec3d* sums = &sums_[static_cast<std::size_t>(angle) * stride_];
      for (int i = 0; i < profile.count; ++i)
      {
        sums[i + 1] = sums[i] + cv::Vec3d(profile.ray(angle)[i]);
      }
    }
  }

  /** Between two radii [px], at least one sample. */
  LogColor at(int angle, double from, double to) const
  {
    const int last = static_cast<int>(stride_) - 1;
    const int end = std::clamp(static_cast<int>(std::lround(to / step_)), 1, last);
    const int begin = std::clamp(static_cast<int>(std::lround(from / step_)), 0, end - 1);
    const cv::Vec3d* sums = &sums_[static_cast<std::size_t>(angle) * stride_];
    return LogColor((sums[end] - sums[begin]) / (end - begin));
  }

 private:
  double step_;
  std::size_t stride_;
  std::vector<cv::Vec3d> sums_;
};

/** What changes at a circle beyond the outermost ring. */
struct Circle
{
  double local = 0;     // step at the circle itself
  double contrast = 0;  // of what is inside to what is outside
  int run = 0;          // directions side by side that agree
};

Circle circleAt(const RingProfile& profile, const RayMeans& means, double outermost, double radius, double outside,
                int scale)
{
  const double width = radius - outermost;
  const double edge = EDGE * scale;
  const double inner = outermost + std::min(FLANK * scale, .45 * width);
  const double outer = radius - std::min(edge, .3 * width);
  std::array<LogColor, ANGLES> whole;
  std::array<LogColor, ANGLES> local;
  AngleBins seen = 0;
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    if (profile.inside[angle] * profile.step > radius + edge + outside)
    {
      seen |= AngleBins{1} << angle;
      whole[angle] = means.at(angle, radius + edge, radius + edge + outside) - means.at(angle, inner, outer);
      local[angle] = means.at(angle, radius + .25 * edge, radius + 1.5 * edge) -
                     means.at(angle, radius - 1.5 * edge, radius - .25 * edge);
    }
  }
  if (countOf(seen) < LEAST_SEEN)
  {
    return {};
  }
  const LogColor step = medianOf(whole, seen);
  const double squared = step.dot(step);
  AngleBins agreeing = 0;
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    const double along = whole[angle].dot(step);
    const bool agrees = (seen >> angle & 1) != 0 && along > LEAST_ALONG * squared && along < MOST_ALONG * squared &&
                        local[angle].dot(step) > LEAST_LOCAL * squared;
    agreeing |= agrees ? AngleBins{1} << angle : 0;
  }
  return {cv::norm(medianOf(local, seen)), std::sqrt(squared), longestRun(agreeing)};
}

/** Whether the ground is darker than a ring, so that it is no white sheet. */
bool isDarkGround(const RingProfile& profile, const std::vector<double>& radii)
{
  const std::vector<cv::Vec3d> samples = medianSamples(profile, radii);
  double brightest = 0;
  double inner = 0;
  for (const double radius : radii)
  {
    const auto middle = static_cast<std::size_t>(.5 * (inner + radius) / profile.step);
    brightest = std::max(brightest, middle < samples.size() ? samples[middle][0] : 0);
    inner = radius;
  }
  return !samples.empty() && samples.back()[0] < DARK_GROUND * brightest;
}
}  // namespace

bool resemblesGround(const RingProfile& profile, const std::vector<double>& radii, double contrast, int scale)
{
  if (!isDarkGround(profile, radii))
  {
    return false;
  }
  const RayMeans means(profile);
  const double narrowest = narrowestRing(radii);
  const double outside = std::max(OUTSIDE * scale, OUTSIDE_SHARE * narrowest);
  const double first = radii.back() + std::max({HALO_REACH, LEAST_WIDTH * scale, LEAST_SHARE * narrowest});
  const double least_contrast = std::max(LEAST_CONTRAST, HALO_STEP * contrast);
  const double last = std::min(radii.back() + MOST_SHARE * widestRing(radii),
                               (profile.count - 1) * profile.step - EDGE * scale - OUTSIDE);
  Circle before;
  Circle circle;
  const int count = static_cast<int>(std::ceil((last - first) / STEP)) + 1;
  for (int i = 0; i < count; ++i)
  {
    const Circle next = circleAt(profile, means, radii.back(), first + (i - 1) * STEP, outside, scale);
    const bool is_sharpest = before.local > 0 && circle.local >= before.local && circle.local >= next.local;
    if (is_sharpest && circle.contrast > least_contrast && circle.run > LONG_ARC * ANGLES)
    {
      return true;
    }
    before = circle;
    circle = next;
  }
  return false;
}

}  // namespace omr
