#include <algorithm>
#include <deque>
#include <iomanip>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "calibration.h"
#include "detector_options.h"
#include "image_files.h"
#include "outdoor_omr/detector.h"
#include "program.h"
#include "sheet.h"

namespace
{
struct Options
{
  omr::DetectorOptions detector;
  std::string checkerboard;
  double square = 0;
  std::string model = "plumb_bob";
  std::string name = "camera";
  std::string output;
  std::string mrcal;
  std::vector<std::string> images;
};

/** The seen boards of all images. */
struct Session
{
  cv::Size size;                         // of the images
  std::deque<omr::Checkerboard> boards;  // views point into it
  std::vector<omr::CalibrationView> views;
  std::set<std::string> other_sizes;  // of boards that are not the one looked for
};

long countSeen(const omr::Checkerboard& board)
{
  return std::count(board.inner_corners_seen.begin(), board.inner_corners_seen.end(), true);
}

std::string words(const cv::Size& size)
{
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

double areaOf(const omr::Checkerboard& board)
{
  return cv::contourArea(std::vector<cv::Point2f>(board.corners.begin(), board.corners.end()));
}

/** Looks for the board in one image; of several the largest counts: one with a corner hidden in the hand, not its copy
 * on a screen behind (opencv-doc's left12). */
void addView(const std::string& name, const cv::Size& squares, const omr::Settings& settings, omr::Detector& detector,
             Session& session)
{
  const cv::Mat image = omr::readImage(name);
  if (!session.size.empty() && image.size() != session.size)
  {
    throw std::invalid_argument("the image has " + words(image.size()) + " pixels, those before it " +
                                words(session.size));
  }
  session.size = image.size();
  omr::CalibrationView view{name, nullptr};
  for (const omr::Checkerboard& board : detector.detect(image, settings).checkerboards)
  {
    const bool fits = board.rows == squares.height && board.cols == squares.width && countSeen(board) >= 4;
    if (fits && (view.board == nullptr || areaOf(board) > areaOf(*view.board)))
    {
      session.boards.push_back(board);
      view.board = &session.boards.back();
    }
    if (board.rows != squares.height || board.cols != squares.width)
    {
      session.other_sizes.insert(words({board.rows, board.cols}));
    }
  }
  session.views.push_back(view);
}

void printReport(const Session& session, const omr::Calibration& calibration)
{
  std::cout << std::fixed << std::setprecision(3);
  std::size_t found = 0;
  for (const omr::CalibrationView& view : session.views)
  {
    std::cout << view.image << ": ";
    if (view.board == nullptr)
    {
      std::cout << "no such board\n";
      continue;
    }
    std::cout << countSeen(*view.board) << " corners, RMS " << calibration.view_errors[found++] << " px\n";
  }
  std::cout << found << " of " << session.views.size() << " images, reprojection error: mean " << calibration.mean_error
            << " px, RMS " << calibration.rms_error << " px\n";
  std::cout << "focal length " << calibration.info.K[0] << ", " << calibration.info.K[4] << " px, principal point ("
            << calibration.info.K[2] << ", " << calibration.info.K[5] << ")\n";
  if (calibration.focal_sigma > 0)
  {
    std::cout << "standard deviation of the focal length " << calibration.focal_sigma * 100
              << " %: as much of every distance along the ray\n";
  }
}

/** mrcal's table has its columns between spaces. */
void checkMrcalNames(const std::vector<std::string>& names)
{
  for (const std::string& name : names)
  {
    if (name.find_first_of(" \t\n") != std::string::npos || name.front() == '#')
    {
      throw std::invalid_argument("--mrcal takes no file names with spaces or # in front, as '" + name + "'");
    }
  }
}

omr::ExitCode calibrateAll(const Options& options)
{
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_ERROR);  // an unreadable image is told once, below
  const omr::Settings settings = options.detector.settings();
  cv::Size squares = omr::parseCheckerboard(options.checkerboard);
  squares = {std::max(squares.width, squares.height), std::min(squares.width, squares.height)};
  if (!options.mrcal.empty())
  {
    checkMrcalNames(options.images);
  }
  omr::refuseImage(options.output);  // before the work
  omr::refuseImage(options.mrcal);
  omr::Detector detector(options.detector.device);
  Session session;
  omr::ExitCode result = omr::SUCCESS;
  for (const std::string& name : options.images)
  {
    try
    {
      addView(name, squares, settings, detector, session);
    }
    catch (const std::invalid_argument& error)
    {
      std::cerr << "omr_calibrate: " << name << ": " << error.what() << std::endl;
      result = omr::IMAGE_FAILED;
    }
  }
  if (session.boards.empty() && !session.other_sizes.empty())
  {
    std::string sizes;
    for (const std::string& size : session.other_sizes)
    {
      sizes += (sizes.empty() ? "" : ", ") + size;
    }
    std::cerr << "omr_calibrate: note: there are boards of " << sizes << " squares; --checkerboard counts squares, not "
              << "inner corners\n";
  }
  if (!options.mrcal.empty())
  {
    omr::NewFile file(options.mrcal);
    omr::writeMrcalCorners(file.stream(), session.views);
    file.finish();
  }
  const omr::Calibration calibration = omr::calibrate(session.views, options.square, session.size, options.model);
  printReport(session, calibration);
  if (!options.output.empty())
  {
    omr::NewFile file(options.output);
    omr::writeCameraInfo(file.stream(), calibration.info, options.name);
    file.finish();
  }
  return result;
}

void declare(CLI::App& app, Options& options)
{
  app.description(
      "Calibrates a camera from images of a printed checkerboard; docs/calibration.md tells how to take them.");
  app.add_option("--checkerboard", options.checkerboard, "ROWSxCOLS squares, as 7x10")->required();
  app.add_option("--square", options.square, "side of a square [m]")->required()->check(CLI::Range(0.001, 1.0));
  app.add_option("--model", options.model, "plumb_bob (default), rational_polynomial or equidistant");
  app.add_option("--name", options.name, "of the camera, in the file: letters, digits and _")
      ->check(CLI::Validator(omr::nameProblem, "NAME"));
  app.add_option("--output", options.output, "yaml file for camera_info_manager");
  app.add_option("--mrcal", options.mrcal, "file for the corners, for mrcal-calibrate-cameras --corners-cache");
  options.detector.addTo(app);
  app.add_option("images", options.images, "image files")->required();
  app.footer("Exit code: 0; 1 when an image could not be used; 2 when there is no calibration.");
}
}  // namespace

int main(int argc, char** argv)
{
  return omr::runProgram<Options>("omr_calibrate", argc, argv, declare, calibrateAll);
}
