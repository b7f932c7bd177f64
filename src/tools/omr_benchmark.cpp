// Times the steps of the fill pipeline and the whole detector beside what others offer for the same job, in turn, on
// drawn scenes, on hard cases and on photographs. Google Benchmark's own options apply; the counters say more than its
// columns: see race.h. scripts/benchmark makes a table of the ratios.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "edge_patterns.h"
#include "our_steps.h"
#include "outdoor_omr/detector.h"
#include "outdoor_omr/reference_fill.h"
#include "peers.h"
#include "program.h"
#include "race.h"
#include "scene.h"

using omr::Contestant;
using omr::FillMethod;
using omr::Filter;
using omr::OurSteps;
using omr::Picture;
using omr::registerRace;
using omr::Settings;

namespace
{
const std::vector<cv::Size> SIZES = {{512, 512}, {640, 480}, {1280, 720}, {1920, 1080}, {3840, 2160}, {7680, 4320}};
const cv::Size FULL_HD(1920, 1080);
constexpr std::array<Filter, 3> FILTERS = {Filter::none, Filter::gaussian, Filter::median};

struct Options
{
  std::string device = "auto";
  std::vector<std::string> files;
  std::vector<int> squares = {5, 7};
  int threads = 0;
};

std::string nameOf(const cv::Size& size)
{
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

Settings settingsOf(Filter filter, FillMethod method = FillMethod::runs)
{
  Settings settings;
  settings.filter = filter;
  settings.fill_method = method;
  settings.sweep_rounds = 100000;  // the sweeps settle
  return settings;
}

cv::Mat edgesOfImage(const cv::Mat& image)
{
  return omr::edgeMask(image, omr::edgeThreshold(Settings()));
}

/** Black pixels are edges. */
cv::Mat edgesOfPattern(const cv::Mat& image)
{
  cv::Mat channel;
  cv::extractChannel(image, channel, 0);
  return channel == 0;
}

cv::Mat patternImage(const cv::Mat& edges)
{
  cv::Mat image;
  cv::cvtColor(edges == 0, image, cv::COLOR_GRAY2BGR);
  return image;
}

/** Everything on a picture that the goals speak of. */
void addSteps(const Picture& picture, const OurSteps& ours)
{
  for (const int size : {3, 5})
  {
    registerRace(picture, ours.filter(Filter::gaussian, size), omr::gaussianPeer(size));
    registerRace(picture, ours.filter(Filter::median, size), omr::medianPeer(size));
  }
  registerRace(picture, ours.edges(), omr::sobelPeer());
  registerRace(picture, ours.labels(edgesOfImage, FillMethod::runs), omr::componentsPeer(edgesOfImage));
  registerRace(picture, ours.labelsAndRegionData(edgesOfImage, FillMethod::runs),
               omr::componentsWithStatsPeer(edgesOfImage));
  registerRace(picture, ours.pipeline(settingsOf(Filter::gaussian)), omr::chainPeer(edgesOfImage));
  registerRace(picture, ours.pipeline(settingsOf(Filter::gaussian), true), omr::memcpyPeer());
  for (const Filter filter : FILTERS)
  {
    registerRace(picture, ours.pipeline(settingsOf(filter)), omr::memcpyPeer());
    registerRace(picture, ours.detector(settingsOf(filter)), omr::memcpyPeer());
  }
}

/** Edge masks and images that are hard for a labelling algorithm, or easy. */
void addHardCases(const OurSteps& ours)
{
  for (std::size_t i = 0; i < omr::edgePatterns({1, 1}).size(); ++i)
  {
    const Picture picture = {omr::edgePatterns({1, 1})[i].name + " " + nameOf(FULL_HD),
                             [i] { return patternImage(omr::edgePatterns(FULL_HD)[i].edges); }};
    registerRace(picture, ours.labels(edgesOfPattern, FillMethod::runs), omr::componentsPeer(edgesOfPattern));
    registerRace(picture, ours.labelsAndRegionData(edgesOfPattern, FillMethod::runs),
                 omr::componentsWithStatsPeer(edgesOfPattern));
    registerRace(picture, ours.pipeline(settingsOf(Filter::none)), omr::memcpyPeer());
  }
  const auto noise = [] {
    cv::Mat image(FULL_HD, CV_8UC3);
    cv::theRNG().state = 5;
    cv::randu(image, 0, 256);
    return image;
  };
  for (const Picture& picture :
       {Picture{"noise image " + nameOf(FULL_HD), noise}, Picture{"40 boards " + nameOf(FULL_HD), [] {
                                                                    return omr::drawBoards(FULL_HD, {8, 5}, {7, 5});
                                                                  }}})
  {
    for (const Filter filter : FILTERS)
    {
      registerRace(picture, ours.pipeline(settingsOf(filter)), omr::memcpyPeer());
      registerRace(picture, ours.detector(settingsOf(filter)), omr::memcpyPeer());
    }
  }
}

void addDetectors(const Picture& picture, const OurSteps& ours, const cv::Size& squares)
{
  for (const Contestant& peer : omr::detectorPeers(squares))
  {
    registerRace(picture, ours.detector(Settings()), peer);
  }
}

/** The paper's Tables 6 and 7 and its 1200 x 1000 case, by its own sweeps and by runs. */
void addPaper(const OurSteps& ours)
{
  const auto add = [&](const Picture& picture) {
    registerRace(picture, ours.filter(Filter::median, 3), omr::medianPeer(3));
    for (const FillMethod method : {FillMethod::sweep, FillMethod::runs})
    {
      registerRace(picture, ours.labels(edgesOfImage, method), omr::componentsPeer(edgesOfImage));
      registerRace(picture, ours.labelsAndRegionData(edgesOfImage, method), omr::componentsWithStatsPeer(edgesOfImage));
      registerRace(picture, ours.pipeline(settingsOf(Filter::median, method)), omr::memcpyPeer());
    }
  };
  add({"paper Table 6 1920x1080", [] { return omr::drawScene(FULL_HD); }});
  add({"paper Table 7 512x512", [] { return omr::drawScene({512, 512}); }});
  add({"paper Fig. 17 1200x1000", omr::drawPaperShapes});
}

/** Several cameras of one computer: a thread with a detector of its own each. */
void cameras(benchmark::State& state, const std::string& device, const cv::Size& size)
{
  constexpr int FRAMES = 4;
  const cv::Mat scene = omr::drawScene(size);
  const int count = static_cast<int>(state.range(0));
  std::vector<omr::Detector> detectors;
  detectors.reserve(count);
  std::vector<omr::Samples> times(count);
  for (int i = 0; i < count; ++i)
  {
    detectors.emplace_back(device);
    detectors.back().detect(scene, Settings());
  }
  omr::Samples rounds;
  for (auto _ : state)
  {
    rounds.add([&] {
      std::vector<std::thread> threads;
      threads.reserve(count);
      for (int i = 0; i < count; ++i)
      {
        threads.emplace_back([&, i] {
          for (int frame = 0; frame < FRAMES; ++frame)
          {
            times[i].add([&] { detectors[i].detect(scene, Settings()); });
          }
        });
      }
      for (std::thread& thread : threads)
      {
        thread.join();
      }
    });
  }
  std::vector<double> frames;
  for (const omr::Samples& samples : times)
  {
    frames.insert(frames.end(), samples.wall.begin(), samples.wall.end());
  }
  state.counters["ms"] = omr::quantile(frames, 0.5);
  state.counters["p99_ms"] = omr::quantile(frames, 0.99);
  state.counters["cpu_ms"] = omr::quantile(rounds.cpu, 0.5) / (FRAMES * count);
  state.counters["frames_per_second"] = 1e3 * FRAMES * count / omr::quantile(rounds.wall, 0.5);
}

void addCameras(const std::string& device)
{
  for (const cv::Size& size : {cv::Size(1280, 720), FULL_HD})
  {
    benchmark::RegisterBenchmark(("cameras " + nameOf(size)).c_str(),
                                 [=](benchmark::State& state) { cameras(state, device, size); })
        ->Arg(1)
        ->Arg(2)
        ->Arg(4)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
}

cv::Mat readImage(const std::string& file)
{
  cv::Mat bgr = cv::imread(file, cv::IMREAD_COLOR);
  if (bgr.empty())
  {
    throw std::runtime_error("cannot read the image " + file);
  }
  return bgr;
}

void addPictures(const OurSteps& ours, const Options& options)
{
  for (const std::string& file : options.files)
  {
    const std::string name = file.substr(file.find_last_of('/') + 1) + " ";
    readImage(file);  // complains now, not after an hour
    for (const cv::Size& size : SIZES)
    {
      addSteps({name + nameOf(size),
                [=] {
                  cv::Mat scaled;
                  cv::resize(readImage(file), scaled, size, 0, 0, cv::INTER_AREA);
                  return scaled;
                }},
               ours);
    }
    addDetectors({name + "original", [=] { return readImage(file); }}, ours, {options.squares[0], options.squares[1]});
  }
  for (const cv::Size& size : SIZES)
  {
    addSteps({"scene " + nameOf(size), [=] { return omr::drawScene(size); }}, ours);
  }
}

void declare(CLI::App& app, Options& options)
{
  app.description("Times the fill pipeline, the detector and what others offer for the same job.");
  app.add_option("--device", options.device, "OpenCL device: auto, gpu, cpu or a part of its name");
  app.add_option("--threads", options.threads, "Threads of OpenCV and of PoCL's CPU device (default: all cores)");
  app.add_option("--squares", options.squares, "Columns and rows of the boards in the image files, for the peers")
      ->expected(2)
      ->capture_default_str();
  app.add_option("images", options.files, "Image files, each of them scaled to all sizes");
}

omr::ExitCode run(const Options& options)
{
  if (options.threads > 0)
  {
    cv::setNumThreads(options.threads);
    setenv("POCL_MAX_PTHREAD_COUNT", std::to_string(options.threads).c_str(), 1);
  }
  const OurSteps ours(options.device);
  std::cerr << "device: " << ours.deviceName() << "\n";
  addPictures(ours, options);
  addHardCases(ours);
  for (const cv::Size& size : SIZES)
  {
    if (size.area() <= FULL_HD.area())  // beyond, findChessboardCornersSB takes a minute
    {
      addDetectors({"one board " + nameOf(size),
                    [=] {
                      return omr::drawBoards(size, {1, 1}, {11, 11});
                    }},
                   ours, {11, 11});
    }
  }
  addPaper(ours);
  addCameras(options.device);
  benchmark::RunSpecifiedBenchmarks();
  return omr::SUCCESS;
}
}  // namespace

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  return omr::runProgram<Options>("omr_benchmark", argc, argv, declare, run);
}
