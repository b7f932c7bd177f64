#ifndef OUTDOOR_OMR_TOOLS_LEARNER_H
#define OUTDOOR_OMR_TOOLS_LEARNER_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/marker_network.h"
#include "training_windows.h"

namespace omr
{
/** Parameters that descend along their gradient (Adam; Kingma and Ba 2015). */
struct Descent
{
  std::vector<float> values, gradient, mean, square;

  /** @param spread of the random first values. */
  Descent(std::size_t count, float spread, cv::RNG& random);

  /** One step against the gradient, which is 0 then. @param size of it. @param steps so far, with this one. */
  void step(float size, int steps);
};

/** Windows that are learned from together. */
struct Batch
{
  cv::Mat windows;  ///< N x (inputs + 1), CV_32FC1: inputs of about unit variance, and a one for the bias
  std::vector<WindowLabel> labels;
  std::vector<float> weights;  ///< of what they add to the gradient
};

/** A network of one hidden layer while it learns, by the gradient of the cross-entropy. */
class Learner
{
 public:
  Learner(int inputs, int hidden, cv::RNG& random);

  /** Moves all weights against the gradient of a batch, about by `size` each; the same on any number of threads. */
  void learn(const Batch& batch, double size);

  /** The network for inputs as they are. @param means, deviations of each input, by which it was scaled. */
  FeedForward network(const std::vector<float>& means, const std::vector<float>& deviations) const;

 private:
  float weight(int unit, int input) const;
  void propagateErrors(const Batch& batch);

  int inputs_, hidden_;
  std::vector<Descent> first_;  ///< of some units each: of every input, and then the bias, a weight a unit
  Descent second_;              ///< of each kind: a weight for each hidden unit, and the bias
  cv::Mat active_;              ///< of each window of the batch its units
  cv::Mat derivatives_;
  int steps_ = 0;
};

}  // namespace omr

#endif
