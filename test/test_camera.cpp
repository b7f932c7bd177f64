#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "messages_of.h"
#include "outdoor_omr/camera.h"
#include "own_folder.h"
#include "part_view.h"

using omr::Camera;
using omr::CameraInfo;
using omr::ImageKind;
using omr::test::cameraInfo;
using omr::test::messageOf;
using omr::test::writeFile;

namespace
{
/** Points over the whole image, from 0.5 to 6 m; the first lies on the optical axis. */
std::vector<cv::Point3d> pointsInView()
{
  std::vector<cv::Point3d> points;
  for (const double z : {0.5, 2.0, 6.0})
  {
    for (const double x : {0.0, -0.55, 0.3, 0.55})
    {
      for (const double y : {0.0, -0.3, 0.31})
      {
        points.emplace_back(x * z, y * z, z);
      }
    }
  }
  return points;
}

class Models : public ::testing::TestWithParam<std::string>
{
};

TEST_P(Models, normalizeInvertsProject)
{
  const Camera camera(cameraInfo(GetParam()), ImageKind::raw);
  const std::vector<cv::Point3d> points = pointsInView();
  const std::vector<cv::Point2d> rays = camera.normalize(camera.project(points));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_NEAR(rays[i].x, points[i].x / points[i].z, 1e-6);  // 0.002 px
    EXPECT_NEAR(rays[i].y, points[i].y / points[i].z, 1e-6);
  }
}

TEST_P(Models, derivativesAreThoseOfDifferences)
{
  const Camera camera(cameraInfo(GetParam()), ImageKind::raw);
  const std::vector<cv::Point3d> points = pointsInView();
  std::vector<cv::Matx23d> derivatives;
  camera.project(points, &derivatives);
  const double step = 1e-6;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      cv::Vec3d shift(0, 0, 0);
      shift[axis] = step;
      const cv::Point3d before = points[i] - cv::Point3d(shift);
      const cv::Point3d after = points[i] + cv::Point3d(shift);
      const std::vector<cv::Point2d> pixels = camera.project({before, after});
      const cv::Point2d slope = (pixels[1] - pixels[0]) * (1 / (2 * step));
      EXPECT_NEAR(derivatives[i](0, axis), slope.x, 0.01) << points[i] << axis;
      EXPECT_NEAR(derivatives[i](1, axis), slope.y, 0.01) << points[i] << axis;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Camera, Models, ::testing::Values("plumb_bob", "rational_polynomial", "equidistant"));

TEST(Camera, rawUsesKAndD)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  EXPECT_EQ(camera.size(), cv::Size(1920, 1080));
  EXPECT_DOUBLE_EQ(camera.focalLength(), 1602.5);
  const cv::Point2d middle = camera.project({{0, 0, 3}}).front();
  EXPECT_NEAR(middle.x, 950, 1e-9);
  EXPECT_NEAR(middle.y, 530, 1e-9);
  // x = 0.5, r^2 = 0.25: radial 1 + k1 r^2 + k2 r^4 + k3 r^6, tangential p1, p2 (OpenCV's camera model).
  const double radial = 1 - 0.2 * 0.25 + 0.1 * 0.0625 - 0.02 * 0.015625;
  const cv::Point2d side = camera.project({{1, 0, 2}}).front();
  EXPECT_NEAR(side.x, 950 + 1600 * (0.5 * radial - 0.0005 * (0.25 + 2 * 0.25)), 1e-9);
  EXPECT_NEAR(side.y, 530 + 1605 * (0.001 * 0.25), 1e-9);
}

TEST(Camera, fisheyeIsEquidistant)
{
  CameraInfo info = cameraInfo("equidistant");
  info.D = {0, 0, 0, 0};
  const Camera camera(info, ImageKind::raw);
  EXPECT_NEAR(camera.project({{1, 0, 2}}).front().x, 950 + 1600 * std::atan(0.5), 1e-9);
  info.distortion_model = "fisheye";
  EXPECT_NEAR(Camera(info, ImageKind::raw).project({{1, 0, 2}}).front().x, 950 + 1600 * std::atan(0.5), 1e-9);
}

TEST(Camera, rectifiedUsesP)
{
  CameraInfo info = cameraInfo();
  info.P[3] = -150;  // the right camera of a stereo pair: its own frame is asked for
  const Camera camera(info, ImageKind::rectified);
  const cv::Point2d side = camera.project({{1, 0, 2}}).front();
  EXPECT_NEAR(side.x, 955 + 1500 * 0.5, 1e-9);
  EXPECT_NEAR(side.y, 535, 1e-9);
  EXPECT_NEAR(camera.normalize({side}).front().x, 0.5, 1e-12);
}

TEST(Camera, rectifiedNeedsNoDistortionModel)
{
  CameraInfo info = cameraInfo();
  info.distortion_model = "";
  info.D.clear();
  EXPECT_NO_THROW(Camera(info, ImageKind::rectified));
}

TEST(Camera, strongDistortionIsALens)
{
  CameraInfo info = cameraInfo();
  info.K = {500, 0, 950, 0, 500, 530, 0, 0, 1};  // 125 degrees wide
  info.D = {-0.32, 0.12, 0.001, -0.001, -0.02};  // does not rise to the corners
  EXPECT_NO_THROW(Camera(info, ImageKind::raw));
  info.distortion_model = "equidistant";  // 230 degrees wide
  info.D = {0.1, -0.02, 0.01, -0.002};
  EXPECT_NO_THROW(Camera(info, ImageKind::raw));
}

TEST(Camera, emptyD)
{
  CameraInfo info = cameraInfo();
  info.D.clear();
  EXPECT_NEAR(Camera(info, ImageKind::raw).project({{1, 0, 2}}).front().x, 950 + 800, 1e-9);
}

TEST(Camera, noPoints)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  std::vector<cv::Matx23d> derivatives(3);
  EXPECT_TRUE(camera.project({}, &derivatives).empty());
  EXPECT_TRUE(derivatives.empty());
  EXPECT_TRUE(camera.normalize({}).empty());
}

TEST(Camera, mistakesAreNamed)
{
  struct Mistake
  {
    std::function<void(CameraInfo&)> make;
    ImageKind kind;
    std::string answer;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Mistake> mistakes = {
      {[](CameraInfo& info) { info = CameraInfo(); }, ImageKind::raw, "width x height is 0 x 0"},
      {[](CameraInfo& info) { info.width = -3; }, ImageKind::raw, "width x height is -3 x 1080"},
      {[](CameraInfo& info) { info.K = {}; }, ImageKind::raw, "the camera is not calibrated: K[0] = 0"},
      {[](CameraInfo& info) { info.K = {}; }, ImageKind::rectified, "the camera is not calibrated: K[0] = 0"},
      {[](CameraInfo& info) { info.P = {}; }, ImageKind::rectified, "the camera is not calibrated: P[0] = 0"},
      {[](CameraInfo& info) { info.K[4] = 0; }, ImageKind::raw, "K holds the focal length 0"},
      {[](CameraInfo& info) { info.K[0] = -1600; }, ImageKind::raw, "K holds the focal length -1600"},
      {[&](CameraInfo& info) { info.K[0] = nan; }, ImageKind::raw, "K holds the focal length nan"},
      {[](CameraInfo& info) { info.K[2] = 9500; }, ImageKind::raw, "K holds the principal point (9500, 530)"},
      {[&](CameraInfo& info) { info.P[6] = nan; }, ImageKind::rectified, "P holds the principal point (955, nan)"},
      {[](CameraInfo& info) { info.K[1] = 2; }, ImageKind::raw, "K[1] = 2: expected 0"},
      {[](CameraInfo& info) { info.distortion_model = "fov"; }, ImageKind::raw,
       "the distortion model 'fov' is not known: expected plumb_bob, rational_polynomial or equidistant"},
      {[](CameraInfo& info) { info.D.resize(3); }, ImageKind::raw, "D has 3 values: plumb_bob has 4 or 5"},
      {[](CameraInfo& info) { info.D.resize(8); }, ImageKind::raw, "D has 8 values: plumb_bob has 4 or 5"},
      {[](CameraInfo& info) { info.distortion_model = "rational_polynomial"; }, ImageKind::raw,
       "D has 5 values: rational_polynomial has 8, 12 or 14"},
      {[](CameraInfo& info) { info.distortion_model = "equidistant"; }, ImageKind::raw,
       "D has 5 values: equidistant has 4"},
      {[&](CameraInfo& info) { info.D[1] = nan; }, ImageKind::raw, "D holds a value that is no number"},
      {[](CameraInfo& info) { info.D[0] = 1e6; }, ImageKind::raw, "D is no distortion of a lens"},
      {[](CameraInfo& info) { info.D[0] = -40; }, ImageKind::raw, "D is no distortion of a lens"},
      {[](CameraInfo& info) { info.D[2] = 1e300; }, ImageKind::raw, "D is no distortion of a lens"},
      {[](CameraInfo& info) {
         info.D = {0, 0, 0, -1e8}, info.distortion_model = "equidistant";
       },
       ImageKind::raw, "D is no distortion of a lens: it cannot be undone at pixel ("},
  };
  for (const Mistake& mistake : mistakes)
  {
    CameraInfo info = cameraInfo();
    mistake.make(info);
    const std::string said = messageOf<std::invalid_argument>([&] { Camera(info, mistake.kind); });
    EXPECT_NE(said.find(mistake.answer), std::string::npos) << "expected: " << mistake.answer << "\n  said: " << said;
  }
}

const std::string GOOD =
    "image_width: 1920\nimage_height: 1080\ncamera_name: left\n"
    "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [1600, 0, 950, 0, 1605, 530, 0, 0, 1]\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.2, 0.1, 0.001, -0.0005, -0.02]\n"
    "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [1500, 0, 955, 0, 0, 1500, 535, 0, 0, 0, 1, 0]\n";

TEST(CameraInfoFile, isRead)
{
  const CameraInfo info = omr::readCameraInfo(writeFile("camera.yaml", GOOD));
  const CameraInfo expected = cameraInfo();
  EXPECT_EQ(info.width, expected.width);
  EXPECT_EQ(info.height, expected.height);
  EXPECT_EQ(info.distortion_model, expected.distortion_model);
  EXPECT_EQ(info.K, expected.K);
  EXPECT_EQ(info.D, expected.D);
  EXPECT_EQ(info.P, expected.P);
}

TEST(CameraInfoFile, mistakesAreNamed)
{
  EXPECT_EQ(messageOf<std::runtime_error>([] { omr::readCameraInfo("/nonexistent.yaml"); }),
            "cannot read the file '/nonexistent.yaml'");
  struct Mistake
  {
    std::string wrong;
    std::string right;
    std::string answer;
  };
  const std::vector<Mistake> mistakes = {
      {"", "image_width: 1920\n", ":1: the key 'image_width' is missing: expected the width of the image [px]"},
      {"image_width: wide", "image_width: 1920", ":1: image_width: expected a width in pixels, not 'wide'"},
      {"image_height: 0", "image_height: 1080", ":2: image_height: expected a height in pixels, not '0'"},
      {"1605, 530, 0, 0", "1605, 530, 0, 0, 1", ":7: camera_matrix.data: expected a list of 9 numbers, not 8 values"},
      {"-0.2, x", "-0.2, 0.1", ":12: distortion_coefficients.data[1]: expected a number, not 'x'"},
      {"distortion_model: bent", "distortion_model: plumb_bob", "the distortion model 'bent' is not known"},
      {"data: [0, 0,", "data: [1600, 0,", "the camera is not calibrated"},
      {"camera_matrix: 3\nother:\n", "camera_matrix:\n", ":4: camera_matrix: expected a map with the key 'data'"},
  };
  for (const Mistake& mistake : mistakes)
  {
    std::string text = GOOD;
    ASSERT_NE(text.find(mistake.right), std::string::npos);
    text.replace(text.find(mistake.right), mistake.right.size(), mistake.wrong);
    const std::string file = writeFile("camera.yaml", text);
    const std::string said = messageOf<std::invalid_argument>([&] { omr::readCameraInfo(file); });
    EXPECT_EQ(said.compare(0, file.size(), file), 0) << said;
    EXPECT_NE(said.find(mistake.answer), std::string::npos) << "expected: " << mistake.answer << "\n  said: " << said;
  }
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
