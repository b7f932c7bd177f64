#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "targets/family/bent_refinement.h"
#include "targets/family/ring_refinement.h"

using omr::BoundaryPoint;
using omr::RingFamily;

namespace
{
RingFamily tiltedFamily()
{
  RingFamily family;
  omr::familyFromMoments({320.3, 240.7}, 900, 200, 500, family);
  family.hx = .0012;
  family.hy = -.0007;
  return family;
}

RingFamily bentFamily()
{
  RingFamily family = tiltedFamily();
  family.hx = family.hy = 0;
  family.bend = {.007, .004};
  family.normal = {-.2, .5};
  return family;
}

std::vector<BoundaryPoint> pointsOf(const RingFamily& family, const std::vector<double>& radii, double noise)
{
  cv::RNG random(3);
  std::vector<BoundaryPoint> points;
  for (std::size_t ring = 0; ring < radii.size(); ++ring)
  {
    for (int i = 0; i < 80; ++i)
    {
      const double phi = 2 * CV_PI * i / 80;
      const cv::Point2d p = family.toImage(radii[ring] * cv::Point2d(std::cos(phi), std::sin(phi)));
      points.push_back({p + cv::Point2d(random.gaussian(noise), random.gaussian(noise)), static_cast<int>(ring)});
    }
  }
  return points;
}
}  // namespace

TEST(RingFamily, planeAndImageInvertEachOther)
{
  const RingFamily family = tiltedFamily();
  const cv::Point2d q(31, -58);
  EXPECT_NEAR(0, cv::norm(family.toPlane(family.toImage(q)) - q), 1e-9);
}

TEST(RingFamily, aBentSheetAndItsImageInvertEachOther)
{
  const RingFamily family = bentFamily();
  for (const cv::Point2d& q : {cv::Point2d(31, -58), cv::Point2d(-60, 10), cv::Point2d(.1, .2)})
  {
    EXPECT_NEAR(0, cv::norm(family.toPlane(family.toImage(q)) - q), 1e-4);
    const cv::Point2d gradient = family.radiusGradient(q);
    const cv::Point2d p = family.toImage(q);
    const double ahead = cv::norm(family.toPlane(p + .01 * gradient)) - cv::norm(q);
    EXPECT_NEAR(gradient.dot(gradient), ahead / .01, .02);
  }
}

TEST(RingFamily, aSlightBendIsNearlyPlane)
{
  const RingFamily plane = tiltedFamily();
  RingFamily bent = plane;
  bent.bend = {1e-7, 0};
  const cv::Point2d q(31, -58);
  EXPECT_NEAR(0, cv::norm(bent.toImage(q) - plane.toImage(q)), 1e-3);
  EXPECT_NEAR(0, cv::norm(bent.radiusGradient(q) - plane.radiusGradient(q)), 1e-4);
  EXPECT_NEAR(plane.ellipse(70).size.width, bent.ellipse(70).size.width, .05);
}

TEST(RingFamily, bendIsFound)
{
  const RingFamily truth = bentFamily();
  const std::vector<double> radii = {20, 40, 60, 80};
  const std::vector<BoundaryPoint> points = pointsOf(truth, radii, .1);
  RingFamily family = tiltedFamily();
  std::vector<double> found = radii;
  // As if it were plane the circles miss their points and the centre is off.
  EXPECT_LT(1, omr::refineFamily(points, true, family, found));
  EXPECT_LT(.2, cv::norm(family.center - truth.center));
  ASSERT_TRUE(omr::findBend(points, family, found));
  EXPECT_GT(.13, omr::refineBentFamily(points, family, found));
  EXPECT_NEAR(0, cv::norm(family.center - truth.center), .1);
  EXPECT_NEAR(cv::norm(truth.bend), cv::norm(family.bend), .1 * cv::norm(truth.bend));
}

TEST(RingFamily, momentsGiveShapeOfDeterminantOne)
{
  const RingFamily family = tiltedFamily();
  EXPECT_NEAR(1, family.a * family.d - family.b * family.b, 1e-9);
  // A A^T is the covariance, scaled.
  EXPECT_NEAR(900. / 500, (family.a * family.a + family.b * family.b) / (family.b * family.b + family.d * family.d),
              1e-9);
  RingFamily none;
  EXPECT_FALSE(omr::familyFromMoments({0, 0}, 1, 2, 1, none));
}

TEST(RingFamily, ellipseIsTheCirclesImage)
{
  const RingFamily family = tiltedFamily();
  const cv::RotatedRect ellipse = family.ellipse(70);
  const double angle = ellipse.angle * CV_PI / 180;
  for (int i = 0; i < 24; ++i)
  {
    const double phi = 2 * CV_PI * i / 24;
    const cv::Point2d p = family.toImage(70 * cv::Point2d(std::cos(phi), std::sin(phi))) - cv::Point2d(ellipse.center);
    const double along = (p.x * std::cos(angle) + p.y * std::sin(angle)) / (ellipse.size.width / 2);
    const double across = (-p.x * std::sin(angle) + p.y * std::cos(angle)) / (ellipse.size.height / 2);
    EXPECT_NEAR(1, along * along + across * across, 1e-3);
  }
  EXPECT_GT(cv::norm(cv::Point2d(ellipse.center) - family.center), 1) << "perspective moves the ellipse's centre";
}

TEST(RingFamily, refinementFindsTheTrueCentre)
{
  const RingFamily truth = tiltedFamily();
  const std::vector<double> true_radii = {20, 44, 60, 90};
  const std::vector<BoundaryPoint> points = pointsOf(truth, true_radii, .1);
  RingFamily family;
  omr::familyFromMoments({323, 239}, 850, 170, 520, family);
  std::vector<double> radii = {21, 43, 61, 88};
  const double rms = omr::refineFamily(points, true, family, radii);
  EXPECT_LT(rms, .15);
  EXPECT_NEAR(0, cv::norm(family.center - truth.center), .05);
  EXPECT_NEAR(90, radii[3], .1);
}

TEST(RingFamily, refinementSurvivesOutliers)
{
  const RingFamily truth = tiltedFamily();
  const std::vector<double> true_radii = {20, 44, 60, 90};
  std::vector<BoundaryPoint> points = pointsOf(truth, true_radii, .1);
  for (std::size_t i = 0; i < points.size(); i += 4)
  {
    points[i].position += cv::Point2d(5, 3);
  }
  RingFamily family = truth;
  family.center += cv::Point2d(1, -1);
  std::vector<double> radii = true_radii;
  omr::refineFamily(points, true, family, radii);
  EXPECT_NEAR(0, cv::norm(family.center - truth.center), .1);
}

TEST(RingFamily, refusesTooFewPoints)
{
  RingFamily family;
  std::vector<double> radii = {10};
  EXPECT_TRUE(std::isinf(omr::refineFamily({}, true, family, radii)));
  EXPECT_EQ(10, radii[0]);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
