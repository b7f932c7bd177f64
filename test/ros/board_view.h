#ifndef OUTDOOR_OMR_TEST_BOARD_VIEW_H
#define OUTDOOR_OMR_TEST_BOARD_VIEW_H

#include <sensor_msgs/CameraInfo.h>

#include <opencv2/core/affine.hpp>

#include "render.h"

/** A camera without distortion that looks at flat boards of the parts in position_parts.yaml. */
namespace ros_test
{
const cv::Size VIEW_SIZE(800, 600);
const cv::Matx33d VIEW_MATRIX(900, 0, 399.5, 0, 900, 299.5, 0, 0, 1);
constexpr double VIEW_SQUARE = 0.03;  // [m]

inline sensor_msgs::CameraInfo cameraInfo()
{
  sensor_msgs::CameraInfo info;
  info.width = VIEW_SIZE.width;
  info.height = VIEW_SIZE.height;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.);
  for (int i = 0; i < 9; ++i)
  {
    info.K[i] = VIEW_MATRIX.val[i];
    info.P[4 * (i / 3) + i % 3] = VIEW_MATRIX.val[i];
  }
  return info;
}

/** The camera's view of a board whose frame is in its middle. */
inline cv::Mat view(int rows, int cols, const cv::Affine3d& camera_board)
{
  const cv::Matx33d rotation = camera_board.rotation();
  const cv::Vec3d corner = camera_board * cv::Vec3d(-0.5 * cols * VIEW_SQUARE, -0.5 * rows * VIEW_SQUARE, 0);
  cv::Matx33d squares_to_camera;
  for (int i = 0; i < 3; ++i)
  {
    squares_to_camera(i, 0) = rotation(i, 0) * VIEW_SQUARE;
    squares_to_camera(i, 1) = rotation(i, 1) * VIEW_SQUARE;
    squares_to_camera(i, 2) = corner[i];
  }
  omr::test::Render render(VIEW_SIZE);
  render.addBoard(rows, cols, VIEW_MATRIX * squares_to_camera);
  return render.picture();
}

}  // namespace ros_test

#endif
