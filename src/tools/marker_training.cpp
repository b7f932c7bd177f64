#include "marker_training.h"

#include <algorithm>
#include <iostream>

#include "network_training.h"

namespace omr
{
namespace
{
/** Shares of the windows that are learned from; the clutter of a photograph is drawn again in each round, and then only
 * what the network of the round before takes for a marker. */
constexpr double CHECKERBOARD_SHARE = .3;
constexpr double CLUTTER_SHARE = .006;
constexpr float HARD_SCORE = -.7F;

void printCounts(const char* name, const WindowSet& windows)
{
  std::array<long, 3> counts = {};
  for (const WindowLabel label : windows.labels)
  {
    counts[static_cast<int>(label)] += 1;
  }
  std::cout << name << ": " << counts[0] << " windows on checkerboards, " << counts[1] << " on targets, " << counts[2]
            << " on clutter" << std::endl;
}

/** The thresholds at which the gate loses a share of the windows of each kind. */
MarkerScores gateThresholds(const FeedForward& gate, const WindowSet& windows, double lost)
{
  std::array<std::vector<float>, MARKER_KINDS> scores;
  for (std::size_t i = 0; i < windows.labels.size(); ++i)
  {
    const int label = static_cast<int>(windows.labels[i]);
    if (label < MARKER_KINDS)
    {
      const auto* inputs = windows.gate.ptr<float>(static_cast<int>(i));
      scores[label].push_back(markerScores(gate, GATE_INPUTS, inputs)[label]);
    }
  }
  MarkerScores thresholds = {-1, -1};
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    if (!scores[kind].empty())
    {
      std::sort(scores[kind].begin(), scores[kind].end());
      thresholds[kind] = scores[kind][static_cast<std::size_t>(lost * (scores[kind].size() - 1.))];
    }
  }
  return thresholds;
}
}  // namespace

MarkerNetwork trainMarkerNetwork(const TrainingPictures& pictures, const TrainingOptions& options)
{
  const TrainingPictures::Wanted some = [](cv::RNG& random, const float* /*features*/, WindowLabel label) {
    return label == WindowLabel::target ||
           random.uniform(0., 1.) < (label == WindowLabel::checkerboard ? CHECKERBOARD_SHARE : CLUTTER_SHARE);
  };
  const unsigned seed = 8 * options.seed;
  WindowSet windows = pictures.windows(true, seed, {}, some);
  windows.append(pictures.windows(false, seed + 1, {}, some));
  printCounts("training", windows);
  MarkerNetwork network;
  FeedForward& gate = network.gate;
  gate = toFeedForward(*trainNetwork(windows.gate, windows.labels, options.gate, options.epochs), {});
  gate.thresholds = gateThresholds(gate, windows, options.lost);
  for (int round = 0; round < options.rounds; ++round)
  {
    const TrainingPictures::Wanted hard = [&](cv::RNG& /*random*/, const float* features, WindowLabel /*label*/) {
      const MarkerScores scores = markerScores(network, features);
      return std::max(scores[0], scores[1]) > HARD_SCORE;
    };
    if (round > 0)
    {
      windows.append(pictures.windows(false, seed + 1 + round, gate, hard));
      printCounts("with hard clutter", windows);
    }
    static_cast<FeedForward&>(network) =
        toFeedForward(*trainNetwork(windows.features, windows.labels, options.hidden, options.epochs), {1, 1});
  }
  return network;
}

}  // namespace omr
