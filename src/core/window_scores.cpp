#include "outdoor_omr/window_scores.h"

#include <array>

#include "outdoor_omr/each_window.h"

namespace omr
{
int windowCount(const cv::Size& size)
{
  int count = 0;
  for (int level = 0; level < HAAR_LEVELS; ++level)
  {
    count += windowGrid(size, level).area();
  }
  return count;
}

std::vector<MarkerScores> windowScores(const cv::Mat& bgr, const MarkerNetwork& network)
{
  std::vector<MarkerScores> scores;
  scores.reserve(windowCount(bgr.size()));
  std::array<float, HAAR_FEATURES> features = {};
  forEachWindow(bgr, [&](const cv::Mat& cells, const cv::Point& first, const cv::Point& /*index*/, int /*level*/) {
    const bool looked = passesGate(cells, first, network.gate) && haarFeatures(cells, first, features.data());
    scores.push_back(looked ? markerScores(network, features.data()) : MarkerScores{-1, -1});
  });
  return scores;
}

bool passesGate(const cv::Mat& cells, const cv::Point& first, const FeedForward& gate)
{
  if (gate.hidden == 0)
  {
    return true;
  }
  std::array<float, GATE_INPUTS> inputs;
  return gateInputs(cells, first, inputs.data()) && gate.passes(markerScores(gate, GATE_INPUTS, inputs.data()));
}

}  // namespace omr
