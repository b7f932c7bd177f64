#include "ring_equations.h"

#include <algorithm>

#include "tukey.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int UNKNOWNS = FAMILY_UNKNOWNS;
constexpr int SIZE = UNKNOWNS + 1;

/** The sums of the equations, in rows as long as vectors like. */
struct Sums
{
  std::array<CircleDerivative, UNKNOWNS> normal{};  // upper triangle
  CircleDerivative right{};
  std::array<CircleDerivative, MAX_BOUNDARIES> coupling{};  // the last one is the radius' own
  std::array<double, MAX_BOUNDARIES> radius_right{};
};

/** A row of the normal equations: the sums of the products of one derivative of each point with all of them. */
OMR_VECTORIZED CircleDerivative sumProducts(const std::vector<CircleDerivative>& derivatives,
                                            const std::vector<double>& weights, int row)
{
  CircleDerivative sum{};
  for (std::size_t p = 0; p < weights.size(); ++p)
  {
    const double weighted = weights[p] * derivatives[p][row];
    for (int i = 0; i < SIZE; ++i)
    {
      sum[i] += weighted * derivatives[p][i];
    }
  }
  return sum;
}

OMR_VECTORIZED void addPoints(const CircleDistances& points, const std::vector<CircleDerivative>& derivatives,
                              const std::vector<double>& errors, const std::vector<double>& weights, Sums& sums)
{
  for (std::size_t p = 0; p < errors.size(); ++p)
  {
    const double error = errors[p];
    const double by_radius = derivatives[p][UNKNOWNS];
    CircleDerivative& coupling = sums.coupling[points.ring(p)];
    CircleDerivative weighted;
    for (int i = 0; i < SIZE; ++i)
    {
      weighted[i] = weights[p] * derivatives[p][i];
    }
    for (int i = 0; i < SIZE; ++i)
    {
      sums.right[i] -= weighted[i] * error;
    }
    for (int i = 0; i < SIZE; ++i)
    {
      coupling[i] += weighted[i] * by_radius;
    }
    sums.radius_right[points.ring(p)] -= weighted[UNKNOWNS] * error;
  }
}
}  // namespace

RingEquations sumEquations(const CircleDistances& points, const std::vector<CircleDerivative>& derivatives,
                           const std::vector<double>& errors, double limit)
{
  Sums sums;
  std::vector<double> weights(errors.size());
  std::transform(errors.begin(), errors.end(), weights.begin(),
                 [=](double error) { return tukeyWeight(error, limit); });
  addPoints(points, derivatives, errors, weights, sums);
  for (int row = 0; row < UNKNOWNS; ++row)
  {
    sums.normal[row] = sumProducts(derivatives, weights, row);
  }
  RingEquations equations;
  for (int i = 0; i < UNKNOWNS; ++i)
  {
    equations.right[i] = sums.right[i];
    for (int j = 0; j < UNKNOWNS; ++j)
    {
      equations.normal(i, j) = sums.normal[std::min(i, j)][std::max(i, j)];
    }
  }
  for (std::size_t k = 0; k < MAX_BOUNDARIES; ++k)
  {
    std::copy_n(sums.coupling[k].begin(), UNKNOWNS, equations.coupling[k].val);
    equations.diagonal[k] = sums.coupling[k][UNKNOWNS];
  }
  equations.radius_right = sums.radius_right;
  return equations;
}

bool RingEquations::solve(double damping, std::size_t count, FamilyVector& step,
                          std::array<double, MAX_BOUNDARIES>& radius_step) const
{
  auto reduced = normal;
  FamilyVector reduced_right = right;
  for (int i = 0; i < UNKNOWNS; ++i)
  {
    reduced(i, i) *= 1 + damping;
  }
  std::array<double, MAX_BOUNDARIES> damped{};
  for (std::size_t k = 0; k < count; ++k)
  {
    damped[k] = diagonal[k] * (1 + damping) + 1e-9;
    for (int i = 0; i < UNKNOWNS; ++i)
    {
      reduced_right[i] -= coupling[k][i] * radius_right[k] / damped[k];
      for (int j = 0; j < UNKNOWNS; ++j)
      {
        reduced(i, j) -= coupling[k][i] * coupling[k][j] / damped[k];
      }
    }
  }
  if (!cv::solve(reduced, reduced_right, step, cv::DECOMP_CHOLESKY))
  {
    return false;
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    radius_step[k] = (radius_right[k] - coupling[k].dot(step)) / damped[k];
  }
  return true;
}

cv::Matx<double, UNKNOWNS, UNKNOWNS> RingEquations::covariance(std::size_t count) const
{
  auto reduced = normal;
  for (std::size_t k = 0; k < count; ++k)
  {
    reduced -= coupling[k] * coupling[k].t() * (1 / (diagonal[k] + 1e-9));
  }
  return reduced.inv(cv::DECOMP_CHOLESKY);
}

}  // namespace omr
