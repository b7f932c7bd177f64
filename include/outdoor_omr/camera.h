#ifndef OUTDOOR_OMR_CAMERA_H
#define OUTDOOR_OMR_CAMERA_H

#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace omr
{
/** The fields of ROS's message CameraInfo that describe a camera, under their names there. */
struct CameraInfo
{
  int width = 0;                 ///< [px]
  int height = 0;                ///< [px]
  std::string distortion_model;  ///< plumb_bob, rational_polynomial or equidistant (also: fisheye)
  std::vector<double> D;       ///< distortion: 4 or 5 values, 8 (rational_polynomial; 12, 14 as OpenCV) or 4 (fisheye)
  std::array<double, 9> K{};   ///< 3 x 3 row by row [px], of the raw image; K[0] = 0: not calibrated (REP 104)
  std::array<double, 12> P{};  ///< 3 x 4 row by row [px], of the rectified image
};

/** Which image the pixels are of. */
enum class ImageKind
{
  raw,       ///< as it came: K and D
  rectified  ///< as image_proc made it: P, no distortion
};

/**
 * Maps points of the camera's optical frame (x right, y down, z forward; metres) to pixels, (0, 0) being the centre of
 * the top-left pixel. For rectified images the frame is that of the rectified camera itself: R and the fourth column of
 * P (the base line of a stereo pair) are not applied.
 */
class Camera
{
 public:
  /** @throws std::invalid_argument naming the field, its value and what is expected; K[0] = 0 is "not calibrated". */
  Camera(const CameraInfo& info, ImageKind kind);

  /** Size of the image that the calibration is of [px]. */
  const cv::Size& size() const;

  /** Mean focal length [px]. */
  double focalLength() const;

  /**
   * @param points      in front of the camera (z > 0) [m].
   * @param derivatives if not null: d pixel / d point [px / m], one for each point.
   */
  std::vector<cv::Point2d> project(const std::vector<cv::Point3d>& points,
                                   std::vector<cv::Matx23d>* derivatives = nullptr) const;

  /** The rays of pixels as points of the plane z = 1, without distortion. */
  std::vector<cv::Point2d> normalize(const std::vector<cv::Point2d>& pixels) const;

 private:
  cv::Size size_;
  cv::Matx33d matrix_;
  std::vector<double> distortion_;
  bool fisheye_ = false;
};

/**
 * Reads the yaml file that camera_calibration and camera_info_manager write.
 *
 * @throws std::runtime_error if it cannot be read; std::invalid_argument with file, line, key and what is expected.
 */
CameraInfo readCameraInfo(const std::string& file);

}  // namespace omr

#endif
