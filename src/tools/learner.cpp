#include "learner.h"

#include <algorithm>
#include <cmath>

#include "vectorized.h"

namespace omr
{
namespace
{
/** What the two means of Adam keep of the past. */
constexpr float MEAN_KEPT = .9F;
constexpr float SQUARE_KEPT = .999F;

/** Adds a row of weights times each input to the sums of the units. */
OMR_VECTORIZED void addRows(const float* inputs, int count, const float* rows, int units, float* sums)
{
  for (int i = 0; i < count; ++i)
  {
    const float input = inputs[i];
    const float* row = rows + static_cast<std::ptrdiff_t>(i) * units;
    for (int unit = 0; unit < units; ++unit)
    {
      sums[unit] += input * row[unit];
    }
  }
}

/** Adds the units' derivatives times each input to the gradients of the rows. */
OMR_VECTORIZED void addGradients(const float* inputs, int count, const float* derivatives, int units, float* rows)
{
  for (int i = 0; i < count; ++i)
  {
    const float input = inputs[i];
    float* row = rows + static_cast<std::ptrdiff_t>(i) * units;
    for (int unit = 0; unit < units; ++unit)
    {
      row[unit] += input * derivatives[unit];
    }
  }
}

/** @param mean_share, square_share what the means have seen: they begin with 0. */
OMR_VECTORIZED void descend(Descent& descent, float size, float mean_share, float square_share)
{
  const std::size_t count = descent.values.size();
  float* values = descent.values.data();
  float* gradient = descent.gradient.data();
  float* mean = descent.mean.data();
  float* square = descent.square.data();
  for (std::size_t i = 0; i < count; ++i)
  {
    mean[i] = MEAN_KEPT * mean[i] + (1 - MEAN_KEPT) * gradient[i];
    square[i] = SQUARE_KEPT * square[i] + (1 - SQUARE_KEPT) * gradient[i] * gradient[i];
    values[i] -= size * (mean[i] / mean_share) / (std::sqrt(square[i] / square_share) + 1e-7F);
    gradient[i] = 0;
  }
}
}  // namespace

Descent::Descent(std::size_t count, float spread, cv::RNG& random)
    : values(count), gradient(count, 0), mean(count, 0), square(count, 0)
{
  for (float& value : values)
  {
    value = static_cast<float>(random.gaussian(spread));
  }
}

void Descent::step(float size, int steps)
{
  descend(*this, size, 1 - std::pow(MEAN_KEPT, static_cast<float>(steps)),
          1 - std::pow(SQUARE_KEPT, static_cast<float>(steps)));
}

Learner::Learner(int inputs, int hidden, cv::RNG& random)
    : inputs_(inputs),
      hidden_(hidden),
      first_(static_cast<std::size_t>(hidden) * (inputs + 1), 2 / std::sqrt(static_cast<float>(inputs)), random),
      second_(static_cast<std::size_t>(MARKER_KINDS) * (hidden + 1), 1 / std::sqrt(static_cast<float>(hidden)), random),
      active_(hidden),
      derivatives_(hidden)
{
}

void Learner::learn(const float* window, WindowLabel label, float weight)
{
  std::fill(active_.begin(), active_.end(), 0.F);
  addRows(window, inputs_ + 1, first_.values.data(), hidden_, active_.data());
  for (float& active : active_)
  {
    active = std::tanh(.5F * active);
  }
  std::fill(derivatives_.begin(), derivatives_.end(), 0.F);
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    const float* weights = second_.values.data() + static_cast<std::ptrdiff_t>(kind) * (hidden_ + 1);
    float* gradient = second_.gradient.data() + static_cast<std::ptrdiff_t>(kind) * (hidden_ + 1);
    float sum = weights[hidden_];
    for (int unit = 0; unit < hidden_; ++unit)
    {
      sum += weights[unit] * active_[unit];
    }
    const float answer = static_cast<int>(label) == kind ? 1 : -1;
    const float error = weight * (std::tanh(.5F * sum) - answer);
    for (int unit = 0; unit < hidden_; ++unit)
    {
      gradient[unit] += error * active_[unit];
      derivatives_[unit] += error * weights[unit];
    }
    gradient[hidden_] += error;
  }
  for (int unit = 0; unit < hidden_; ++unit)
  {
    derivatives_[unit] *= .5F * (1 - active_[unit] * active_[unit]);
  }
  addGradients(window, inputs_ + 1, derivatives_.data(), hidden_, first_.gradient.data());
}

void Learner::step(double size)
{
  ++steps_;
  first_.step(static_cast<float>(size), steps_);
  second_.step(static_cast<float>(size), steps_);
}

FeedForward Learner::network(const std::vector<float>& means, const std::vector<float>& deviations) const
{
  FeedForward network;
  network.hidden = hidden_;
  for (int unit = 0; unit < hidden_; ++unit)
  {
    const auto weight = [&](int i) { return first_.values[static_cast<std::size_t>(i) * hidden_ + unit]; };
    double bias = weight(inputs_);
    std::vector<float> weights;
    for (int i = 0; i < inputs_; ++i)
    {
      weights.push_back(weight(i) / deviations[i]);
      bias -= weights.back() * means[i];
    }
    network.weights.push_back(static_cast<float>(bias));
    network.weights.insert(network.weights.end(), weights.begin(), weights.end());
  }
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    const float* weights = second_.values.data() + static_cast<std::ptrdiff_t>(kind) * (hidden_ + 1);
    network.weights.push_back(weights[hidden_]);
    network.weights.insert(network.weights.end(), weights, weights + hidden_);
  }
  return network;
}

}  // namespace omr
