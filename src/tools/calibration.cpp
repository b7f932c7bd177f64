#include "calibration.h"

#include <cmath>
#include <iomanip>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

namespace omr
{
namespace
{
constexpr std::size_t MIN_VIEWS = 3;

/** What OpenCV takes: points of the board and their pixels, a list a view. */
struct Points
{
  std::vector<std::vector<cv::Point3f>> object;
  std::vector<std::vector<cv::Point2f>> image;
};

Points pointsOf(const std::vector<CalibrationView>& views, double square)
{
  Points points;
  for (const CalibrationView& view : views)
  {
    if (view.board == nullptr)
    {
      continue;
    }
    points.object.emplace_back();
    points.image.emplace_back();
    const int cols = view.board->cols - 1;
    for (std::size_t i = 0; i < view.board->inner_corners.size(); ++i)
    {
      if (view.board->inner_corners_seen[i])
      {
        const int row = static_cast<int>(i) / cols;
        const int col = static_cast<int>(i) % cols;
        points.object.back().emplace_back(static_cast<float>(col * square), static_cast<float>(row * square), 0.F);
        points.image.back().push_back(view.board->inner_corners[i]);
      }
    }
  }
  return points;
}

template <typename To, typename From>
std::vector<std::vector<To>> converted(const std::vector<std::vector<From>>& lists)
{
  std::vector<std::vector<To>> result;
  result.reserve(lists.size());
  for (const std::vector<From>& list : lists)
  {
    result.emplace_back(list.begin(), list.end());
  }
  return result;
}

/** Calibrates an equidistant camera; the coefficients are D. */
double calibrateFisheye(const Points& points, const cv::Size& size, cv::Mat& matrix, cv::Mat& coefficients,
                        std::vector<cv::Mat>& turns, std::vector<cv::Mat>& shifts)
{
  return cv::fisheye::calibrate(converted<cv::Point3d>(points.object), converted<cv::Point2d>(points.image), size,
                                matrix, coefficients, turns, shifts,
                                cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW);
}

/** Calibrates a pinhole camera; the coefficients are D. */
double calibratePinhole(const Points& points, const cv::Size& size, bool rational, cv::Mat& matrix,
                        cv::Mat& coefficients, std::vector<cv::Mat>& turns, std::vector<cv::Mat>& shifts,
                        double& focal_sigma)
{
  const int flags = rational ? cv::CALIB_RATIONAL_MODEL : cv::CALIB_FIX_K3;
  cv::Mat sigmas;
  cv::Mat pose_sigmas;
  cv::Mat errors;
  const double rms = cv::calibrateCamera(points.object, points.image, size, matrix, coefficients, turns, shifts, sigmas,
                                         pose_sigmas, errors, flags);
  coefficients = coefficients.reshape(1, 1).colRange(0, rational ? 8 : 5).clone();
  focal_sigma = sigmas.at<double>(0) / matrix.at<double>(0, 0);
  return rms;
}

void measureErrors(const Points& points, const cv::Mat& matrix, const cv::Mat& coefficients, bool fisheye,
                   const std::vector<cv::Mat>& turns, const std::vector<cv::Mat>& shifts, Calibration& calibration)
{
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t view = 0; view < points.object.size(); ++view)
  {
    std::vector<cv::Point2f> projected;
    if (fisheye)
    {
      cv::fisheye::projectPoints(points.object[view], projected, turns[view], shifts[view], matrix, coefficients);
    }
    else
    {
      cv::projectPoints(points.object[view], turns[view], shifts[view], matrix, coefficients, projected);
    }
    double squares = 0;
    for (std::size_t i = 0; i < projected.size(); ++i)
    {
      const double distance = cv::norm(projected[i] - points.image[view][i]);
      sum += distance;
      squares += distance * distance;
    }
    count += projected.size();
    calibration.view_errors.push_back(std::sqrt(squares / static_cast<double>(projected.size())));
  }
  calibration.mean_error = sum / static_cast<double>(count);
}

/** P of a rectified image without black borders, as camera_calibration writes it. */
cv::Mat rectifiedMatrix(const cv::Mat& matrix, const cv::Mat& coefficients, bool fisheye, const cv::Size& size)
{
  cv::Mat rectified;
  if (fisheye)
  {
    cv::fisheye::estimateNewCameraMatrixForUndistortRectify(matrix, coefficients, size, cv::Matx33d::eye(), rectified);
    return rectified;
  }
  return cv::getOptimalNewCameraMatrix(matrix, coefficients, size, 0);
}

template <typename Values>
void writeMatrix(std::ostream& stream, const std::string& key, int rows, const Values& values)
{
  const int size = static_cast<int>(values.size());
  stream << key << ":\n  rows: " << rows << "\n  cols: " << size / rows << "\n  data: [";
  for (int i = 0; i < size; ++i)
  {
    stream << (i == 0 ? "" : ", ") << values[i];
  }
  stream << "]\n";
}
}  // namespace

Calibration calibrate(const std::vector<CalibrationView>& views, double square, const cv::Size& size,
                      const std::string& model)
{
  const bool fisheye = model == "equidistant";
  const bool rational = model == "rational_polynomial";
  if (!fisheye && !rational && model != "plumb_bob")
  {
    throw std::invalid_argument("there is no camera model '" + model +
                                "': expected plumb_bob, rational_polynomial or equidistant");
  }
  const Points points = pointsOf(views, square);
  if (points.object.size() < MIN_VIEWS)
  {
    throw std::invalid_argument("the board was found in " + std::to_string(points.object.size()) + " of " +
                                std::to_string(views.size()) + " images: three are the least, 20 are good");
  }
  Calibration calibration;
  cv::Mat matrix;
  cv::Mat coefficients;
  try
  {
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    calibration.rms_error = fisheye ? calibrateFisheye(points, size, matrix, coefficients, turns, shifts)
                                    : calibratePinhole(points, size, rational, matrix, coefficients, turns, shifts,
                                                       calibration.focal_sigma);
    measureErrors(points, matrix, coefficients, fisheye, turns, shifts, calibration);
    const cv::Matx33d rectified = rectifiedMatrix(matrix, coefficients, fisheye, size);
    calibration.info.P = {rectified(0, 0), 0, rectified(0, 2), 0, 0, rectified(1, 1), rectified(1, 2), 0, 0, 0, 1, 0};
  }
  catch (const cv::Exception& error)
  {
    throw std::runtime_error("OpenCV finds no calibration of these views: " + error.err +
                             "; take the board nearer, tilted, and in all parts of the image");
  }
  calibration.info.width = size.width;
  calibration.info.height = size.height;
  calibration.info.distortion_model = model;
  coefficients.reshape(1, 1).copyTo(calibration.info.D);
  std::copy(matrix.begin<double>(), matrix.end<double>(), calibration.info.K.begin());
  return calibration;
}

std::string nameProblem(const std::string& name)
{
  const bool is_good = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '_';
  });
  return is_good ? "" : "a camera's name has letters, digits and _ only, not '" + name + "'";
}

void writeCameraInfo(std::ostream& stream, const CameraInfo& info, const std::string& camera_name)
{
  stream << std::setprecision(10) << "image_width: " << info.width << "\nimage_height: " << info.height
         << "\ncamera_name: " << camera_name << "\n";
  writeMatrix(stream, "camera_matrix", 3, info.K);
  stream << "distortion_model: " << info.distortion_model << "\n";
  writeMatrix(stream, "distortion_coefficients", 1, info.D);
  writeMatrix(stream, "rectification_matrix", 3, std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  writeMatrix(stream, "projection_matrix", 3, info.P);
}

void writeMrcalCorners(std::ostream& stream, const std::vector<CalibrationView>& views)
{
  stream << std::fixed << std::setprecision(4) << "# filename x y level\n";
  for (const CalibrationView& view : views)
  {
    if (view.board == nullptr)
    {
      stream << view.image << " - - -\n";
      continue;
    }
    for (std::size_t i = 0; i < view.board->inner_corners.size(); ++i)
    {
      const cv::Point2f& corner = view.board->inner_corners[i];
      stream << view.image << " " << corner.x << " " << corner.y
             << (view.board->inner_corners_seen[i] ? " 0\n" : " -\n");
    }
  }
}

}  // namespace omr
