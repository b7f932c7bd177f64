#ifndef OUTDOOR_OMR_CORE_FAST_ANGLE_H
#define OUTDOOR_OMR_CORE_FAST_ANGLE_H

#include <cfloat>
#include <cmath>

namespace omr
{
/** Direction of a vector [0, 360] degrees, the same as cv::fastAtan2() to the bit, but inline and without branches. */
inline float fastAngle(float x, float y)
{
  constexpr auto DEGREES = static_cast<float>(180 / 3.141592653589793238462643383279502884);
  constexpr float P1 = 0.9997878412794807F * DEGREES;
  constexpr float P3 = -0.3258083974640975F * DEGREES;
  constexpr float P5 = 0.1555786518463281F * DEGREES;
  constexpr float P7 = -0.04432655554792128F * DEGREES;
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const bool is_flat = ax >= ay;
  const float c = (is_flat ? ay : ax) / ((is_flat ? ax : ay) + static_cast<float>(DBL_EPSILON));
  const float c2 = c * c;
  const float octant = (((P7 * c2 + P5) * c2 + P3) * c2 + P1) * c;
  const float quadrant = is_flat ? octant : 90.F - octant;
  const float half = x < 0 ? 180.F - quadrant : quadrant;
  return y < 0 ? 360.F - half : half;
}

}  // namespace omr

#endif
