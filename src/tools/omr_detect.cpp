#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "detector_options.h"
#include "image_files.h"
#include "markers_json.h"
#include "outdoor_omr/detector.h"
#include "outdoor_omr/overlay.h"
#include "parameter_table.h"
#include "program.h"

namespace
{
struct Options
{
  omr::DetectorOptions detector;
  std::string overlay;
  std::string json;
  std::string network;
  bool list_devices = false;
  bool list_parameters = false;
  std::vector<std::string> images;

  /** Whether the result goes to standard output. */
  bool printsToOutput() const
  {
    return json == "-" || (json.empty() && overlay.empty());
  }
};

/** One file name an image, numbered where images of several folders have the same name. */
std::vector<std::string> overlayNames(const std::vector<std::string>& images)
{
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& image : images)
  {
    const std::string stem = std::filesystem::path(image).stem();
    std::string name = stem;
    for (int number = 2; !taken.insert(name).second; ++number)
    {
      name = stem + "-" + std::to_string(number);
    }
    names.push_back(name + ".png");
  }
  return names;
}

/** An overlay may not take the place of an image. @throws std::invalid_argument */
void checkOverlays(const std::string& folder, const std::vector<std::string>& names,
                   const std::vector<std::string>& images)
{
  std::error_code ignored;  // what is not there has no canonical name, and is nothing to lose
  std::set<std::filesystem::path> originals;
  for (const std::string& image : images)
  {
    originals.insert(std::filesystem::canonical(image, ignored));
  }
  originals.erase(std::filesystem::path());
  for (const std::string& name : names)
  {
    const std::filesystem::path overlay = std::filesystem::canonical(std::filesystem::path(folder) / name, ignored);
    if (originals.count(overlay) > 0)
    {
      omr::refuseToOverwrite(overlay, "name another folder for --overlay");
    }
  }
}

void createFolder(const std::string& name)
{
  std::error_code error;
  std::filesystem::create_directories(name, error);
  if (error)
  {
    throw std::runtime_error("cannot create the folder '" + name + "': " + error.message());
  }
}

void writeOverlay(const std::string& file, const cv::Mat& picture)
{
  bool written = false;
  try
  {
    written = cv::imwrite(file, picture);
  }
  catch (const cv::Exception&)
  {
  }
  if (!written)
  {
    throw std::runtime_error("cannot write the overlay '" + file + "'");
  }
}

void printSummary(const std::string& name, double milliseconds, const omr::Markers& markers)
{
  std::cout << std::fixed << std::setprecision(1) << name << ": " << markers.checkerboards.size() << " checkerboards, "
            << markers.targets.size() << " targets, " << milliseconds << " ms\n";
  for (const omr::Checkerboard& board : markers.checkerboards)
  {
    const auto seen = std::count(board.inner_corners_seen.begin(), board.inner_corners_seen.end(), true);
    std::cout << "  checkerboard " << (board.size_certain ? "" : ">= ") << board.rows << " x " << board.cols
              << " squares, first corner (" << board.corners[0].x << ", " << board.corners[0].y << "), " << seen
              << " of " << board.inner_corners.size() << " inner corners seen\n";
  }
  for (const omr::Candidate& candidate : markers.candidates)
  {
    if (!candidate.read)
    {
      std::cout << "  perhaps a " << (candidate.kind == omr::MarkerKind::checkerboard ? "checkerboard" : "target")
                << " at (" << candidate.box.x << ", " << candidate.box.y << "), " << candidate.box.width << " x "
                << candidate.box.height << " px\n";
    }
  }
  for (const omr::Target& target : markers.targets)
  {
    std::cout << "  target " << target.colors << " at (" << target.center.x << ", " << target.center.y << ")\n";
  }
}

/** Says on a terminal which image is at work; the line wipes itself out. */
void showProgress(const Options& options, std::size_t index)
{
  const bool output_is_seen = options.printsToOutput() && isatty(STDOUT_FILENO) != 0;
  if (isatty(STDERR_FILENO) == 0 || output_is_seen)
  {
    return;
  }
  std::cerr << "\r\033[K";
  if (index < options.images.size())
  {
    std::cerr << index + 1 << "/" << options.images.size() << " " << options.images[index] << std::flush;
  }
}

/** Reads one image, searches it and writes what was asked for; std::invalid_argument when the image is at fault. */
void processImage(const Options& options, std::size_t index, const omr::Settings& settings, omr::Detector& detector,
                  const std::string& overlay_name, std::ostream& json)
{
  using Clock = std::chrono::steady_clock;
  const std::string& name = options.images[index];
  const cv::Mat image = omr::readImage(name);
  const Clock::time_point start = Clock::now();
  const omr::Markers markers = detector.detect(image, settings);
  const double milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  if (!options.overlay.empty())
  {
    writeOverlay(options.overlay + "/" + overlay_name, omr::drawOverlay(image, markers, detector.regions()));
  }
  if (!options.json.empty())
  {
    omr::writeJson(json, omr::toJson(name, image.size(), milliseconds, markers));
  }
  else if (options.overlay.empty())
  {
    printSummary(name, milliseconds, markers);
  }
}

omr::ExitCode detectAll(const Options& options)
{
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_ERROR);  // an unreadable image is told once, below
  const omr::Settings settings = options.detector.settings();
  omr::Detector detector(options.detector.device);
  if (!options.network.empty())
  {
    detector.setNetwork(omr::loadMarkerNetwork(options.network));
  }
  const std::vector<std::string> overlay_names = overlayNames(options.images);
  if (!options.overlay.empty())
  {
    createFolder(options.overlay);
    checkOverlays(options.overlay, overlay_names, options.images);
  }
  std::ofstream file;
  if (!options.json.empty() && options.json != "-")
  {
    file = omr::openOutput(options.json);
  }
  std::ostream& json = file.is_open() ? file : std::cout;
  omr::ExitCode result = omr::SUCCESS;
  for (std::size_t i = 0; i < options.images.size(); ++i)
  {
    showProgress(options, i);
    try
    {
      processImage(options, i, settings, detector, overlay_names[i], json);
    }
    catch (const std::invalid_argument& error)
    {
      std::cerr << "omr_detect: " << options.images[i] << ": " << error.what() << std::endl;
      result = omr::IMAGE_FAILED;
    }
  }
  showProgress(options, options.images.size());
  return result;
}

void listDevices()
{
  const std::vector<std::string> devices = omr::FillPipeline::devices();
  for (const std::string& device : devices)
  {
    std::cout << device << "\n";
  }
  if (devices.empty())
  {
    std::cout << "no OpenCL device; the plain C++ reference takes its place\n";
  }
}

omr::ExitCode run(const Options& options)
{
  if (options.list_devices)
  {
    listDevices();
    return omr::SUCCESS;
  }
  if (options.list_parameters)
  {
    std::cout << omr::parameterTable();
    return omr::SUCCESS;
  }
  return detectAll(options);
}

void declare(CLI::App& app, Options& options)
{
  app.description("Finds checkerboards and targets of concentric colour rings in images.");
  options.detector.addTo(app);
  app.add_option("--overlay", options.overlay, "folder for pictures with the markers drawn");
  app.add_option("--json", options.json, "file for one JSON object an image, - for standard output");
  app.add_option("--network", options.network, "yaml file of omr_train for the candidates; default: the built-in one");
  auto* devices = app.add_flag("--list-devices", options.list_devices, "names the OpenCL devices and ends");
  auto* parameters = app.add_flag("--list-parameters", options.list_parameters, "prints all parameters and ends");
  app.add_option("images", options.images, "image files");
  app.footer("Exit code: 0; 1 when an image could not be read; 2 when nothing could be done.");
  app.callback([&options, devices, parameters] {
    if (options.images.empty() && devices->count() + parameters->count() == 0)
    {
      throw CLI::RequiredError("images");
    }
  });
}
}  // namespace

int main(int argc, char** argv)
{
  return omr::runProgram<Options>("omr_detect", argc, argv, declare, run);
}
