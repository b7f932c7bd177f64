#include "race.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>

namespace omr
{
namespace
{
using Clock = std::chrono::steady_clock;

double cpuMilliseconds()
{
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

std::vector<double> ratios(const std::vector<double>& ours, const std::vector<double>& peers)
{
  std::vector<double> all(ours.size());
  std::transform(ours.begin(), ours.end(), peers.begin(), all.begin(), [](double a, double b) { return a / b; });
  return all;
}

/** The last picture, so that the races on one picture share it and the next one replaces it. */
const cv::Mat& imageOf(const Picture& picture)
{
  static std::string name;
  static cv::Mat image;
  if (name != picture.name)
  {
    image.release();
    image = picture.make();
    name = picture.name;
  }
  return image;
}

void race(benchmark::State& state, const Picture& picture, const Contestant& ours, const Contestant& peer)
{
  const cv::Mat& image = imageOf(picture);
  const std::function<void()> our_action = ours.prepare(image);
  const std::function<void()> peer_action = peer.prepare(image);
  our_action();  // the first run grows buffers
  peer_action();
  Samples our_times;
  Samples peer_times;
  for (auto _ : state)
  {
    our_times.add(our_action);
    peer_times.add(peer_action);
  }
  state.counters["ms"] = quantile(our_times.wall, 0.5);
  state.counters["peer_ms"] = quantile(peer_times.wall, 0.5);
  state.counters["cpu_ms"] = quantile(our_times.cpu, 0.5);
  state.counters["peer_cpu_ms"] = quantile(peer_times.cpu, 0.5);
  state.counters["p99_ms"] = quantile(our_times.wall, 0.99);
  state.counters["ratio"] = quantile(ratios(our_times.wall, peer_times.wall), 0.5);
  state.counters["cpu_ratio"] = quantile(ratios(our_times.cpu, peer_times.cpu), 0.5);
  state.counters["calm_cpu_ms"] = quantile(our_times.cpu, 0.1);
  state.counters["peer_calm_cpu_ms"] = quantile(peer_times.cpu, 0.1);
}
}  // namespace

void Samples::add(const std::function<void()>& action)
{
  const double cpu_start = cpuMilliseconds();
  const Clock::time_point start = Clock::now();
  action();
  wall.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  // Linux adds a thread's time to its process's when the thread sleeps: let those that did the work do so.
  std::this_thread::sleep_for(std::chrono::microseconds(200));
  cpu.push_back(cpuMilliseconds() - cpu_start);
}

double quantile(std::vector<double> values, double share)
{
  if (values.empty())
  {
    return 0;
  }
  const auto rank = std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[rank];
}

void registerRace(const Picture& picture, const Contestant& ours, const Contestant& peer)
{
  const std::string name = picture.name + "/" + ours.name + "/" + peer.name;
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { race(state, picture, ours, peer); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace omr
