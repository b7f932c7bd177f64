#include "outdoor_omr/camera.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <sstream>
#include <stdexcept>

#include "yaml_file.h"

namespace omr
{
namespace
{
constexpr double MAX_FOCAL = 1e6;  // [px]; no lens is that long
constexpr int UNDISTORT_STEPS = 50;
constexpr double UNDISTORT_ACCURACY = 1e-9;  // of the ray; a thousandth of what a corner is good for

std::string words(double value)
{
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

/** The matrix of field `name`, whose rows have `stride` values. */
cv::Matx33d cameraMatrix(const std::string& name, const double* values, int stride, const cv::Size& size)
{
  const double fx = values[0];
  const double fy = values[stride + 1];
  const double cx = values[2];
  const double cy = values[stride + 2];
  if (fx == 0)
  {
    throw std::invalid_argument("the camera is not calibrated: " + name +
                                "[0] = 0; calibrate it (docs/calibration.md)");
  }
  for (const double focal : {fx, fy})
  {
    if (!(focal > 0 && focal < MAX_FOCAL))
    {
      throw std::invalid_argument(name + " holds the focal length " + words(focal) + ": expected more than 0 pixels");
    }
  }
  if (!(cx > -size.width && cx < 2.0 * size.width && cy > -size.height && cy < 2.0 * size.height))
  {
    throw std::invalid_argument(name + " holds the principal point (" + words(cx) + ", " + words(cy) +
                                "): expected a pixel near the middle of the image");
  }
  if (values[1] != 0)
  {
    throw std::invalid_argument(name + "[1] = " + words(values[1]) + ": expected 0, pixels in a right-angled grid");
  }
  return {fx, 0, cx, 0, fy, cy, 0, 0, 1};
}

void checkDistortion(const CameraInfo& info)
{
  const auto fits = [&](const std::vector<std::size_t>& counts) {
    return std::find(counts.begin(), counts.end(), info.D.size()) != counts.end();
  };
  std::string expected;
  bool good = false;
  if (info.distortion_model == "plumb_bob")
  {
    expected = "4 or 5";
    good = fits({0, 4, 5});
  }
  else if (info.distortion_model == "rational_polynomial")
  {
    expected = "8, 12 or 14";
    good = fits({8, 12, 14});
  }
  else if (info.distortion_model == "equidistant" || info.distortion_model == "fisheye")
  {
    expected = "4";
    good = fits({4});
  }
  else
  {
    throw std::invalid_argument("the distortion model '" + info.distortion_model +
                                "' is not known: expected plumb_bob, rational_polynomial or equidistant");
  }
  if (!good)
  {
    throw std::invalid_argument("D has " + std::to_string(info.D.size()) + " values: " + info.distortion_model +
                                " has " + expected);
  }
  if (!std::all_of(info.D.begin(), info.D.end(), [](double value) { return std::isfinite(value); }))
  {
    throw std::invalid_argument("D holds a value that is no number");
  }
}
/** Refuses a distortion that cannot be undone in the middle of the image: values in a wrong order, or of another model,
 * would silently leave no pose. Towards the corners real calibrations may fail so, since no point held them there. */
void checkUndone(const Camera& camera, const cv::Point2d& principal_point)
{
  constexpr double SHARE = 0.1;  // of the width and height, to each side of the principal point
  constexpr int STEPS = 4;       // to each side
  constexpr double MAX_OFF = 1;  // px
  const cv::Size& size = camera.size();
  std::vector<cv::Point2d> pixels;
  for (int row = -STEPS; row <= STEPS; ++row)
  {
    for (int col = -STEPS; col <= STEPS; ++col)
    {
      pixels.push_back(principal_point +
                       cv::Point2d(size.width * SHARE * col / STEPS, size.height * SHARE * row / STEPS));
    }
  }
  std::vector<cv::Point3d> points;
  for (const cv::Point2d& ray : camera.normalize(pixels))
  {
    points.emplace_back(ray.x, ray.y, 1);
  }
  const std::vector<cv::Point2d> again = camera.project(points);
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    if (!(cv::norm(again[i] - pixels[i]) < MAX_OFF))
    {
      throw std::invalid_argument("D is no distortion of a lens: it cannot be undone at pixel (" + words(pixels[i].x) +
                                  ", " + words(pixels[i].y) + "), near the middle of the image; expected the values " +
                                  "of a calibration in the order of the model, as k1, k2, p1, p2, k3");
    }
  }
}
}  // namespace

Camera::Camera(const CameraInfo& info, ImageKind kind) : size_(info.width, info.height)
{
  if (info.width <= 0 || info.height <= 0)
  {
    throw std::invalid_argument("width x height is " + std::to_string(info.width) + " x " +
                                std::to_string(info.height) + ": expected the size of the image");
  }
  if (info.K[0] == 0)
  {
    throw std::invalid_argument("the camera is not calibrated: K[0] = 0; calibrate it (docs/calibration.md)");
  }
  if (kind == ImageKind::rectified)
  {
    matrix_ = cameraMatrix("P", info.P.data(), 4, size_);
    return;
  }
  matrix_ = cameraMatrix("K", info.K.data(), 3, size_);
  checkDistortion(info);
  distortion_ = info.D;
  fisheye_ = info.distortion_model == "equidistant" || info.distortion_model == "fisheye";
  checkUndone(*this, {matrix_(0, 2), matrix_(1, 2)});
}

const cv::Size& Camera::size() const
{
  return size_;
}

double Camera::focalLength() const
{
  return (matrix_(0, 0) + matrix_(1, 1)) / 2;
}

std::vector<cv::Point2d> Camera::project(const std::vector<cv::Point3d>& points,
                                         std::vector<cv::Matx23d>* derivatives) const
{
  std::vector<cv::Point2d> pixels;
  if (derivatives != nullptr)
  {
    derivatives->clear();
  }
  if (points.empty())
  {
    return pixels;
  }
  // With the identity for a pose, OpenCV's derivative by the translation is the one by the point.
  const cv::Vec3d none(0, 0, 0);
  cv::Mat jacobian;
  int first = 3;  // column of the translation
  if (fisheye_)
  {
    first = 11;  // after f, c, k and the rotation
    cv::fisheye::projectPoints(points, pixels, none, none, matrix_, distortion_, 0,
                               derivatives != nullptr ? cv::OutputArray(jacobian) : cv::OutputArray(cv::noArray()));
  }
  else
  {
    cv::projectPoints(points, none, none, matrix_, distortion_, pixels,
                      derivatives != nullptr ? cv::OutputArray(jacobian) : cv::OutputArray(cv::noArray()));
  }
  for (int i = 0; derivatives != nullptr && i < static_cast<int>(points.size()); ++i)
  {
    const cv::Mat block = jacobian(cv::Rect(first, 2 * i, 3, 2));
    derivatives->push_back(cv::Matx23d(cv::Mat(block.clone())));
  }
  return pixels;
}

std::vector<cv::Point2d> Camera::normalize(const std::vector<cv::Point2d>& pixels) const
{
  std::vector<cv::Point2d> rays;
  if (pixels.empty())
  {
    return rays;
  }
  if (fisheye_)
  {
    cv::fisheye::undistortPoints(pixels, rays, matrix_, distortion_);
  }
  else
  {
    cv::undistortPoints(
        pixels, rays, matrix_, distortion_, cv::noArray(), cv::noArray(),
        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, UNDISTORT_STEPS, UNDISTORT_ACCURACY));
  }
  return rays;
}

CameraInfo readCameraInfo(const std::string& file)
{
  const YamlFile root = YamlFile::load(file);
  CameraInfo info;
  info.width = root.get("image_width", "the width of the image [px]").integer("a width in pixels", 1, 65535);
  info.height = root.get("image_height", "the height of the image [px]").integer("a height in pixels", 1, 65535);
  info.distortion_model =
      root.get("distortion_model", "plumb_bob, rational_polynomial or equidistant").text("the name of a model");
  const auto data = [&](const std::string& key, std::size_t size) {
    const std::string expected = size == 0 ? "a list of numbers" : "a list of " + std::to_string(size) + " numbers";
    return root.get(key, "a matrix with 'rows', 'cols' and 'data'").get("data", expected).numbers(expected, size);
  };
  const std::vector<double> k = data("camera_matrix", info.K.size());
  std::copy(k.begin(), k.end(), info.K.begin());
  info.D = data("distortion_coefficients", 0);
  if (root.has("projection_matrix"))
  {
    const std::vector<double> p = data("projection_matrix", info.P.size());
    std::copy(p.begin(), p.end(), info.P.begin());
  }
  try
  {
    Camera(info, ImageKind::raw);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(file + ": " + error.what());
  }
  return info;
}

}  // namespace omr
