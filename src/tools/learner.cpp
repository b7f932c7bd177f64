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

/** Units that are computed together, and rows of them: the sums of four rows stay in the registers of AVX2. */
constexpr int UNITS = 16;
constexpr int ROWS = 4;

/** A matrix in memory: element (i, k) at i * step + k * next. */
struct Factor
{
  const float* first;
  std::ptrdiff_t step, next;
};

/** Sets each row of sums to the rows of the second factor times the elements of a row of the first one. cv::gemm takes
 * five times as long. */
OMR_VECTORIZED void multiply(const Factor& left, const float* right, std::ptrdiff_t right_step, int rows, int depth,
                             float* sums, std::ptrdiff_t sums_step)
{
  for (int row = 0; row < rows; row += ROWS)
  {
    float sum[ROWS][UNITS] = {};
    const float* from[ROWS];
    for (int i = 0; i < ROWS; ++i)
    {
      from[i] = left.first + std::min(row + i, rows - 1) * left.step;
    }
    for (int k = 0; k < depth; ++k)
    {
      for (int i = 0; i < ROWS; ++i)
      {
        const float factor = from[i][k * left.next];
        for (int unit = 0; unit < UNITS; ++unit)
        {
          sum[i][unit] += factor * right[k * right_step + unit];
        }
      }
    }
    for (int i = 0; i < std::min(ROWS, rows - row); ++i)
    {
      std::copy(sum[i], sum[i] + UNITS, sums + (row + i) * sums_step);
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
      second_(static_cast<std::size_t>(MARKER_KINDS) * (hidden + 1), 1 / std::sqrt(static_cast<float>(hidden)), random)
{
  for (int unit = 0; unit < hidden; unit += UNITS)
  {
    first_.emplace_back(static_cast<std::size_t>(UNITS) * (inputs + 1), 2 / std::sqrt(static_cast<float>(inputs)),
                        random);
  }
}

/** From the outputs of all windows to what the units add to the gradient. */
void Learner::propagateErrors(const Batch& batch)
{
  for (int row = 0; row < batch.windows.rows; ++row)
  {
    const auto* active = active_.ptr<float>(row);
    auto* derivatives = derivatives_.ptr<float>(row);
    for (int kind = 0; kind < MARKER_KINDS; ++kind)
    {
      const float* weights = second_.values.data() + static_cast<std::ptrdiff_t>(kind) * (hidden_ + 1);
      float* gradient = second_.gradient.data() + static_cast<std::ptrdiff_t>(kind) * (hidden_ + 1);
      float sum = weights[hidden_];
      for (int unit = 0; unit < hidden_; ++unit)
      {
        sum += weights[unit] * active[unit];
      }
      const float answer = static_cast<int>(batch.labels[row]) == kind ? 1 : -1;
      const float error = batch.weights[row] * (std::tanh(.5F * sum) - answer);
      for (int unit = 0; unit < hidden_; ++unit)
      {
        gradient[unit] += error * active[unit];
        derivatives[unit] += error * weights[unit];
      }
      gradient[hidden_] += error;
    }
    for (int unit = 0; unit < hidden_; ++unit)
    {
      derivatives[unit] *= .5F * (1 - active[unit] * active[unit]);
    }
  }
}

void Learner::learn(const Batch& batch, double size)
{
  const int rows = batch.windows.rows;
  const int groups = static_cast<int>(first_.size());
  const auto step_size = static_cast<float>(size);
  const auto* windows = batch.windows.ptr<float>();
  active_.create(rows, UNITS * groups, CV_32FC1);
  derivatives_.create(rows, UNITS * groups, CV_32FC1);
  derivatives_ = 0;
  ++steps_;
  cv::parallel_for_({0, groups}, [&](const cv::Range& range) {
    for (int group = range.start; group < range.end; ++group)
    {
      float* active = active_.ptr<float>() + static_cast<std::ptrdiff_t>(UNITS) * group;
      multiply({windows, inputs_ + 1, 1}, first_[group].values.data(), UNITS, rows, inputs_ + 1, active, active_.cols);
      for (int i = 0; i < rows * UNITS; ++i)
      {
        float& unit = active[i / UNITS * active_.cols + i % UNITS];
        unit = std::tanh(.5F * unit);
      }
    }
  });
  propagateErrors(batch);
  cv::parallel_for_({0, groups}, [&](const cv::Range& range) {
    for (int group = range.start; group < range.end; ++group)
    {
      const float* derivatives = derivatives_.ptr<float>() + static_cast<std::ptrdiff_t>(UNITS) * group;
      multiply({windows, 1, inputs_ + 1}, derivatives, derivatives_.cols, inputs_ + 1, rows,
               first_[group].gradient.data(), UNITS);
      first_[group].step(step_size, steps_);
    }
  });
  second_.step(step_size, steps_);
}

float Learner::weight(int unit, int input) const
{
  return first_[unit / UNITS].values[static_cast<std::size_t>(input) * UNITS + unit % UNITS];
}

FeedForward Learner::network(const std::vector<float>& means, const std::vector<float>& deviations) const
{
  FeedForward network;
  network.hidden = hidden_;
  for (int unit = 0; unit < hidden_; ++unit)
  {
    double bias = weight(unit, inputs_);
    std::vector<float> weights;
    for (int i = 0; i < inputs_; ++i)
    {
      weights.push_back(weight(unit, i) / deviations[i]);
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
