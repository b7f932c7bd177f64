#include <algorithm>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <sstream>

#include "box_training.h"
#include "classification.h"
#include "image_files.h"
#include "marker_training.h"
#include "network_training.h"
#include "photographs.h"
#include "program.h"
#include "training_pictures.h"

namespace
{
struct Options : omr::TrainingOptions
{
  std::vector<std::string> photographs;
  std::string output;
  std::string network;
  int scenes = 3000;
  int held_out = 4;
  int held_out_scenes = 750;
  double lost = .03;
  double precision = .9995;
  double enlarged = .5;
  double shown = .027;
};

/** The scenes that are held out are those of no seed of the training. */
constexpr unsigned HELD_OUT_SEED = 4000000000U;

/** The precision of the goal, and about the share of the windows that show a marker in the paper's test: an accuracy of
 * 99.5 % at a recall of 90 % without a false one is .05 * .9 + .95. */
constexpr double GOAL_PRECISION = .999;
constexpr double PAPER_SHARE = .05;

/** The scores of all windows of pictures that training has not seen. */
omr::ScoreCounts holdOut(const omr::TrainingPictures& pictures, const omr::MarkerNetwork& network)
{
  omr::ScoreCounts counts;
  std::mutex mutex;
  const omr::TrainingPictures::Wanted score = [&](const float* features, omr::WindowLabel label) {
    const omr::MarkerScores scores = omr::markerScores(network, features);
    const std::lock_guard<std::mutex> lock(mutex);
    counts.add(label, scores);
    return false;
  };
  counts.addPlain(pictures.windows(true, HELD_OUT_SEED, network.gate, omr::TrainingPictures::all, score));
  counts.addPlain(pictures.windows(false, HELD_OUT_SEED + 1, network.gate, omr::TrainingPictures::all, score));
  return counts;
}

/** The windows with a marker of pictures that training has not seen. */
omr::WindowSet heldOutMarkers(const omr::TrainingPictures& pictures)
{
  const omr::TrainingPictures::Drawn marker = [](cv::RNG& /*random*/, omr::WindowLabel label) {
    return label != omr::WindowLabel::clutter;
  };
  return pictures.windows(true, HELD_OUT_SEED, {}, marker, omr::TrainingPictures::any);
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

/** What a threshold gives where half of all windows show a marker, and where as few do as in the paper. */
void printShares(const char* name, const omr::Classification& at)
{
  std::cout << "  " << name << ", threshold " << std::fixed << std::setprecision(4) << at.threshold << ": recall "
            << std::setprecision(2) << 100 * at.recall << " %";
  for (const double share : {.5, PAPER_SHARE})
  {
    std::cout << "; of windows 1 in " << std::setprecision(0) << 1 / share << " with a marker: accuracy "
              << std::setprecision(2) << 100 * at.accuracy(share) << " %, precision " << 100 * at.precision(share)
              << " %";
  }
  std::cout << "\n" << std::defaultfloat << std::setprecision(6);
}

/** Learns what boxes are judged by from pictures that the network has not seen. */
void judgeBoxes(const Options& options, const omr::TrainingPictures& pictures, omr::MarkerNetwork& network,
                std::ostream& report)
{
  const std::vector<omr::LabelledBox> boxes = omr::labelledBoxes(pictures, HELD_OUT_SEED + 2, network);
  for (const omr::MarkerKind kind : {omr::MarkerKind::checkerboard, omr::MarkerKind::target})
  {
    network.boxes[static_cast<int>(kind)].weights = omr::learnEvidence(boxes, kind);
  }
  const int plain = pictures.withoutMarkers();
  const float enlarged = omr::evidenceOfFalse(boxes, network, plain, options.enlarged);
  const float shown = omr::evidenceOfFalse(boxes, network, plain, options.shown);
  for (const omr::MarkerKind kind : {omr::MarkerKind::checkerboard, omr::MarkerKind::target})
  {
    omr::BoxEvidence& model = network.boxes[static_cast<int>(kind)];
    model.enlarged = enlarged;
    model.shown = shown;
    report << (kind == omr::MarkerKind::checkerboard ? "checkerboard" : "target") << ", of the boxes with one "
           << std::setprecision(3) << 100 * omr::shareOfMarkers(boxes, network, kind, enlarged) << " % are enlarged, "
           << 100 * omr::shareOfMarkers(boxes, network, kind, shown) << " % shown if not read\n";
  }
}

/** With the digits that a file has: what is chosen for it is what --network chooses. */
omr::MarkerNetwork asWritten(const omr::MarkerNetwork& network)
{
  std::ostringstream text;
  omr::writeMarkerNetwork(text, network);
  return omr::parseMarkerNetwork(text.str(), "network");
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
  const std::vector<cv::Mat> photographs = omr::readPhotographs(options.photographs);
  const std::vector<cv::Mat> learned = omr::part(photographs, options.held_out, false);
  const std::vector<cv::Mat> held = omr::part(photographs, options.held_out, true);
  if (held.empty())
  {
    throw std::runtime_error("there are " + std::to_string(photographs.size()) +
                             " photographs, too few to hold out one of " + std::to_string(options.held_out));
  }
  omr::NewFile file(options.output);  // before the work, which takes minutes
  std::ostringstream report;
  report << command << "\n"
         << date() << ", " << learned.size() << " photographs and " << options.scenes
         << " scenes; held out: " << held.size() << " photographs and " << options.held_out_scenes << " scenes\n";
  omr::MarkerNetwork network = options.network.empty()
                                   ? asWritten(omr::trainMarkerNetwork({learned, options.scenes}, options))
                                   : omr::loadMarkerNetwork(options.network);
  const omr::TrainingPictures pictures(held, options.held_out_scenes);
  if (network.gate.hidden > 0)
  {
    network.gate.thresholds = omr::gateThresholds(network.gate, heldOutMarkers(pictures), options.lost);
  }
  const omr::ScoreCounts counts = holdOut(pictures, network);
  for (const omr::MarkerKind kind : {omr::MarkerKind::checkerboard, omr::MarkerKind::target})
  {
    const char* name = kind == omr::MarkerKind::checkerboard ? "checkerboard" : "target";
    const std::vector<omr::Classification> curve = counts.curve(kind);
    std::cout << name << ", held out: " << counts.count(static_cast<omr::WindowLabel>(kind)) << " windows with one, "
              << counts.count(omr::WindowLabel::clutter) << " without any\n";
    for (const double precision : {.9, .99, .999, .9995, .9998, .9999, .99995, .99998, .99999})
    {
      std::cout << "  " << describe(omr::atPrecision(curve, precision)) << "\n";
    }
    const omr::Classification chosen = omr::atPrecision(curve, options.precision);
    printShares("chosen", chosen);
    printShares("99.9 % precise at 1 in 2", omr::atPrecision(curve, GOAL_PRECISION));
    printShares("99.9 % precise at 1 in 20", omr::atPrecision(curve, GOAL_PRECISION, PAPER_SHARE));
    network.thresholds[static_cast<int>(kind)] = static_cast<float>(chosen.threshold);
    report << name << ", " << describe(chosen) << "\n";
  }
  judgeBoxes(options, pictures, network, report);
  std::cout << report.str();
  std::istringstream lines(report.str());
  for (std::string line; std::getline(lines, line);)
  {
    file.stream() << "# " << line << "\n";
  }
  omr::writeMarkerNetwork(file.stream(), network);
  file.finish();
}

void declare(CLI::App& app, Options& options)
{
  app.description("Trains the network that finds candidates, from photographs without markers and rendered markers.");
  app.add_option("--output", options.output, "yaml file for the network")->required();
  app.add_option("--scenes", options.scenes, "rendered scenes to learn from")
      ->take_last()  // scripts/train names it
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  app.add_option("--hidden", options.hidden, "units of the hidden layer")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  app.add_option("--gate", options.gate, "units of the gate, which looks at all windows first")
      ->capture_default_str()
      ->check(CLI::Range(1, omr::MAX_GATE_UNITS));
  app.add_option("--lost", options.lost, "share of the held-out windows with a marker that the gate may lose")
      ->capture_default_str()
      ->check(CLI::Range(0., 1.));
  app.add_option("--epochs", options.epochs, "passes over the windows in the last round; a third in those before")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--rounds", options.rounds, "trainings; after each, hard clutter is added")
      ->capture_default_str()
      ->check(CLI::Range(1, 20));
  app.add_option("--held-out", options.held_out, "of so many photographs one is held out")
      ->capture_default_str()
      ->check(CLI::Range(2, 100));
  app.add_option("--held-out-scenes", options.held_out_scenes,
                 "rendered scenes that are held out; the more, the less the photographs tell what false boxes are")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  app.add_option("--precision", options.precision,
                 "precision that chooses the thresholds, as if every second window showed a marker")
      ->capture_default_str()
      ->check(CLI::Range(.5, 1.));
  app.add_option("--network", options.network,
                 "keeps the units of this file's network, and learns only thresholds and what boxes are judged by");
  app.add_option("--enlarged", options.enlarged, "false boxes a picture without markers that are looked at enlarged")
      ->capture_default_str()
      ->check(CLI::Range(0., 100.));
  app.add_option("--shown", options.shown, "false boxes a picture without markers that are shown as candidates")
      ->capture_default_str()
      ->check(CLI::Range(0., 100.));
  app.add_option("--seed", options.seed, "equal seeds and photographs give equal networks")->capture_default_str();
  app.add_option("photographs", options.photographs, "folders of photographs without markers")->required();
  app.footer("Exit code: 0; 2 when nothing could be done.");
}
}  // namespace

int main(int argc, char** argv)
{
  std::string command = "omr_train";
  for (int i = 1; i < argc; ++i)
  {
    command += std::string(" ") + argv[i];
  }
  return omr::runProgram<Options>("omr_train", argc, argv, declare, [&](const Options& options) {
    run(options, command);
    return omr::SUCCESS;
  });
}
