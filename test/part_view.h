#ifndef OUTDOOR_OMR_TEST_PART_VIEW_H
#define OUTDOOR_OMR_TEST_PART_VIEW_H

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>
#include <string>
#include <vector>

#include "outdoor_omr/camera.h"
#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/parts.h"
#include "outdoor_omr/target.h"

namespace omr
{
namespace test
{
/** A camera of 1920 x 1080 px and 1600 px focal length. @param model its D is one that a lens could have. */
CameraInfo cameraInfo(const std::string& model = "plumb_bob");

/** A pose in front of the camera: turned by degrees about the camera's x, then y, then z. */
cv::Affine3d poseAt(double x, double y, double z, double tilt_x = 0, double tilt_y = 0, double turn = 0);

/** A flat board in the middle of its part, 7 x 9 squares of 40 mm. */
PartCheckerboard flatBoard(int rows = 7, int cols = 9, double square = 0.04);

/** The ellipses that the rings of a target are seen as, which lies in the part's plane z = 0 or beside it. */
std::vector<cv::RotatedRect> ringsOf(const PartTarget& target, const cv::Affine3d& camera_part, const Camera& camera);

/** Markers as a detector sees them, with normal noise on every coordinate. */
class PartView
{
 public:
  explicit PartView(const Camera& camera, double noise_px = 0.03, std::uint64_t seed = 1);

  /**
   * @param half_turn the detector took the other one of two possible orders.
   */
  void add(const PartCheckerboard& board, const cv::Affine3d& camera_part, bool half_turn = false);

  /** The part of a board that is not hidden: squares [row, row + rows) x [col, col + cols). Its size is not certain. */
  void addSection(const PartCheckerboard& board, const cv::Affine3d& camera_part, const cv::Rect& squares);

  /** @param colors as seen; empty: right. */
  void add(const PartTarget& target, const cv::Affine3d& camera_part, const std::string& colors = "");

  /** All markers of a part. */
  void add(const Part& part, const cv::Affine3d& camera_part, bool half_turn = false);

  std::vector<Checkerboard> checkerboards;
  std::vector<Target> targets;

 private:
  cv::Point2d see(const cv::Point3d& point, const cv::Affine3d& camera_part);

  const Camera& camera_;
  double noise_px_;
  cv::RNG random_;
};

}  // namespace test
}  // namespace omr

#endif
