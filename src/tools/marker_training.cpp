#include "marker_training.h"

#include <algorithm>
#include <cmath>
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
constexpr float HARD_SCORE = -.8F;

/** Of the clutter that is looked at for what is hard: windows overlap, and features take most of the time. */
constexpr double HARD_SHARE = .5;

/** Passes of the rounds that only serve to find hard clutter, of those of the last one. */
constexpr double EARLY_EPOCHS = .34;

/** Share of the windows with a marker that the gate loses where hard clutter is looked for. */
constexpr double LOST_IN_TRAINING = .03;

/** How much clutter that is drawn counts: less than it stands for, because hard clutter is learned from again. Five
 * instead of one: recall of checkerboards 86.2 -> 87.6 %, of targets 84.5 -> 85.2 % (docs/candidates.md). */
constexpr float CLUTTER_WEIGHT = 10;

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

}  // namespace

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

MarkerNetwork trainMarkerNetwork(const TrainingPictures& pictures, const TrainingOptions& options)
{
  const TrainingPictures::Drawn some = [](cv::RNG& random, WindowLabel label) {
    return label == WindowLabel::target ||
           random.uniform(0., 1.) < (label == WindowLabel::checkerboard ? CHECKERBOARD_SHARE : CLUTTER_SHARE);
  };
  const unsigned seed = 8 * options.seed;
  WindowSet windows = pictures.windows(true, seed, {}, some, TrainingPictures::any);
  windows.append(pictures.windows(false, seed + 1, {}, some, TrainingPictures::any));
  printCounts("training", windows);
  MarkerNetwork network;
  FeedForward& gate = network.gate;
  std::vector<float> weights(windows.labels.size(), 1);
  gate = trainNetwork({windows.gate, windows.labels, weights}, options.gate, options.epochs, true);
  gate.thresholds = gateThresholds(gate, windows, LOST_IN_TRAINING);
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    weights[i] = windows.labels[i] == WindowLabel::clutter ? CLUTTER_WEIGHT : 1;
  }
  for (int round = 0; round < options.rounds; ++round)
  {
    const TrainingPictures::Wanted hard = [&](const float* features, WindowLabel /*label*/) {
      const MarkerScores scores = markerScores(network, features);
      return std::max(scores[0], scores[1]) > HARD_SCORE;
    };
    const TrainingPictures::Drawn half = [](cv::RNG& random, WindowLabel /*label*/) {
      return random.uniform(0., 1.) < HARD_SHARE;
    };
    if (round > 0)
    {
      windows.append(pictures.windows(false, seed + 1 + round, gate, half, hard));
      weights.resize(windows.labels.size(), static_cast<float>(1 / HARD_SHARE));
      printCounts("with hard clutter", windows);
    }
    const bool last = round + 1 == options.rounds;
    const int epochs = last ? options.epochs : static_cast<int>(std::ceil(EARLY_EPOCHS * options.epochs));
    static_cast<FeedForward&>(network) =
        trainNetwork({windows.features, windows.labels, weights}, options.hidden, epochs, true);
  }
  return network;
}

}  // namespace omr
