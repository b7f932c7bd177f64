#include "network_training.h"

#include <iomanip>

#include "outdoor_omr/haar_features.h"

namespace omr
{
namespace
{
/** Step and momentum of the descent, and what the step shrinks by in an epoch. Ten times larger steps diverge. */
constexpr double FIRST_STEP = .01;
constexpr double MOMENTUM = .5;
constexpr double SHRINKING = .75;

void writeUnits(std::ostream& stream, const float*& weights, int units, int inputs)
{
  for (int unit = 0; unit < units; ++unit)
  {
    stream << "  - [";
    for (int i = 0; i <= inputs; ++i)
    {
      stream << (i == 0 ? "" : ", ") << *weights++;
    }
    stream << "]\n";
  }
}
}  // namespace

cv::Ptr<cv::ml::ANN_MLP> trainNetwork(const WindowSet& windows, int hidden, int epochs)
{
  cv::Mat answers(windows.features.rows, MARKER_KINDS, CV_32FC1, cv::Scalar(-1));
  for (int i = 0; i < answers.rows; ++i)
  {
    if (windows.labels[i] == WindowLabel::checkerboard || windows.labels[i] == WindowLabel::target)
    {
      answers.at<float>(i, static_cast<int>(windows.labels[i])) = 1;
    }
  }
  const auto data = cv::ml::TrainData::create(windows.features, cv::ml::ROW_SAMPLE, answers);
  const cv::Ptr<cv::ml::ANN_MLP> network = cv::ml::ANN_MLP::create();
  network->setLayerSizes(cv::Mat(cv::Vec3i(HAAR_FEATURES, hidden, MARKER_KINDS)));
  network->setActivationFunction(cv::ml::ANN_MLP::SIGMOID_SYM, 1, 1);
  network->setTermCriteria({cv::TermCriteria::COUNT, 1, 0});
  int flags = cv::ml::ANN_MLP::NO_OUTPUT_SCALE;
  double step = FIRST_STEP;
  for (int epoch = 0; epoch < epochs; ++epoch)
  {
    network->setTrainMethod(cv::ml::ANN_MLP::BACKPROP, step, MOMENTUM);
    network->train(data, flags);
    flags |= cv::ml::ANN_MLP::UPDATE_WEIGHTS | cv::ml::ANN_MLP::NO_INPUT_SCALE;
    step *= SHRINKING;
  }
  return network;
}

MarkerNetwork toMarkerNetwork(const cv::ml::ANN_MLP& trained, const MarkerScores& thresholds)
{
  // OpenCV: layer 0 holds scale and offset of each input, 1 and 2 the weights with the bias in the last row.
  const cv::Mat scale = trained.getWeights(0);
  const cv::Mat first = trained.getWeights(1);
  const cv::Mat second = trained.getWeights(2);
  MarkerNetwork network;
  network.hidden = first.cols;
  network.thresholds = thresholds;
  for (int unit = 0; unit < first.cols; ++unit)
  {
    double bias = first.at<double>(HAAR_FEATURES, unit);
    std::vector<float> weights;
    for (int i = 0; i < HAAR_FEATURES; ++i)
    {
      bias += first.at<double>(i, unit) * scale.at<double>(0, 2 * i + 1);
      weights.push_back(static_cast<float>(first.at<double>(i, unit) * scale.at<double>(0, 2 * i)));
    }
    network.weights.push_back(static_cast<float>(bias));
    network.weights.insert(network.weights.end(), weights.begin(), weights.end());
  }
  for (int output = 0; output < second.cols; ++output)
  {
    network.weights.push_back(static_cast<float>(second.at<double>(second.rows - 1, output)));
    for (int unit = 0; unit < first.cols; ++unit)
    {
      network.weights.push_back(static_cast<float>(second.at<double>(unit, output)));
    }
  }
  return network;
}

void writeMarkerNetwork(std::ostream& stream, const MarkerNetwork& network)
{
  stream << std::setprecision(5) << "thresholds: {checkerboard: " << network.thresholds[0]
         << ", target: " << network.thresholds[1] << "}\n";
  const float* weights = network.weights.data();
  stream << "hidden_units:  # bias, then a weight for each of the " << HAAR_FEATURES << " features\n";
  writeUnits(stream, weights, network.hidden, HAAR_FEATURES);
  stream << "output_units:  # checkerboard, target: bias, then a weight for each hidden unit\n";
  writeUnits(stream, weights, MARKER_KINDS, network.hidden);
}

}  // namespace omr
