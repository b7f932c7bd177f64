#ifndef OUTDOOR_OMR_CORE_RING_PROFILE_H
#define OUTDOOR_OMR_CORE_RING_PROFILE_H

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "targets/family/radial_edgels.h"
#include "targets/family/ring_family.h"

namespace omr
{
/** Logarithm of B, G and R: a change of the light is a constant. */
using LogColor = cv::Vec3f;

/** Added to grey levels before their logarithm: below it sensor noise and black level, not light, decide. */
constexpr float DARK_LEVEL = 24;

/** Colours around a family's centre along rays, in the plane's polar coordinates. */
struct RingProfile
{
  static constexpr int ANGLES = ANGLE_BINS;

  double step = 0;                 ///< between the samples of a ray [px]
  int count = 0;                   ///< samples a ray, from the centre outwards
  cv::Mat3f grey;                  ///< ANGLES x count: B, G, R [0, 255]
  cv::Mat3f color;                 ///< the same as logarithms
  std::vector<int> inside;         ///< per angle: samples of the ray that count: inside the image, 0 where hidden
  AngleBins open = ~AngleBins{0};  ///< the directions that are not hidden

  const cv::Vec3f* greyRay(int angle) const
  {
    return grey[angle];
  }

  const LogColor* ray(int angle) const
  {
    return color[angle];
  }
};

/**
 * Samples the image along the rays.
 *
 * @param bgr        H x W, CV_8UC3.
 * @param max_radius where the rays end [px].
 * @param profile    receives the result; its memory is reused.
 * @param open       the directions in which nothing hides the rings; the others are not sampled.
 */
void sampleProfile(const cv::Mat& bgr, const RingFamily& family, double max_radius, RingProfile& profile,
                   AngleBins open = ~AngleBins{0});

/** Directions that must count where something is measured: half of the open ones. */
int leastDirections(const RingProfile& profile);

/** Of the width of a ring, without what its edges blur. */
enum class RingPart
{
  whole,
  inner_rim,  ///< beside the inner boundary
  outer_rim   ///< beside the outer boundary
};

/**
 * Mean colour of a ring in one direction, away from its edges.
 *
 * @param radii boundaries of the rings [px].
 * @param ring  index of the ring; radii.size() is what lies around the outermost.
 * @return      false where the ray has left the image.
 */
bool ringColor(const RingProfile& profile, const std::vector<double>& radii, std::size_t ring, int angle,
               LogColor& color, RingPart part = RingPart::whole);

/** Width of the narrowest ring [px]. @param radii of the boundaries [px], not empty */
double narrowestRing(const std::vector<double>& radii);

/** Likewise of the widest. */
double widestRing(const std::vector<double>& radii);

/** The values times a factor. */
std::vector<double> scaledBy(double factor, std::vector<double> values);

/** Median of each channel over some directions, of which there is at least one. @param colors one a direction. */
LogColor medianOf(const std::array<LogColor, RingProfile::ANGLES>& colors, AngleBins directions);

/** The grey level [0, 255] that a channel of a LogColor stands for. */
double greyLevel(float log_color);

}  // namespace omr

#endif
