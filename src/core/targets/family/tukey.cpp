#include "tukey.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "median.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr std::size_t CHUNK = 64;
constexpr double SMALLEST_DEVIATION = .08;  // [px]

OMR_VECTORIZED void lossesOf(const double* errors, std::size_t size, double limit, double* losses)
{
  for (std::size_t i = 0; i < size; ++i)
  {
    const double t = errors[i] / limit;
    const double inside = 1 - t * t;
    const double loss = 1 - inside * inside * inside;
    losses[i] = inside <= 0 ? 1 : loss;
  }
}
}  // namespace

double tukeyLoss(const std::vector<double>& errors, double limit)
{
  std::array<double, CHUNK> losses;
  double sum = 0;
  for (std::size_t first = 0; first < errors.size(); first += CHUNK)
  {
    const std::size_t size = std::min(CHUNK, errors.size() - first);
    lossesOf(errors.data() + first, size, limit, losses.data());
    for (std::size_t i = 0; i < size; ++i)
    {
      sum += losses[i];
    }
  }
  return sum;
}

double tukeyLimit(const std::vector<double>& errors, std::vector<double>& sizes)
{
  sizes.resize(errors.size());
  std::transform(errors.begin(), errors.end(), sizes.begin(), [](double error) { return std::abs(error); });
  return TUKEY * std::max(SMALLEST_DEVIATION, 1.48 * median(sizes, static_cast<int>(sizes.size())));
}

double tukeyRms(const std::vector<double>& errors, double limit)
{
  double sum = 0;
  double weight_sum = 0;
  for (const double error : errors)
  {
    const double weight = tukeyWeight(error, limit);
    sum += weight * error * error;
    weight_sum += weight;
  }
  return std::sqrt(sum / std::max(1e-9, weight_sum));
}

}  // namespace omr
