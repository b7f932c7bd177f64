#include <chrono>
#include <iomanip>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>

#include "detector_options.h"
#include "image_files.h"
#include "outdoor_omr/detector.h"
#include "outdoor_omr/locate.h"
#include "outdoor_omr/pose_estimate.h"
#include "parts_json.h"
#include "program.h"

namespace
{
struct Options
{
  omr::DetectorOptions detector;
  std::string camera;
  std::string parts;
  std::string json;
  bool rectified = false;
  std::vector<std::string> images;
};

void printPart(const omr::PartPose& part)
{
  const cv::Vec3d position = part.pose.camera_part.translation();
  const cv::Vec3d turn = omr::rollPitchYaw(part.pose.camera_part.rotation()) * (180 / CV_PI);
  std::cout << part.part << " at (" << std::setprecision(5) << position[0] << ", " << position[1] << ", " << position[2]
            << ") m +- " << std::setprecision(2) << omr::positionRadius95(part.pose.covariance) * 1000
            << " mm, rpy_degrees (" << std::setprecision(5) << turn[0] << ", " << turn[1] << ", " << turn[2] << "), "
            << part.checkerboards.size() << " checkerboards, " << part.targets.size() << " targets, reprojection error "
            << std::setprecision(2) << part.pose.rms_error << " px\n";
}

void printSummary(const std::string& image, const std::vector<omr::Sighting>& sightings)
{
  std::cout << std::fixed << image << ": " << sightings.size() << (sightings.size() == 1 ? " part\n" : " parts\n");
  for (const omr::Sighting& sighting : sightings)
  {
    if (!sighting.certain())
    {
      std::cout << "  ambiguous; one of\n";
    }
    for (const omr::PartPose& candidate : sighting.candidates)
    {
      std::cout << (sighting.certain() ? "  " : "    ");
      printPart(candidate);
    }
  }
}

/** Says on standard error which parts do not lie as they are described. */
void warnOfMisfits(const std::string& image, const std::vector<omr::Sighting>& sightings)
{
  for (const omr::Sighting& sighting : sightings)
  {
    const omr::PartPose& part = sighting.candidates.front();
    const std::string misfit = sighting.certain() ? omr::misfitOf(part.part, part.pose.rms_error) : "";
    if (!misfit.empty())
    {
      std::cerr << "omr_position: warning: " << image << ": " << misfit << std::endl;
    }
  }
}

std::string words(const cv::Size& size)
{
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

omr::ExitCode locateAll(const Options& options)
{
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_ERROR);  // an unreadable image is told once, below
  using Clock = std::chrono::steady_clock;
  const omr::Settings settings = options.detector.settings();
  const omr::Camera camera(omr::readCameraInfo(options.camera),
                           options.rectified ? omr::ImageKind::rectified : omr::ImageKind::raw);
  const std::vector<omr::Part> parts = omr::readParts(options.parts);
  omr::Detector detector(options.detector.device);
  std::ofstream file;
  if (!options.json.empty() && options.json != "-")
  {
    file = omr::openOutput(options.json);
  }
  omr::ExitCode result = omr::SUCCESS;
  for (const std::string& name : options.images)
  {
    try
    {
      const cv::Mat image = omr::readImage(name);
      if (image.size() != camera.size())
      {
        throw std::invalid_argument("the image has " + words(image.size()) + " pixels, the calibration in '" +
                                    options.camera + "' is of " + words(camera.size()));
      }
      const Clock::time_point start = Clock::now();
      const omr::Markers markers = detector.detect(image, settings);
      const std::vector<omr::Sighting> sightings = omr::locateParts(markers, parts, camera);
      const double milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
      warnOfMisfits(name, sightings);
      if (options.json.empty())
      {
        printSummary(name, sightings);
      }
      else
      {
        omr::writeJson(file.is_open() ? file : std::cout, omr::toJson(name, image.size(), milliseconds, sightings));
      }
    }
    catch (const std::invalid_argument& error)
    {
      std::cerr << "omr_position: " << name << ": " << error.what() << std::endl;
      result = omr::IMAGE_FAILED;
    }
  }
  return result;
}

void declare(CLI::App& app, Options& options)
{
  app.description("Finds the parts of a parts file in images of a calibrated camera and says where they are.");
  app.add_option("--camera", options.camera, "yaml file of camera_calibration or camera_info_manager")->required();
  app.add_option("--parts", options.parts, "yaml file of parts and their markers, as config/parts.yaml")->required();
  app.add_flag("--rectified", options.rectified, "the images are rectified: use P, not K and D");
  app.add_option("--json", options.json, "file for one JSON object an image, - for standard output");
  options.detector.addTo(app);
  app.add_option("images", options.images, "image files")->required();
  app.footer(
      "Exit code: 0; 1 when an image could not be read or has another size than the calibration; 2 when nothing "
      "could be done.");
}
}  // namespace

int main(int argc, char** argv)
{
  return omr::runProgram<Options>("omr_position", argc, argv, declare, locateAll);
}
