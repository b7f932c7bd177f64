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

/** A network of one hidden layer while it learns, by the gradient of the cross-entropy. Inputs have about unit
 * variance.
 */
class Learner
{
 public:
  Learner(int inputs, int hidden, cv::RNG& random);

  /** Adds to the gradient. @param window its inputs, and a one for the bias. @param weight of what it adds. */
  void learn(const float* window, WindowLabel label, float weight);

  /** Moves all weights against the gradient, about by `size` each, and begins a new one. */
  void step(double size);

  /** The network for inputs as they are. @param means, deviations of each input, by which it was scaled. */
  FeedForward network(const std::vector<float>& means, const std::vector<float>& deviations) const;

 private:
  int inputs_, hidden_;
  Descent first_;   ///< of each input, and then the bias: a weight for each hidden unit
  Descent second_;  ///< of each kind: a weight for each hidden unit, and the bias
  std::vector<float> active_, derivatives_;
  int steps_ = 0;
};

}  // namespace omr

#endif
