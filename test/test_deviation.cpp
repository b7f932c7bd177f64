#include "outdoor_omr/deviation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>

#include "messages_of.h"
#include "outdoor_omr/goals.h"
#include "outdoor_omr/pose_estimate.h"
#include "own_folder.h"

using omr::Deviation;
using omr::deviationFrom;
using omr::Goal;
using omr::PoseEstimate;
using omr::readGoals;
using omr::Verdict;
using omr::test::messageOf;
using omr::test::writeFile;

namespace
{
constexpr double DEGREE = CV_PI / 180;

/** Of equal standard deviations in position [m] and rotation [rad]. */
cv::Matx66d covarianceOf(double position, double rotation)
{
  cv::Matx66d covariance = cv::Matx66d::zeros();
  for (int i = 0; i < 6; ++i)
  {
    covariance(i, i) = i < 3 ? position * position : rotation * rotation;
  }
  return covariance;
}

/** 3 mm, 1 degree; a quarter turn about z. */
Goal goalAt(const cv::Vec3d& position)
{
  return {"plate", "base", cv::Affine3d(cv::Vec3d(0, 0, CV_PI / 2), position), 0.003, DEGREE};
}

/** The verdict on a part that is off by these. */
Verdict verdictOn(double millimetres, double degrees, double sigma_mm, double sigma_degrees)
{
  const Goal goal = goalAt({1, 2, 3});
  const cv::Affine3d off(cv::Vec3d(degrees * DEGREE, 0, 0), cv::Vec3d(0, millimetres / 1000, 0));
  return deviationFrom(goal, {goal.pose * off, covarianceOf(sigma_mm / 1000, sigma_degrees * DEGREE)}).verdict;
}

TEST(Deviation, isAlongTheAxesOfTheGoal)
{
  const Goal goal = goalAt({1, 2, 3});
  // 2 mm along the frame's x are -2 mm along the goal's y.
  const cv::Affine3d pose(goal.pose.rotation(), goal.pose.translation() + cv::Vec3d(0.002, 0, 0));
  const Deviation deviation = deviationFrom(goal, {pose, covarianceOf(0.0001, 0.001)});
  EXPECT_LT(cv::norm(deviation.translation - cv::Vec3d(0, -0.002, 0)), 1e-12);
  EXPECT_LT(cv::norm(deviation.rotation), 1e-12);
  EXPECT_NEAR(deviation.position_uncertainty, 0.0001 * std::sqrt(7.815), 1e-9);
  EXPECT_NEAR(deviation.rotation_uncertainty, 0.001 * std::sqrt(7.815), 1e-9);

  const cv::Affine3d turned(cv::Affine3d(cv::Vec3d(0, 0.01, 0)).rotation() * goal.pose.rotation(),
                            goal.pose.translation());
  EXPECT_LT(cv::norm(deviationFrom(goal, {turned, covarianceOf(1e-4, 1e-4)}).rotation - cv::Vec3d(0.01, 0, 0)), 1e-9);
}

TEST(Deviation, isJudgedWithItsUncertainty)
{
  EXPECT_EQ(verdictOn(0, 0, 0.1, 0.01), Verdict::within);
  EXPECT_EQ(verdictOn(2.5, 0, 0.1, 0.01), Verdict::within);
  EXPECT_EQ(verdictOn(2.9, 0, 0.1, 0.01), Verdict::undecided);  // +- 0.28 mm
  EXPECT_EQ(verdictOn(3.1, 0, 0.1, 0.01), Verdict::undecided);
  EXPECT_EQ(verdictOn(3.5, 0, 0.1, 0.01), Verdict::outside);
  EXPECT_EQ(verdictOn(0, 0.9, 0.1, 0.01), Verdict::within);
  EXPECT_EQ(verdictOn(0, 0.9, 0.1, 0.1), Verdict::undecided);
  EXPECT_EQ(verdictOn(0, 1.1, 0.1, 0.01), Verdict::outside);
  EXPECT_EQ(verdictOn(2.9, 1.1, 0.1, 0.01), Verdict::outside);
  EXPECT_EQ(verdictOn(0, 0, 2, 0.01), Verdict::undecided);  // too uncertain to say yes, whatever it reads
}

TEST(PoseEstimate, stepsLeadWhereTheyWereTakenFrom)
{
  const cv::Affine3d from(cv::Vec3d(0.3, -1.2, 0.7), cv::Vec3d(1, 2, 3));
  const cv::Affine3d to(cv::Vec3d(-0.9, 0.1, 2.0), cv::Vec3d(-4, 5, 0.5));
  const cv::Affine3d reached = omr::stepped(from, omr::stepBetween(from, to));
  EXPECT_LT(cv::norm(reached.matrix - to.matrix), 1e-9);
  EXPECT_LT(cv::norm(omr::stepBetween(from, from)), 1e-12);
}

TEST(PoseEstimate, covarianceTurnsWithTheFrame)
{
  cv::Matx66d covariance = covarianceOf(0.001, 0.001);
  covariance(2, 2) = 1;                                                            // uncertain along the camera's z
  const cv::Affine3d base_camera(cv::Vec3d(0, CV_PI / 2, 0), cv::Vec3d(1, 0, 0));  // which is the base's x
  const PoseEstimate in_base =
      omr::transformed({cv::Affine3d::Identity().translate({0, 0, 5}), covariance}, base_camera);
  EXPECT_LT(cv::norm(in_base.pose.translation() - cv::Vec3d(6, 0, 0)), 1e-12);
  EXPECT_NEAR(in_base.covariance(0, 0), 1, 1e-9);
  EXPECT_NEAR(in_base.covariance(2, 2), 1e-6, 1e-9);
  EXPECT_NEAR(omr::positionRadius95(in_base.covariance), std::sqrt(7.815), 1e-6);
}

TEST(PoseEstimate, relativeToAnotherPartIsHonest)
{
  constexpr int RUNS = 2000;
  constexpr double CHI_SQUARE_95 = 12.592;  // of six coordinates
  const cv::Affine3d plate(cv::Vec3d(0.3, -0.4, 1.2), cv::Vec3d(-0.5, 0.1, 2));
  const cv::Affine3d pipe(cv::Vec3d(-1.1, 0.2, 0.3), cv::Vec3d(0.6, -0.2, 2.5));
  const cv::Affine3d truth = plate.inv() * pipe;
  cv::RNG random(3);
  const auto measured = [&](const cv::Affine3d& pose, double position, double rotation) {
    cv::Vec6d noise;
    for (int i = 0; i < 6; ++i)
    {
      noise[i] = random.gaussian(i < 3 ? position : rotation);
    }
    return PoseEstimate{omr::stepped(pose, noise), covarianceOf(position, rotation)};
  };
  int inside = 0;
  for (int run = 0; run < RUNS; ++run)
  {
    const PoseEstimate relative = omr::relativeTo(measured(plate, 0.001, 0.002), measured(pipe, 0.0005, 0.003));
    const cv::Vec6d error = omr::stepBetween(relative.pose, truth);
    inside += error.dot(relative.covariance.inv() * error) < CHI_SQUARE_95 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(inside) / RUNS, 0.95, 0.02);  // 4 sigma
  // A metre away the plate's turn counts for more than its position.
  const PoseEstimate relative = omr::relativeTo({plate, covarianceOf(0.001, 0.002)}, {pipe, covarianceOf(0, 0)});
  EXPECT_GT(omr::positionRadius95(relative.covariance), 2 * omr::positionRadius95(covarianceOf(0.001, 0)));
}

/** The rotation of a goal with these degrees. */
cv::Matx33d readRotation(const cv::Vec3d& degrees)
{
  std::ostringstream text;
  text << std::setprecision(17) << "goals:\n- {part: plate, frame: base, pose: {xyz: [0, 0, 1], rpy_degrees: ["
       << degrees[0] << ", " << degrees[1] << ", " << degrees[2] << "]}, tolerance_mm: 3, tolerance_degrees: 1}\n";
  return readGoals(writeFile("turned.yaml", text.str())).at(0).pose.rotation();
}

TEST(PoseEstimate, rollPitchAndYawAreThoseOfTheFiles)
{
  for (const cv::Vec3d& degrees : {cv::Vec3d(25, -20, 10), cv::Vec3d(-170, 80, 100), cv::Vec3d(0, 0, 180)})
  {
    EXPECT_LT(cv::norm(omr::rollPitchYaw(readRotation(degrees)) / DEGREE - degrees), 1e-9) << degrees;
  }
  for (const cv::Vec3d& degrees : {cv::Vec3d(30, 90, 50), cv::Vec3d(30, -90, 50)})
  {
    const cv::Vec3d again = omr::rollPitchYaw(readRotation(degrees)) / DEGREE;
    EXPECT_EQ(again[2], 0);
    EXPECT_LT(cv::norm(readRotation(again), readRotation(degrees)), 1e-7) << again;
  }
}

TEST(Goals, workedExample)
{
  const std::vector<Goal> goals = readGoals(OUTDOOR_OMR_CONFIG "/goals.yaml");
  ASSERT_EQ(goals.size(), 2U);
  EXPECT_EQ(goals[0].part, "plate");
  EXPECT_EQ(goals[0].frame, "camera");
  EXPECT_EQ(goals[0].pose.translation(), cv::Vec3d(0.1, 0, 1.5));
  EXPECT_NEAR(cv::norm(goals[0].pose.rvec() - cv::Vec3d(0, 0, CV_PI / 2)), 0, 1e-9);
  EXPECT_DOUBLE_EQ(goals[0].position_tolerance, 0.003);
  EXPECT_DOUBLE_EQ(goals[0].rotation_tolerance, 0.5 * DEGREE);
  EXPECT_EQ(goals[1].frame, "plate");
}

TEST(Goals, mistakesAreNamed)
{
  const auto goal_with = [](const std::string& part, const std::string& frame, const std::string& rest) {
    return "goals:\n- part: " + part + "\n  frame: " + frame + "\n  pose: {xyz: [0, 0, 1]}\n" + rest;
  };
  const std::string tolerances = "  tolerance_mm: 3\n  tolerance_degrees: 1\n";
  const std::string good = goal_with("plate", "base", tolerances);
  ASSERT_EQ(readGoals(writeFile("goals.yaml", good)).size(), 1U);
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"", ":1: expected a map with the key 'goals'"},
      {"goals: []", ":1: goals: expected a list of one goal or more"},
      {"goals: [plate]", ":1: goals[0]: expected a map with 'part', 'frame', 'pose'"},
      {"goals: [{frame: base}]", ":1: goals[0]: the key 'part' is missing: expected the name of a part"},
      {goal_with("plate", "/base", tolerances), ":3: goals[0].frame: '/base': frames of tf2 do not begin with /"},
      {goal_with("plate", "plate", tolerances), ":3: goals[0].frame: 'plate' is the part itself"},
      {goal_with("plate", "base", "  tolerance_degrees: 1\n"), "the key 'tolerance_mm' is missing"},
      {goal_with("plate", "base", "  tolerance_mm: 0\n  tolerance_degrees: 1\n"),
       ":5: goals[0].tolerance_mm: expected the largest distance from the goal in millimetres, 0.001 to 1000, not '0'"},
      {goal_with("plate", "base", "  tolerance_mm: 3\n  tolerance_degrees: 200\n"), "0.001 to 180, not '200'"},
      {goal_with("plate", "base", tolerances + "  tolerance: 3\n"), "there is no key 'tolerance'"},
      {good + good.substr(good.find('\n') + 1), ":7: goals[1].part: the part 'plate' has a goal already"},
  };
  for (const auto& [text, answer] : mistakes)
  {
    const std::string file = writeFile("goals.yaml", text);
    const std::string said = messageOf<std::invalid_argument>([&file = file] { readGoals(file); });
    EXPECT_NE(said.find(answer), std::string::npos) << text << "\n  said: " << said;
  }
  EXPECT_EQ(messageOf<std::runtime_error>([] { readGoals("/nonexistent/goals.yaml"); }),
            "cannot read the file '/nonexistent/goals.yaml'");
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
