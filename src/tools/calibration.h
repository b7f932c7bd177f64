#ifndef OUTDOOR_OMR_TOOLS_CALIBRATION_H
#define OUTDOOR_OMR_TOOLS_CALIBRATION_H

#include <opencv2/core.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "outdoor_omr/camera.h"
#include "outdoor_omr/checkerboard.h"

namespace omr
{
/** The board of one image, or none. */
struct CalibrationView
{
  std::string image;
  const Checkerboard* board = nullptr;
};

struct Calibration
{
  CameraInfo info;
  double rms_error = 0;             ///< [px], of all corners, as cv::calibrateCamera() gives it
  double mean_error = 0;            ///< [px], mean distance of a corner from its reprojection
  double focal_sigma = 0;           ///< relative standard deviation of the focal length; 0: not known (equidistant)
  std::vector<double> view_errors;  ///< [px], RMS, one a view with a board
};

/**
 * Calibrates a camera with OpenCV from views of one board; corners that were not seen are left out.
 *
 * @param square side of a square [m].
 * @param size   of the images [px].
 * @param model  plumb_bob (k1 k2 p1 p2, k3 = 0: as camera_calibration does by default), rational_polynomial or
 *               equidistant.
 * @throws std::invalid_argument for another model or fewer than three views with a board; std::runtime_error if OpenCV
 *         gives up.
 */
Calibration calibrate(const std::vector<CalibrationView>& views, double square, const cv::Size& size,
                      const std::string& model);

/** Why a text cannot be a camera's name; empty: it can. */
std::string nameProblem(const std::string& name);

/** Writes the yaml file that camera_info_manager reads. */
void writeCameraInfo(std::ostream& stream, const CameraInfo& info, const std::string& camera_name);

/** Writes the corners as mrcal's --corners-cache reads them: images without a board and corners not seen as '-'. */
void writeMrcalCorners(std::ostream& stream, const std::vector<CalibrationView>& views);

}  // namespace omr

#endif
