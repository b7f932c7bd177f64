#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "classification.h"
#include "image_files.h"
#include "marker_scene.h"
#include "network_training.h"

namespace
{
struct Options
{
  std::vector<std::string> photographs;
  std::string output;
  int scenes = 3000;
  int hidden = 40;
  int epochs = 12;
  int rounds = 3;
  int held_out = 4;
  unsigned seed = 1;
  double precision = .9995;
};

/** Larger photographs are shrunk to this: their finest detail is blur. */
constexpr double MAX_SIDE = 1200;
constexpr int MIN_SIDE = 100;

/** Shares of the windows that are learned from; the clutter of a photograph is drawn again in each round, and then only
 * what the network of the round before takes for a marker. */
constexpr double CHECKERBOARD_SHARE = .2;
constexpr double CLUTTER_SHARE = .006;
constexpr double HARD_SHARE = 1;
constexpr float HARD_SCORE = -.7F;

/** The photographs of all folders and their subfolders, in the order of their names; those that cannot be used are
 * told. */
std::vector<cv::Mat> readPhotographs(const std::vector<std::string>& folders)
{
  std::vector<std::string> names;
  for (const std::string& folder : folders)
  {
    if (!std::filesystem::is_directory(folder))
    {
      throw std::runtime_error("'" + folder + "' is not a folder");
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    {
      if (entry.is_regular_file())
      {
        names.push_back(entry.path());
      }
    }
  }
  std::sort(names.begin(), names.end());
  std::vector<cv::Mat> photographs;
  for (const std::string& name : names)
  {
    try
    {
      cv::Mat image = omr::readImage(name);
      const double shrink = MAX_SIDE / std::max(image.cols, image.rows);
      if (shrink < 1)
      {
        cv::resize(image, image, {}, shrink, shrink, cv::INTER_AREA);
      }
      if (std::min(image.cols, image.rows) < MIN_SIDE)
      {
        throw std::invalid_argument("narrower than " + std::to_string(MIN_SIDE) + " px");
      }
      photographs.push_back(image);
    }
    catch (const std::invalid_argument& error)
    {
      std::cerr << "omr_train: left out: " << name << ": " << error.what() << "\n";
    }
  }
  return photographs;
}

/** Of every few photographs one is held out. */
std::vector<cv::Mat> part(const std::vector<cv::Mat>& photographs, int held_out, bool held)
{
  std::vector<cv::Mat> chosen;
  for (std::size_t i = 0; i < photographs.size(); ++i)
  {
    if ((i % held_out == held_out - 1U) == held)
    {
      chosen.push_back(photographs[i]);
    }
  }
  return chosen;
}

using Wanted = std::function<bool(cv::RNG&, const float*, omr::WindowLabel)>;

/** Windows of count pictures, which work(i, random, windows) adds; in parallel, the same for any number of threads. */
template <typename Work>
omr::WindowSet collect(int count, unsigned seed, const Work& work)
{
  std::vector<omr::WindowSet> parts(count);
  cv::parallel_for_({0, count}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
    {
      cv::RNG random((static_cast<std::uint64_t>(seed) << 32) + i + 1);
      random.next();
      work(i, random, parts[i]);
    }
  });
  omr::WindowSet all;
  for (const omr::WindowSet& windows : parts)
  {
    all.append(windows);
  }
  return all;
}

omr::WindowSet sceneWindows(const std::vector<cv::Mat>& backgrounds, int count, unsigned seed, const Wanted& wanted)
{
  return collect(count, seed, [&](int /*i*/, cv::RNG& random, omr::WindowSet& windows) {
    const cv::Mat& background = backgrounds[random.uniform(0, static_cast<int>(backgrounds.size()))];
    const omr::MarkerScene scene = omr::renderMarkerScene(background, random);
    omr::addWindows(
        scene.image, scene.markers,
        [&](const float* features, omr::WindowLabel label) { return wanted(random, features, label); }, windows);
  });
}

omr::WindowSet photographWindows(const std::vector<cv::Mat>& photographs, unsigned seed, const Wanted& wanted)
{
  return collect(static_cast<int>(photographs.size()), seed, [&](int i, cv::RNG& random, omr::WindowSet& windows) {
    omr::addWindows(
        photographs[i], {},
        [&](const float* features, omr::WindowLabel label) { return wanted(random, features, label); }, windows);
  });
}

void printCounts(const char* name, const omr::WindowSet& windows)
{
  std::array<long, 3> counts = {};
  for (const omr::WindowLabel label : windows.labels)
  {
    counts[static_cast<int>(label)] += 1;
  }
  std::cout << name << ": " << counts[0] << " windows on checkerboards, " << counts[1] << " on targets, " << counts[2]
            << " on clutter" << std::endl;
}

cv::Ptr<cv::ml::ANN_MLP> train(const Options& options, const std::vector<cv::Mat>& photographs)
{
  const Wanted some = [](cv::RNG& random, const float* /*features*/, omr::WindowLabel label) {
    return label == omr::WindowLabel::target ||
           random.uniform(0., 1.) < (label == omr::WindowLabel::checkerboard ? CHECKERBOARD_SHARE : CLUTTER_SHARE);
  };
  omr::WindowSet windows = sceneWindows(photographs, options.scenes, 4 * options.seed, some);
  windows.append(photographWindows(photographs, 4 * options.seed + 1, some));
  printCounts("training", windows);
  cv::Ptr<cv::ml::ANN_MLP> trained = omr::trainNetwork(windows, options.hidden, options.epochs);
  for (int round = 1; round < options.rounds; ++round)
  {
    const omr::MarkerNetwork network = omr::toMarkerNetwork(*trained, {});
    windows.append(photographWindows(photographs, 4 * options.seed + 2,
                                     [&](cv::RNG& random, const float* features, omr::WindowLabel /*label*/) {
                                       if (random.uniform(0., 1.) >= HARD_SHARE)
                                       {
                                         return false;
                                       }
                                       const omr::MarkerScores scores = omr::markerScores(network, features);
                                       return std::max(scores[0], scores[1]) > HARD_SCORE;
                                     }));
    printCounts("with hard clutter", windows);
    trained = omr::trainNetwork(windows, options.hidden, options.epochs);
  }
  return trained;
}

/** The scores of all windows of pictures that training has not seen. */
omr::ScoreCounts holdOut(const Options& options, const std::vector<cv::Mat>& photographs,
                         const omr::MarkerNetwork& network)
{
  omr::ScoreCounts counts;
  std::mutex mutex;
  const Wanted score = [&](cv::RNG& /*random*/, const float* features, omr::WindowLabel label) {
    const omr::MarkerScores scores = omr::markerScores(network, features);
    const std::lock_guard<std::mutex> lock(mutex);
    counts.add(label, scores);
    return false;
  };
  const int scenes = std::max(1, options.scenes / options.held_out);
  counts.addPlain(sceneWindows(photographs, scenes, 4 * options.seed + 3, score));
  counts.addPlain(photographWindows(photographs, 0, score));
  return counts;
}

/** The smallest threshold from which on the precision holds; the largest one if none does. */
omr::Classification choose(const std::vector<omr::Classification>& curve, double precision)
{
  auto chosen = curve.end() - 1;
  while (chosen != curve.begin() && (chosen - 1)->precision() >= precision)
  {
    --chosen;
  }
  return *chosen;
}

std::string describe(const omr::Classification& at)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(4) << "threshold " << at.threshold << ": accuracy " << std::setprecision(2)
       << 100 * at.accuracy() << " %, precision " << 100 * at.precision() << " %, recall " << 100 * at.recall << " %, "
       << std::scientific << std::setprecision(1) << at.false_rate
       << " of the windows without a marker are taken for one";
  return text.str();
}

std::string date()
{
  const std::time_t now = std::time(nullptr);
  std::array<char, 16> text = {};
  std::strftime(text.data(), text.size(), "%Y-%m-%d", std::gmtime(&now));
  return text.data();
}

void run(const Options& options, const std::string& command)
{
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_ERROR);
  const std::vector<cv::Mat> photographs = readPhotographs(options.photographs);
  const std::vector<cv::Mat> learned = part(photographs, options.held_out, false);
  const std::vector<cv::Mat> held = part(photographs, options.held_out, true);
  if (held.empty())
  {
    throw std::runtime_error("there are " + std::to_string(photographs.size()) +
                             " photographs, too few to hold out one of " + std::to_string(options.held_out));
  }
  std::ofstream file = omr::openOutput(options.output);  // before the work, which takes minutes
  std::ostringstream report;
  report << command << "\n"
         << date() << ", " << learned.size() << " photographs and " << options.scenes
         << " scenes; held out: " << held.size() << " photographs and "
         << std::max(1, options.scenes / options.held_out) << " scenes\n";
  omr::MarkerNetwork network = omr::toMarkerNetwork(*train(options, learned), {1, 1});
  const omr::ScoreCounts counts = holdOut(options, held, network);
  for (const omr::MarkerKind kind : {omr::MarkerKind::checkerboard, omr::MarkerKind::target})
  {
    const char* name = kind == omr::MarkerKind::checkerboard ? "checkerboard" : "target";
    const std::vector<omr::Classification> curve = counts.curve(kind);
    std::cout << name << ", held out: " << counts.count(static_cast<omr::WindowLabel>(kind)) << " windows with one, "
              << counts.count(omr::WindowLabel::clutter) << " without any\n";
    for (const double precision : {.9, .99, .999, .9995, .9998, .9999, .99995, .99998, .99999})
    {
      std::cout << "  " << describe(choose(curve, precision)) << "\n";
    }
    const omr::Classification chosen = choose(curve, options.precision);
    network.thresholds[static_cast<int>(kind)] = static_cast<float>(chosen.threshold);
    report << name << ", " << describe(chosen) << "\n";
  }
  std::cout << report.str();
  std::istringstream lines(report.str());
  for (std::string line; std::getline(lines, line);)
  {
    file << "# " << line << "\n";
  }
  omr::writeMarkerNetwork(file, network);
  if (!file.flush())
  {
    throw std::runtime_error("cannot write '" + options.output + "'");
  }
}

int parseAndRun(int argc, char** argv)
{
  Options options;
  CLI::App app("Trains the network that finds candidates, from photographs without markers and rendered markers.");
  app.add_option("--output", options.output, "yaml file for the network")->required();
  app.add_option("--scenes", options.scenes, "rendered scenes to learn from")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  app.add_option("--hidden", options.hidden, "units of the hidden layer")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  app.add_option("--epochs", options.epochs, "passes over the windows")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--rounds", options.rounds, "trainings; after each, hard clutter is added")
      ->capture_default_str()
      ->check(CLI::Range(1, 20));
  app.add_option("--held-out", options.held_out, "of so many photographs one is held out")
      ->capture_default_str()
      ->check(CLI::Range(2, 100));
  app.add_option("--precision", options.precision,
                 "precision that chooses the thresholds, as if every second window showed a marker")
      ->capture_default_str()
      ->check(CLI::Range(.5, 1.));
  app.add_option("--seed", options.seed, "equal seeds and photographs give equal networks")->capture_default_str();
  app.add_option("photographs", options.photographs, "folders of photographs without markers")->required();
  app.footer("Exit code: 0; 2 when nothing could be done.");
  try
  {
    app.parse(argc, argv);
    std::string command = "omr_train";
    for (int i = 1; i < argc; ++i)
    {
      command += std::string(" ") + argv[i];
    }
    run(options, command);
    return 0;
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? 0 : 2;
  }
}
}  // namespace

int main(int argc, char** argv)
{
  try
  {
    return parseAndRun(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::cerr << "omr_train: " << error.what() << "\n";
    return 2;
  }
}
