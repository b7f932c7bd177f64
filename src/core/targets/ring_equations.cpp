#include "ring_equations.h"

#include <algorithm>

#include "tukey.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int UNKNOWNS = FAMILY_UNKNOWNS;

/** The sums of the equations, in rows as long as vectors like. */
struct Sums
{
  std::array<CircleDerivative, UNKNOWNS> normal{};  // upper triangle
  CircleDerivative right{};
  std::array<CircleDerivative, MAX_BOUNDARIES> coupling{};  // the last one is the radius' own
  std::array<double, MAX_BOUNDARIES> radius_right{};
};

OMR_VECTORIZED void addPoints(const CircleDistances& points, const std::vector<CircleDerivative>& derivatives,
                              const std::vector<double>& errors, double limit, Sums& sums)
{
  constexpr int SIZE = UNKNOWNS + 1;
  for (std::size_t p = 0; p < errors.size(); ++p)
  {
    const double error = errors[p];
    const double weight = tukeyWeight(error, limit);
    if (weight <= 0)
    {
      continue;
    }
    const CircleDerivative derivative = derivatives[p];
    CircleDerivative& coupling = sums.coupling[points.ring(p)];
    CircleDerivative weighted;
    for (int i = 0; i < SIZE; ++i)
    {
      weighted[i] = weight * derivative[i];
    }
    for (int i = 0; i < SIZE; ++i)
    {
      sums.right[i] -= weighted[i] * error;
      coupling[i] += weighted[i] * derivative[UNKNOWNS];
    }
    for (int i = 0; i < UNKNOWNS; ++i)
    {
      for (int j = 0; j < SIZE; ++j)
      {
        sums.normal[i][j] += weighted[i] * derivative[j];
      }
    }
    sums.radius_right[points.ring(p)] -= weighted[UNKNOWNS] * error;
  }
}
}  // namespace

RingEquations sumEquations(const CircleDistances& points, const std::vector<CircleDerivative>& derivatives,
                           const std::vector<double>& errors, double limit)
{
  Sums sums;
  addPoints(points, derivatives, errors, limit, sums);
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

}  // namespace omr
