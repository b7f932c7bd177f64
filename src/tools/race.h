#ifndef OUTDOOR_OMR_TOOLS_RACE_H
#define OUTDOOR_OMR_TOOLS_RACE_H

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace omr
{
/** An image to time something on; drawn or read when it is needed, because a few of 8K fill the memory. */
struct Picture
{
  std::string name;
  std::function<cv::Mat()> make;  ///< CV_8UC3
};

/** Something to time: prepare() makes of an image what is called again and again. */
struct Contestant
{
  std::string name;
  std::function<std::function<void()>(const cv::Mat& image)> prepare;
};

/** Wall clock and CPU time of all threads of the process, round by round [ms]. */
struct Samples
{
  std::vector<double> wall;
  std::vector<double> cpu;

  /** Times one call. */
  void add(const std::function<void()>& action);
};

/** The value below which the share [0, 1] of the values lie; 0 of none. */
double quantile(std::vector<double> values, double share);

/**
 * Registers with Google Benchmark a race of ours against a peer on a picture, "picture/ours/peer": they take turns in
 * every round, so that what else the machine does slows both. Its counters:
 *
 * ms, peer_ms          medians, wall clock
 * cpu_ms, peer_cpu_ms  medians, CPU time of all threads
 * p99_ms               of ours, wall clock
 * calm_cpu_ms, peer_calm_cpu_ms  lowest deciles of the CPU times: what the rest of the machine disturbed least
 * ratio, cpu_ratio     median over the rounds of ours / peer
 */
void registerRace(const Picture& picture, const Contestant& ours, const Contestant& peer);

}  // namespace omr

#endif
