#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "markers_json.h"
#include "outdoor_omr/detector.h"
#include "outdoor_omr/overlay.h"
#include "outdoor_omr/settings.h"

namespace
{
struct Options
{
  std::string config;
  std::string filter;
  std::vector<std::string> set;
  std::string device = "auto";
  std::string overlay;
  std::string json;
  std::vector<std::string> images;
};

outdoor_omr::Settings readSettings(const Options& options)
{
  outdoor_omr::Settings settings;
  if (!options.config.empty())
  {
    outdoor_omr::loadSettings(settings, options.config);
  }
  if (!options.filter.empty())
  {
    outdoor_omr::setParameter(settings, "filter", options.filter);
  }
  for (const std::string& assignment : options.set)
  {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos)
    {
      throw std::invalid_argument("--set expects name=value, not '" + assignment + "'");
    }
    outdoor_omr::setParameter(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
  }
  return settings;
}

int run(const Options& options)
{
  const outdoor_omr::Settings settings = readSettings(options);
  outdoor_omr::Detector detector(options.device);
  std::ofstream file;
  if (!options.json.empty() && options.json != "-")
  {
    file.open(options.json);
  }
  std::ostream& json = options.json == "-" ? std::cout : file;
  int failed = 0;
  for (const std::string& name : options.images)
  {
    const cv::Mat image = cv::imread(name, cv::IMREAD_COLOR);
    if (image.empty())
    {
      std::cerr << "omr_detect: cannot read the image '" << name << "'\n";
      ++failed;
      continue;
    }
    const outdoor_omr::Markers markers = detector.detect(image, settings);
    if (!options.json.empty())
    {
      json << outdoor_omr::toJson(name, image.size(), markers).dump() << "\n";
    }
    if (!options.overlay.empty())
    {
      const std::string base = name.substr(name.find_last_of('/') + 1);
      cv::imwrite(options.overlay + "/" + base + ".png", outdoor_omr::drawOverlay(image, markers, detector.regions()));
    }
  }
  return failed == 0 ? 0 : 1;
}
}  // namespace

int main(int argc, char** argv)
{
  Options options;
  CLI::App app("Finds checkerboards and targets of concentric colour rings in images.");
  app.add_option("--config", options.config, "yaml file of parameters");
  app.add_option("--filter", options.filter, "none, gaussian or median");
  app.add_option("--set", options.set, "name=value of one parameter; may be repeated")->allow_extra_args(false);
  app.add_option("--device", options.device, "auto, gpu, cpu, reference or part of a device's name");
  app.add_option("--overlay", options.overlay, "folder for pictures with the markers drawn");
  app.add_option("--json", options.json, "file for one JSON object an image, - for standard output");
  app.add_option("images", options.images, "image files")->required();
  CLI11_PARSE(app, argc, argv);
  try
  {
    return run(options);
  }
  catch (const std::exception& error)
  {
    std::cerr << "omr_detect: " << error.what() << "\n";
    return 2;
  }
}
