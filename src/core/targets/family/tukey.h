#ifndef OUTDOOR_OMR_CORE_TUKEY_H
#define OUTDOOR_OMR_CORE_TUKEY_H

#include <algorithm>
#include <vector>

namespace omr
{
constexpr double TUKEY = 3.5;  ///< error that is rejected, in standard deviations

/** Tukey's weight [0, 1] of a point with this error. */
inline double tukeyWeight(double error, double limit)
{
  const double t = error / limit;
  const double inside = std::max(0., 1 - t * t);
  return inside * inside;
}

/** Sum of Tukey's loss of the points, which is 3 (e / limit)^2 for small errors e and 1 from the limit on. */
double tukeyLoss(const std::vector<double>& errors, double limit);

/** The limit that suits the errors of boundary points, from their median [px]. @param sizes workspace. */
double tukeyLimit(const std::vector<double>& errors, std::vector<double>& sizes);

/** Root mean square of the errors, weighted. */
double tukeyRms(const std::vector<double>& errors, double limit);

}  // namespace omr

#endif
