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

cv::Ptr<cv::ml::ANN_MLP> trainNetwork(const cv::Mat& inputs, const std::vector<WindowLabel>& labels, int hidden,
                                      int epochs)
{
  cv::Mat answers(inputs.rows, MARKER_KINDS, CV_32FC1, cv::Scalar(-1));
  for (int i = 0; i < answers.rows; ++i)
  {
    if (labels[i] == WindowLabel::checkerboard || labels[i] == WindowLabel::target)
    {
      answers.at<float>(i, static_cast<int>(labels[i])) = 1;
    }
  }
  const auto data = cv::ml::TrainData::create(inputs, cv::ml::ROW_SAMPLE, answers);
  const cv::Ptr<cv::ml::ANN_MLP> network = cv::ml::ANN_MLP::create();
  network->setLayerSizes(cv::Mat(cv::Vec3i(inputs.cols, hidden, MARKER_KINDS)));
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

FeedForward toFeedForward(const cv::ml::ANN_MLP& trained, const MarkerScores& thresholds)
{
  // OpenCV: layer 0 holds scale and offset of each input, 1 and 2 the weights with the bias in the last row.
  const cv::Mat scale = trained.getWeights(0);
  const cv::Mat first = trained.getWeights(1);
  const cv::Mat second = trained.getWeights(2);
  const int inputs = first.rows - 1;
  FeedForward network;
  network.hidden = first.cols;
  network.thresholds = thresholds;
  for (int unit = 0; unit < first.cols; ++unit)
  {
    double bias = first.at<double>(inputs, unit);
    std::vector<float> weights;
    for (int i = 0; i < inputs; ++i)
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
