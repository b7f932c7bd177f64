#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "messages_of.h"
#include "outdoor_omr/parts.h"
#include "outdoor_omr/pose.h"
#include "part_view.h"

using omr::Camera;
using omr::ImageKind;
using omr::isRival;
using omr::PartCheckerboard;
using omr::PointPair;
using omr::Pose;
using omr::refinePose;
using omr::solvePose;
using omr::test::cameraInfo;
using omr::test::flatBoard;
using omr::test::messageOf;
using omr::test::poseAt;

namespace
{
// chi^2 of 6 and 3 degrees of freedom that 95 % stay below.
constexpr double CHI_SQUARE_6 = 12.592;
constexpr double CHI_SQUARE_3 = 7.815;

std::vector<PointPair> pairsOf(const std::vector<cv::Point3d>& points, const cv::Affine3d& pose, const Camera& camera,
                               double noise, cv::RNG& random, double sigma = 0.05)
{
  std::vector<PointPair> pairs;
  for (const cv::Point3d& point : points)
  {
    const cv::Point2d pixel = camera.project({pose * point}).front();
    pairs.push_back({point, pixel + cv::Point2d(random.gaussian(noise), random.gaussian(noise)), sigma});
  }
  return pairs;
}

/** Error of a pose in the unknowns of its covariance. */
cv::Matx<double, 6, 1> errorOf(const Pose& pose, const cv::Affine3d& truth)
{
  const cv::Vec3d shift = pose.camera_part.translation() - truth.translation();
  const cv::Vec3d turn = cv::Affine3d(pose.camera_part.rotation() * truth.rotation().t()).rvec();
  return {shift[0], shift[1], shift[2], turn[0], turn[1], turn[2]};
}

double millimetres(const Pose& pose, const cv::Affine3d& truth)
{
  return cv::norm(pose.camera_part.translation() - truth.translation()) * 1000;
}

double degrees(const Pose& pose, const cv::Affine3d& truth)
{
  return cv::norm((pose.camera_part.inv() * truth).rvec()) * 180 / CV_PI;
}

struct View
{
  std::string name;
  std::string model;
  PartCheckerboard board;
  cv::Affine3d pose;
  double noise = 0.05;
};

PartCheckerboard bent(double radius, bool axis_along_x = false)
{
  PartCheckerboard board = flatBoard();
  board.curvature = 1 / radius;
  board.axis_along_x = axis_along_x;
  return board;
}

std::vector<View> views()
{
  return {{"near", "plumb_bob", flatBoard(), poseAt(0.1, -0.05, 1, 20, -25, 10)},
          {"far", "plumb_bob", flatBoard(), poseAt(0.7, 0.3, 6, 20, -25, 100)},
          {"noisy", "plumb_bob", flatBoard(), poseAt(0.1, -0.05, 2, 20, -25, 10), 0.5},
          {"oblique", "plumb_bob", flatBoard(), poseAt(0.1, 0, 2, 55, 20, 10)},
          {"rational", "rational_polynomial", flatBoard(), poseAt(0.3, 0.2, 2, 20, -25, 10)},
          {"fisheye", "equidistant", flatBoard(), poseAt(0.3, 0.2, 2, 20, -25, 10)},
          {"pipe", "plumb_bob", bent(0.15), poseAt(0.1, 0, 2, 20, -25, 10)},
          {"tank inside", "plumb_bob", bent(-0.3, true), poseAt(0.1, 0, 2, 20, -25, 10)}};
}

TEST(Pose, exactPixelsGiveTheExactPose)
{
  for (const View& view : views())
  {
    const Camera camera(cameraInfo(view.model), ImageKind::raw);
    cv::RNG random(1);
    const std::vector<PointPair> pairs = pairsOf(innerCorners(view.board), view.pose, camera, 0, random);
    const std::vector<Pose> poses = solvePose(pairs, camera);
    ASSERT_FALSE(poses.empty()) << view.name;
    EXPECT_LT(millimetres(poses[0], view.pose), 1e-3) << view.name;
    EXPECT_LT(degrees(poses[0], view.pose), 1e-4) << view.name;
    EXPECT_LT(poses[0].rms_error, 1e-4) << view.name;
    EXPECT_TRUE(poses.size() == 1 || !isRival(poses[0], poses[1])) << view.name;
  }
}

// The honesty that a fusion of cameras and a tolerance of 3 mm rest on.
TEST(Pose, trueOneLiesInTheEllipsoidOf95PercentAsOftenAsThat)
{
  constexpr int RUNS = 1000;  // one standard deviation of the share is 0.7 %
  for (const View& view : views())
  {
    const Camera camera(cameraInfo(view.model), ImageKind::raw);
    const std::vector<cv::Point3d> points = innerCorners(view.board);
    cv::RNG random(2);
    int inside = 0;
    int shift_inside = 0;
    for (int run = 0; run < RUNS; ++run)
    {
      const std::vector<Pose> poses = solvePose(pairsOf(points, view.pose, camera, view.noise, random), camera);
      ASSERT_FALSE(poses.empty()) << view.name;
      const cv::Matx<double, 6, 1> error = errorOf(poses[0], view.pose);
      const cv::Matx66d& covariance = poses[0].covariance;
      inside += (error.t() * covariance.inv() * error)(0) < CHI_SQUARE_6 ? 1 : 0;
      const cv::Matx33d of_shift = covariance.get_minor<3, 3>(0, 0);
      const cv::Vec3d shift(error(0), error(1), error(2));
      shift_inside += shift.dot(of_shift.inv() * shift) < CHI_SQUARE_3 ? 1 : 0;
    }
    EXPECT_GT(inside, 0.93 * RUNS) << view.name;
    EXPECT_LT(inside, 0.97 * RUNS) << view.name;
    EXPECT_GT(shift_inside, 0.93 * RUNS) << view.name;
    EXPECT_LT(shift_inside, 0.97 * RUNS) << view.name;
  }
}

TEST(Pose, covarianceFollowsTheNoiseThatIsThere)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  const cv::Affine3d truth = poseAt(0.1, -0.05, 2, 20, -25, 10);
  cv::RNG random(3);
  const std::vector<Pose> calm = solvePose(pairsOf(innerCorners(flatBoard()), truth, camera, 0.05, random), camera);
  const std::vector<Pose> noisy = solvePose(pairsOf(innerCorners(flatBoard()), truth, camera, 0.5, random), camera);
  EXPECT_NEAR(std::sqrt(noisy[0].covariance(2, 2) / calm[0].covariance(2, 2)), 10, 3);  // each 7 % uncertain
  EXPECT_NEAR(calm[0].variance_factor, 1, 0.4);
  EXPECT_NEAR(noisy[0].variance_factor, 100, 40);
  EXPECT_NEAR(noisy[0].rms_error, 0.5 * std::sqrt(2), 0.1);
}

TEST(Pose, outliersAreRejected)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  cv::RNG random(4);
  for (const View& view : views())
  {
    const Camera own(cameraInfo(view.model), ImageKind::raw);
    std::vector<PointPair> pairs = pairsOf(innerCorners(view.board), view.pose, own, view.noise, random);
    const std::vector<Pose> clean = solvePose(pairs, own);
    const std::vector<std::size_t> wrong = {0, 7, 20, 33, 47};  // a tenth, three of them corners of the board
    for (const std::size_t i : wrong)
    {
      pairs[i].pixel += cv::Point2d(random.uniform(5.0, 20.0), random.uniform(-20.0, -5.0));
    }
    const std::vector<Pose> poses = solvePose(pairs, own);
    ASSERT_FALSE(poses.empty()) << view.name;
    for (const std::size_t i : wrong)
    {
      EXPECT_FALSE(poses[0].used[i]) << view.name << " " << i;
    }
    EXPECT_GE(std::count(poses[0].used.begin(), poses[0].used.end(), true), 41) << view.name;
    const cv::Matx<double, 6, 1> moved = errorOf(poses[0], clean[0].camera_part);
    for (int i = 0; i < 6; ++i)
    {
      EXPECT_LT(std::abs(moved(i)), 3 * std::sqrt(poses[0].covariance(i, i))) << view.name;
    }
  }
}

TEST(Pose, pointsAsGoodAsTheirSigmaSaysAreNoOutliersBesideBetterOnes)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  cv::RNG random(5);
  const cv::Affine3d truth = poseAt(0.1, -0.05, 3, 20, -25, 10);
  std::vector<PointPair> pairs = pairsOf(innerCorners(flatBoard()), truth, camera, 0.002, random, 0.02);
  for (const double x : {-0.3, 0.3})
  {
    pairs.push_back({{x, 0, 0}, camera.project({truth * cv::Point3d(x, 0, 0)}).front(), 0.06});
    pairs.back().pixel += cv::Point2d(0.06, -0.06);
  }
  const std::vector<Pose> poses = solvePose(pairs, camera);
  ASSERT_FALSE(poses.empty());
  EXPECT_EQ(std::count(poses[0].used.begin(), poses[0].used.end(), true), 50);
}

TEST(Pose, halfOfThePointsWrongGiveNoPoseRatherThanAWrongOne)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  cv::RNG random(5);
  const cv::Affine3d truth = poseAt(0.1, -0.05, 2, 20, -25, 10);
  std::vector<PointPair> pairs = pairsOf(innerCorners(flatBoard()), truth, camera, 0.05, random);
  for (std::size_t i = 0; i < pairs.size(); i += 2)
  {
    pairs[i].pixel += cv::Point2d(random.uniform(-40.0, 40.0), random.uniform(-40.0, 40.0));
  }
  for (const Pose& pose : solvePose(pairs, camera))
  {
    EXPECT_LT(millimetres(pose, truth), 5);
  }
}

TEST(Pose, wrongPatternGivesNone)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  cv::RNG random(6);
  std::vector<PointPair> pairs =
      pairsOf(innerCorners(flatBoard()), poseAt(0.1, -0.05, 2, 20, -25, 10), camera, 0.05, random);
  // Every row of pixels begins one corner later than the row before.
  for (int row = 0; row < 6; ++row)
  {
    std::vector<PointPair> shifted(pairs.begin() + row * 8, pairs.begin() + (row + 1) * 8);
    for (int col = 0; col < 8; ++col)
    {
      pairs[row * 8 + (col + row) % 8].pixel = shifted[col].pixel;
    }
  }
  EXPECT_TRUE(solvePose(pairs, camera).empty());
}

TEST(Pose, flipIsToldWhereTheResidualsTell)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  cv::RNG random(7);
  const std::vector<cv::Point3d> points = innerCorners(flatBoard(7, 10, 0.04));
  int flips = 0;
  int two = 0;
  for (int run = 0; run < 200; ++run)
  {
    const cv::Affine3d truth = poseAt(0.3, 0.1, 3, random.uniform(15.0, 40.0), random.uniform(-40.0, -15.0), 10);
    const std::vector<Pose> poses = solvePose(pairsOf(points, truth, camera, 0.05, random), camera);
    ASSERT_FALSE(poses.empty());
    flips += degrees(poses[0], truth) > 5 ? 1 : 0;
    two += poses.size() > 1 && isRival(poses[0], poses[1]) ? 1 : 0;
  }
  EXPECT_EQ(flips, 0);
  EXPECT_EQ(two, 0);
}

TEST(Pose, flipIsARivalWhereTheyDoNot)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  cv::RNG random(8);
  const std::vector<cv::Point3d> points = innerCorners(flatBoard(7, 10, 0.01));
  int lost = 0;
  int wrong = 0;
  for (int run = 0; run < 200; ++run)
  {
    const cv::Affine3d truth = poseAt(0, 0, 6, random.uniform(10.0, 30.0), 0, 10);
    const std::vector<Pose> poses = solvePose(pairsOf(points, truth, camera, 0.05, random), camera);
    ASSERT_FALSE(poses.empty());
    // Where the likelier one is the flip, the true one must be among the rivals.
    const bool flipped = cv::Vec3d(poses[0].camera_part.rotation() * cv::Vec3d(0, 0, 1))[1] *
                             cv::Vec3d(truth.rotation() * cv::Vec3d(0, 0, 1))[1] <
                         0;
    wrong += flipped ? 1 : 0;
    lost += flipped && (poses.size() < 2 || !isRival(poses[0], poses[1])) ? 1 : 0;
  }
  EXPECT_GT(wrong, 10) << "too easy to test anything";
  EXPECT_EQ(lost, 0);
}

TEST(Pose, fourPoints)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  cv::RNG random(9);
  const cv::Affine3d truth = poseAt(0.1, -0.05, 2, 30, -25, 10);
  const std::vector<cv::Point3d> points = {{-0.2, -0.2, 0}, {0.2, -0.2, 0}, {0.2, 0.2, 0}, {-0.2, 0.2, 0}};
  const std::vector<Pose> poses = solvePose(pairsOf(points, truth, camera, 0.05, random), camera);
  ASSERT_FALSE(poses.empty());
  const cv::Matx<double, 6, 1> error = errorOf(poses[0], truth);
  EXPECT_LT((error.t() * poses[0].covariance.inv() * error)(0), 22);  // 99.9 %
}

TEST(Pose, pointsOfWhichNoneGives)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  cv::RNG random(10);
  const cv::Affine3d truth = poseAt(0.1, -0.05, 2, 30, -25, 10);
  const std::vector<cv::Point3d> line = {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0, 0}, {0.4, 0, 0}};
  EXPECT_TRUE(solvePose(pairsOf(line, truth, camera, 0.05, random), camera).empty());
  const std::vector<cv::Point3d> same(6, {0.1, 0.1, 0});
  EXPECT_TRUE(solvePose(pairsOf(same, truth, camera, 0.05, random), camera).empty());
}

TEST(Pose, mistakesAreNamed)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { solvePose(std::vector<PointPair>(3), camera); }),
            "a pose needs four points at least, not 3");
  std::vector<PointPair> pairs(4);
  pairs[2].sigma = 0;
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { solvePose(pairs, camera); }),
            "sigma of a point is not more than 0 pixels");
}

TEST(Pose, refinementFindsItFromNearby)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  cv::RNG random(11);
  const cv::Affine3d truth = poseAt(0.1, -0.05, 2, 20, -25, 10);
  const std::vector<PointPair> pairs = pairsOf(innerCorners(flatBoard()), truth, camera, 0.05, random);
  Pose pose;
  pose.camera_part = poseAt(0.15, 0, 2.2, 25, -20, 13);
  ASSERT_TRUE(refinePose(pairs, camera, pose));
  EXPECT_LT(cv::norm((pose.camera_part.inv() * solvePose(pairs, camera)[0].camera_part).rvec()), 1e-6);
  pose.camera_part = poseAt(0, 0, -2);
  EXPECT_FALSE(refinePose(pairs, camera, pose));
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
