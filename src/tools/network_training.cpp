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

/** One of the ways in which a window may be turned by quarters, mirrored, and have dark and light exchanged. */
struct Variation
{
  bool down, right, transposed, inverted;

  explicit Variation(cv::RNG& random)
  {
    const unsigned way = random.next();
    down = (way & 1U) != 0;
    right = (way & 2U) != 0;
    transposed = (way & 4U) != 0;
    inverted = (way & 8U) != 0;
  }

  /** Where in a grid of side x side the place i comes from. */
  int source(int i, int side) const
  {
    const int row = down ? side - 1 - i / side : i / side;
    const int col = right ? side - 1 - i % side : i % side;
    return transposed ? side * col + row : side * row + col;
  }
};

/** The blocks of gateInputs() or haarFeatures(). */
void varyBlocks(const float* blocks, const Variation& variation, float* varied)
{
  for (int i = 0; i < HAAR_BLOCKS; ++i)
  {
    const float* block = blocks + static_cast<std::ptrdiff_t>(BLOCK_FEATURES) * variation.source(i, WINDOW_CELLS / 2);
    float* to = varied + static_cast<std::ptrdiff_t>(BLOCK_FEATURES) * i;
    std::copy(block, block + BLOCK_FEATURES, to);
    to[0] = variation.inverted ? -to[0] : to[0];
    if (variation.transposed)
    {
      std::swap(to[3], to[4]);
    }
  }
}

/** A window as it would be had the camera been turned, the picture been mirrored, or dark and light been exchanged.
 * What belongs to no block or cell stays the same. @param inputs HAAR_FEATURES, or else GATE_INPUTS. */
void vary(const float* window, int inputs, cv::RNG& random, float* varied)
{
  const Variation variation(random);
  if (inputs != HAAR_FEATURES)
  {
    varyBlocks(window, variation, varied);
    return;
  }
  std::copy(window, window + FIRST_BLOCK_FEATURE, varied);
  varyBlocks(window + FIRST_BLOCK_FEATURE, variation, varied + FIRST_BLOCK_FEATURE);
  for (int i = 0; i < WINDOW_CELLS * WINDOW_CELLS; ++i)
  {
    const float cell = window[FIRST_CELL_FEATURE + variation.source(i, WINDOW_CELLS)];
    varied[FIRST_CELL_FEATURE + i] = variation.inverted ? -cell : cell;
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
  const double steps = static_cast<double>(epochs) * inputs.rows;
  double done = 0;
  for (int epoch = 0; epoch < epochs; ++epoch)
  {
    cv::randShuffle(order, 1, &random);
    for (int first = 0; first < inputs.rows; first += BATCH)
    {
      const int count = std::min(BATCH, inputs.rows - first);
      Batch batch = {cv::Mat(count, inputs.cols + 1, CV_32FC1, cv::Scalar(1)), {}, {}};  // the bias at the end
      for (int i = 0; i < count; ++i)
      {
        const int example = order[first + i];
        const auto* row = inputs.ptr<float>(example);
        auto* window = batch.windows.ptr<float>(i);
        varied ? vary(row, inputs.cols, random, window) : void(std::copy(row, row + inputs.cols, window));
        for (int k = 0; k < inputs.cols; ++k)
        {
          window[k] = (window[k] - scales.mean[k]) / scales.deviation[k];
        }
        batch.labels.push_back(examples.labels[example]);
        batch.weights.push_back(examples.weights[example] / BATCH);
      }
      done += count;
      learner.learn(batch, FIRST_STEP * .5 * (1 + std::cos(CV_PI * done / steps)));
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
