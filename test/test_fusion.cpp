#include "outdoor_omr/fusion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "messages_of.h"

using omr::CameraSigma;
using omr::FusedPose;
using omr::PoseEstimate;

namespace
{
/** A camera's uncertainty: along its ray ten times as large as across, the turn in proportion. */
cv::Matx66d cameraCovariance(double across)
{
  cv::Matx66d covariance = cv::Matx66d::eye() * (across * across);
  covariance(2, 2) *= 100;
  for (int i = 3; i < 6; ++i)
  {
    covariance(i, i) *= 25;
  }
  return covariance;
}

/** Looks at the origin from a distance of 2 m, at an angle about the vertical. */
cv::Affine3d cameraAt(double degrees)
{
  const cv::Affine3d turn(cv::Vec3d(0, degrees * CV_PI / 180, 0));
  return {turn.rotation(), turn * cv::Vec3d(0, 0, -2)};
}

cv::Vec6d noise(cv::RNG& random, const cv::Matx66d& covariance)
{
  cv::Vec6d step;
  for (int i = 0; i < 6; ++i)
  {
    step[i] = random.gaussian(std::sqrt(covariance(i, i)));
  }
  return step;
}

/** One camera's noisy view of a part, its own place off by `sigma`. */
PoseEstimate look(const cv::Affine3d& truth, const cv::Affine3d& frame_camera, const CameraSigma& sigma,
                  cv::RNG& random)
{
  const cv::Matx66d covariance = cameraCovariance(0.0002);
  cv::Matx66d place = cv::Matx66d::eye();
  for (int i = 0; i < 6; ++i)
  {
    place(i, i) = std::pow(i < 3 ? sigma.position : sigma.rotation, 2);
  }
  const cv::Affine3d real_camera = omr::stepped(frame_camera, noise(random, place));
  const cv::Affine3d camera_part = omr::stepped(real_camera.inv() * truth, noise(random, covariance));
  return omr::inSharedFrame({camera_part, covariance}, frame_camera, sigma);
}

TEST(Fusion, ofOneIsItself)
{
  const PoseEstimate only{cv::Affine3d(cv::Vec3d(0.1, 0.2, 0.3), cv::Vec3d(1, 2, 3)), cameraCovariance(0.001)};
  const FusedPose fused = omr::fuse({only});
  EXPECT_LT(cv::norm(fused.estimate.pose.matrix - only.pose.matrix), 1e-12);
  EXPECT_LT(cv::norm(fused.estimate.covariance - only.covariance), 1e-12);
  EXPECT_TRUE(fused.agree);
  EXPECT_EQ(fused.degrees_of_freedom, 0);
}

TEST(Fusion, takesFromEachCameraWhatItSeesBest)
{
  // Cameras at right angles: each one's depth is what the other sees across.
  const cv::Affine3d part(cv::Vec3d(0.1, 0.2, 0.3), cv::Vec3d(0.01, 0.02, 0.03));
  std::vector<PoseEstimate> estimates;
  for (const double degrees : {0, 90})
  {
    const cv::Affine3d frame_camera = cameraAt(degrees);
    const cv::Affine3d camera_part = frame_camera.inv() * part;
    const cv::Affine3d off(camera_part.rotation(), camera_part.translation() + cv::Vec3d(0, 0, 0.002));
    estimates.push_back(omr::inSharedFrame({off, cameraCovariance(0.0002)}, frame_camera, {}));
  }
  const FusedPose fused = omr::fuse(estimates);
  EXPECT_TRUE(fused.agree);
  EXPECT_LT(cv::norm(fused.estimate.pose.translation() - part.translation()), 0.0001);
  EXPECT_LT(omr::positionRadius95(fused.estimate.covariance), 0.2 * omr::positionRadius95(estimates[0].covariance));
}

TEST(Fusion, covarianceIsHonest)
{
  // 4 sigma of a share of 95 % in 2000 runs: 93 to 97 %.
  constexpr int RUNS = 2000;
  constexpr double CHI_SQUARE_95 = 12.592;  // of six coordinates
  const CameraSigma sigma{0.001, 0.001};
  cv::RNG random(1);
  int inside = 0;
  int agree = 0;
  for (int run = 0; run < RUNS; ++run)
  {
    const cv::Affine3d part(cv::Vec3d(random.uniform(-1., 1.), random.uniform(-1., 1.), random.uniform(-1., 1.)),
                            cv::Vec3d(random.uniform(-.3, .3), random.uniform(-.3, .3), random.uniform(-.3, .3)));
    const FusedPose fused =
        omr::fuse({look(part, cameraAt(-40), sigma, random), look(part, cameraAt(10), sigma, random),
                   look(part, cameraAt(60), sigma, random)});
    const cv::Vec6d error = omr::stepBetween(fused.estimate.pose, part);
    const double distance = error.dot(fused.estimate.covariance.inv() * error);
    inside += distance < CHI_SQUARE_95 ? 1 : 0;
    agree += fused.agree ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(inside) / RUNS, 0.95, 0.02);
  EXPECT_GE(agree, RUNS - 10);  // 99.9 % are to be expected
}

TEST(Fusion, refusesCamerasThatContradictEachOther)
{
  const CameraSigma sigma{0.001, 0.001};
  cv::RNG random(2);
  const cv::Affine3d part(cv::Vec3d(0.1, 0.2, 0.3), cv::Vec3d(0, 0, 0));
  const PoseEstimate left = look(part, cameraAt(-30), sigma, random);
  ASSERT_TRUE(omr::fuse({left, look(part, cameraAt(30), sigma, random)}).agree);

  // A camera that was pushed by 30 mm, and a board that is read half a turn off.
  const cv::Affine3d pushed(part.rotation(), part.translation() + cv::Vec3d(0.03, 0, 0));
  EXPECT_FALSE(omr::fuse({left, look(pushed, cameraAt(30), sigma, random)}).agree);
  const cv::Affine3d turned = part * cv::Affine3d(cv::Vec3d(0, 0, CV_PI - 0.01));
  EXPECT_FALSE(omr::fuse({left, look(turned, cameraAt(30), sigma, random)}).agree);
}

TEST(Fusion, ofWhatCannotBeFused)
{
  EXPECT_EQ(omr::test::messageOf<std::invalid_argument>([] { omr::fuse({}); }), "no estimate of a pose to fuse");
  EXPECT_EQ(omr::test::messageOf<std::invalid_argument>([] {
              omr::fuse({PoseEstimate{cv::Affine3d::Identity(), cv::Matx66d::zeros()}});
            }),
            "a covariance of a pose that is not positive definite");
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
