#include "ring_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "levenberg_marquardt.h"
#include "ring_equations.h"
#include "tukey.h"

namespace omr
{
namespace
{
constexpr int MAX_STEPS = 8;
constexpr double LARGEST_ASPECT = 5;

class Fit
{
 public:
  Fit(const std::vector<BoundaryPoint>& points, bool perspective, double usual)
      : points_(points), perspective_(perspective), usual_(usual)
  {
  }

  bool run(RingFamily& family, std::vector<double>& radii)
  {
    RingEquations equations;
    RingFamily next;
    std::vector<double> next_radii;
    points_.measure(family, radii, errors_);
    levenbergMarquardt(
        MAX_STEPS, 1e-4,
        [&] {
          limit_ = tukeyLimit(errors_, sizes_);
          equations = build(family, radii);
          return cost(family, radii, errors_);
        },
        [&](double damping) {
          next = family;
          next_radii = radii;
          if (!solve(equations, damping, next, next_radii))
          {
            return std::numeric_limits<double>::infinity();
          }
          points_.measure(next, next_radii, next_errors_);
          return cost(next, next_radii, next_errors_);
        },
        [&] {
          family = next;
          radii = next_radii;
          errors_.swap(next_errors_);
        });
    return plausible(family, radii);
  }

  /** RMS distance of the points that count [px]. */
  double rms() const
  {
    return tukeyRms(errors_, limit_);
  }

  double outermostDeviation(const RingFamily& family, const std::vector<double>& radii)
  {
    points_.measure(family, radii, errors_);
    limit_ = tukeyLimit(errors_, sizes_);
    const auto covariance = build(family, radii).covariance(radii.size()) * std::max(1., rms() * rms());
    // The ellipse's centre is center - s A h: the other unknowns move it by a hundredth of what these do.
    const double square = radii.back() * radii.back();
    const double s = square / (1 - square * (family.hx * family.hx + family.hy * family.hy));
    const cv::Matx<double, 2, FAMILY_UNKNOWNS> by_unknown(1, 0, 0, 0, 0, -s * family.a, -s * family.b,  //
                                                          0, 1, 0, 0, 0, -s * family.b, -s * family.d);
    return std::sqrt(cv::trace(by_unknown * covariance * by_unknown.t()) / 2);
  }

 private:
  /** Weight of the prior on h: one deviation of the points counts as much as the usual perspective. */
  double priorWeight(const std::vector<double>& radii) const
  {
    const double usual = usual_ / radii.back();
    return limit_ * limit_ / (TUKEY * TUKEY * usual * usual);
  }

  double cost(const RingFamily& family, const std::vector<double>& radii, const std::vector<double>& errors) const
  {
    return tukeyLoss(errors, limit_) +
           3 * priorWeight(radii) * (family.hx * family.hx + family.hy * family.hy) / (limit_ * limit_);
  }

  RingEquations build(const RingFamily& family, const std::vector<double>& radii)
  {
    points_.differentiate(family, derivatives_);
    RingEquations equations = sumEquations(points_, derivatives_, errors_, limit_);
    const std::array<double, 3> det = {family.d, -2 * family.b, family.a};
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        equations.normal(2 + i, 2 + j) += GAUGE_WEIGHT * det[i] * det[j];
      }
    }
    const double prior = perspective_ ? priorWeight(radii) : 1e12;
    equations.normal(5, 5) += prior;
    equations.normal(6, 6) += prior;
    if (perspective_)
    {
      equations.right[5] -= prior * family.hx;
      equations.right[6] -= prior * family.hy;
    }
    return equations;
  }

  static bool solve(const RingEquations& equations, double damping, RingFamily& family, std::vector<double>& radii)
  {
    FamilyVector step;
    std::array<double, MAX_BOUNDARIES> radius_step{};
    if (!equations.solve(damping, radii.size(), step, radius_step))
    {
      return false;
    }
    for (std::size_t k = 0; k < radii.size(); ++k)
    {
      radii[k] += radius_step[k];
    }
    family.center += cv::Point2d(step[0], step[1]);
    family.a += step[2];
    family.b += step[3];
    family.d += step[4];
    family.hx += step[5];
    family.hy += step[6];
    const double det = family.a * family.d - family.b * family.b;
    if (!(det > .25 && det < 4 && family.a > 0))
    {
      return false;
    }
    const double scale = std::sqrt(det);
    for (double* value : {&family.a, &family.b, &family.d, &family.hx, &family.hy})
    {
      *value /= scale;
    }
    for (double& radius : radii)
    {
      radius *= scale;
    }
    return plausible(family, radii);
  }

  static bool plausible(const RingFamily& family, const std::vector<double>& radii)
  {
    double inner = 0;
    for (const double radius : radii)
    {
      if (!(radius > inner))
      {
        return false;
      }
      inner = radius;
    }
    return std::hypot(family.hx, family.hy) * inner < LARGEST_PERSPECTIVE && family.aspect() < LARGEST_ASPECT;
  }

  CircleDistances points_;
  bool perspective_;
  double usual_;                                      // of h R
  std::vector<double> errors_, next_errors_, sizes_;  // [px]
  std::vector<CircleDerivative> derivatives_;
  double limit_ = 1;  // Tukey's: errors beyond it do not count [px]
};
}  // namespace

void thin(std::vector<BoundaryPoint>& points, std::size_t max_points)
{
  if (points.size() > max_points)
  {
    for (std::size_t i = 0; i < max_points; ++i)
    {
      points[i] = points[i * points.size() / max_points];
    }
    points.resize(max_points);
  }
}

double refineFamily(const std::vector<BoundaryPoint>& points, bool perspective, RingFamily& family,
                    std::vector<double>& radii, double usual_perspective)
{
  const std::size_t unknowns = 7 + radii.size();
  if (points.size() < unknowns + 4 || radii.empty() || radii.size() > MAX_BOUNDARIES)
  {
    return std::numeric_limits<double>::infinity();
  }
  Fit fit(points, perspective && radii.size() >= 2, usual_perspective);
  RingFamily refined = family;
  std::vector<double> refined_radii = radii;
  if (!fit.run(refined, refined_radii))
  {
    return std::numeric_limits<double>::infinity();
  }
  family = refined;
  radii = refined_radii;
  return fit.rms();
}

double outermostDeviation(const std::vector<BoundaryPoint>& points, const RingFamily& family,
                          const std::vector<double>& radii, double usual_perspective)
{
  return Fit(points, true, usual_perspective).outermostDeviation(family, radii);
}

}  // namespace omr
