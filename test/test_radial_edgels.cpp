#include "targets/family/radial_edgels.h"

#include <gtest/gtest.h>

#include <random>

#include "render_target.h"
#include "targets/edges/fast_angle.h"

namespace
{
omr::RingFamily tiltedFamily(double perspective = 1)
{
  omr::RingFamily family;
  omr::familyFromMoments({241, 179}, 1.3, .3, .9, family);
  family.hx = perspective * 4e-4;
  family.hy = perspective * -3e-4;
  return family;
}
}  // namespace

TEST(FastAngle, isThatOfOpenCv)
{
  std::mt19937 random(3);
  std::normal_distribution<float> values(0, 50);
  for (int i = 0; i < 10000; ++i)
  {
    const float x = i % 10 == 0 ? 0 : values(random);
    const float y = i % 15 == 0 ? 0 : values(random);
    EXPECT_FLOAT_EQ(cv::fastAtan2(y, x), omr::fastAngle(x, y)) << x << " " << y;
  }
}

TEST(RadialEdgels, areThoseWhoseGradientIsRadial)
{
  constexpr double REACH = 90;
  constexpr double MIN_COSINE = .9;
  TargetScene scene;
  scene.noise = 6;
  omr::EdgelMap map(renderTarget(scene));
  for (const double perspective : {1., 7.})  // as far as a third of the rim's radius
  {
    const omr::RingFamily family = tiltedFamily(perspective);
    std::vector<omr::RadialEdgel> radial;
    omr::collectRadialEdgels(map, family, REACH, MIN_COSINE, radial);
    std::size_t next = 0;
    map.visit(0, 0, 479, 359, [&](const omr::Edgel& edgel) {
      constexpr double STEP = 1e-4;
      const cv::Point2d place(edgel.x, edgel.y);
      const cv::Point2d q = family.toPlane(place);
      const double radius = cv::norm(q);
      const cv::Point2d gradient((cv::norm(family.toPlane(place + cv::Point2d(STEP, 0))) - radius) / STEP,
                                 (cv::norm(family.toPlane(place + cv::Point2d(0, STEP))) - radius) / STEP);
      const double cosine = (gradient.x * edgel.nx + gradient.y * edgel.ny) / cv::norm(gradient);
      if (radius > REACH - .01 || radius < 1 || std::abs(cosine) < MIN_COSINE + 1e-3)
      {
        return;
      }
      while (next < radial.size() && radial[next].position != cv::Point2f(edgel.x, edgel.y))
      {
        ++next;
      }
      ASSERT_LT(next, radial.size()) << "edgel at " << place;
      EXPECT_NEAR(radius, radial[next].radius, 1e-3);
      EXPECT_EQ(cosine > 0, radial[next].brighter_outside);
      const double angle = std::atan2(q.y, q.x) / (2 * CV_PI) * omr::ANGLE_BINS;
      const int bin = static_cast<int>(std::floor(angle)) & (omr::ANGLE_BINS - 1);
      EXPECT_NE(0U, radial[next].bins >> bin & 1) << angle;
    });
    EXPECT_GT(radial.size(), 300U);
  }
}

TEST(RadialEdgels, tilesBeyondTheCircleAreNotLookedAt)
{
  constexpr double REACH = 150;
  TargetScene scene;
  scene.noise = 6;
  const cv::Mat image = renderTarget(scene);
  omr::EdgelMap map(image);
  const omr::RingFamily family = tiltedFamily();
  std::vector<omr::RadialEdgel> radial;
  omr::collectRadialEdgels(map, family, REACH, .9, radial);
  omr::EdgelMap box(image);
  const cv::Point2d half = family.halfBox(REACH);
  const cv::Point2d from = family.center - half;
  const cv::Point2d to = family.center + half;
  box.visit(from.x, from.y, to.x, to.y, [](const omr::Edgel&) {});
  EXPECT_LT(static_cast<double>(map.looks()), .92 * static_cast<double>(box.looks()));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
