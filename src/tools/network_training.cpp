#include "network_training.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>

#include "learner.h"
#include "outdoor_omr/haar_features.h"

namespace omr
{
namespace
{
/** Examples between two steps, and the first step, which shrinks to nothing along half a wave. */
constexpr int BATCH = 256;
constexpr double FIRST_STEP = .003;

constexpr std::uint64_t SEED = 1;

/** Mean and deviation of each input. */
struct Scales
{
  std::vector<float> mean, deviation;

  explicit Scales(const cv::Mat& inputs)
  {
    for (int i = 0; i < inputs.cols; ++i)
    {
      cv::Scalar average;
      cv::Scalar spread;
      cv::meanStdDev(inputs.col(i), average, spread);
      mean.push_back(static_cast<float>(average[0]));
      deviation.push_back(static_cast<float>(spread[0]) + 1e-5F);
    }
  }
};

/**
 * A window as it would be had the camera been turned by quarters, the picture been mirrored, or dark and light been
 * exchanged; what does not belong to a block stays the same. One of the 16 at random.
 */
void vary(const float* window, int inputs, cv::RNG& random, float* varied)
{
  const unsigned way = random.next();
  const bool inverted = (way & 8U) != 0;
  const bool transposed = (way & 4U) != 0;
  const int others = inputs - HAAR_BLOCKS * BLOCK_FEATURES;
  std::copy(window, window + others, varied);
  for (int i = 0; i < HAAR_BLOCKS; ++i)
  {
    int row = (way & 1U) != 0 ? 3 - i / 4 : i / 4;
    int col = (way & 2U) != 0 ? 3 - i % 4 : i % 4;
    if (transposed)
    {
      std::swap(row, col);
    }
    const float* block = window + others + BLOCK_FEATURES * (4 * row + col);
    float* to = varied + others + BLOCK_FEATURES * i;
    std::copy(block, block + BLOCK_FEATURES, to);
    to[0] = inverted ? -to[0] : to[0];
    if (transposed)
    {
      std::swap(to[3], to[4]);
    }
  }
}

void writeUnits(std::ostream& stream, const float*& weights, int units, int inputs, const std::string& indent)
{
  for (int unit = 0; unit < units; ++unit)
  {
    stream << indent << "  - [";
    for (int i = 0; i <= inputs; ++i)
    {
      stream << (i == 0 ? "" : ", ") << *weights++;
    }
    stream << "]\n";
  }
}

void writeLayers(std::ostream& stream, const FeedForward& network, int inputs, const std::string& indent)
{
  stream << indent << "thresholds: {checkerboard: " << network.thresholds[0] << ", target: " << network.thresholds[1]
         << "}\n";
  const float* weights = network.weights.data();
  stream << indent << "hidden_units:  # bias, then a weight for each of the " << inputs << " inputs\n";
  writeUnits(stream, weights, network.hidden, inputs, indent);
  stream << indent << "output_units:  # checkerboard, target: bias, then a weight for each hidden unit\n";
  writeUnits(stream, weights, MARKER_KINDS, network.hidden, indent);
}

void writeEvidence(std::ostream& stream, const char* kind, const BoxEvidence& evidence)
{
  stream << "  " << kind << ": {weights: [";
  for (int i = 0; i <= BOX_FEATURES; ++i)
  {
    stream << (i == 0 ? "" : ", ") << evidence.weights[i];
  }
  stream << "], enlarged: " << evidence.enlarged << ", shown: " << evidence.shown << "}\n";
}
}  // namespace

FeedForward trainNetwork(const Examples& examples, int hidden, int epochs, bool varied)
{
  const cv::Mat& inputs = examples.inputs;
  cv::RNG random(SEED);
  const Scales scales(inputs);
  Learner learner(inputs.cols, hidden, random);
  std::vector<int> order(inputs.rows);
  std::iota(order.begin(), order.end(), 0);
  std::vector<float> window(inputs.cols + 1, 1);  // the bias at the end
  const double steps = static_cast<double>(epochs) * inputs.rows;
  double done = 0;
  for (int epoch = 0; epoch < epochs; ++epoch)
  {
    cv::randShuffle(order, 1, &random);
    for (int i = 0; i < inputs.rows; ++i)
    {
      const int example = order[i];
      const auto* row = inputs.ptr<float>(example);
      varied ? vary(row, inputs.cols, random, window.data()) : void(std::copy(row, row + inputs.cols, window.data()));
      for (int k = 0; k < inputs.cols; ++k)
      {
        window[k] = (window[k] - scales.mean[k]) / scales.deviation[k];
      }
      learner.learn(window.data(), examples.labels[example], examples.weights[example] / BATCH);
      ++done;
      if ((i + 1) % BATCH == 0 || i + 1 == inputs.rows)
      {
        learner.step(FIRST_STEP * .5 * (1 + std::cos(CV_PI * done / steps)));
      }
    }
  }
  return learner.network(scales.mean, scales.deviation);
}

void writeMarkerNetwork(std::ostream& stream, const MarkerNetwork& network)
{
  stream << std::setprecision(5);
  writeLayers(stream, network, HAAR_FEATURES, "");
  if (network.gate.hidden > 0)
  {
    stream << "gate:  # what windows must pass at a first look\n";
    writeLayers(stream, network.gate, GATE_INPUTS, "  ");
  }
  stream << "boxes:  # log of the odds that neighbouring windows show a marker: bias, then a weight for each feature\n";
  writeEvidence(stream, "checkerboard", network.boxes[0]);
  writeEvidence(stream, "target", network.boxes[1]);
}

}  // namespace omr
