#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "render_target.h"
#include "targets/boundaries/boundary_arcs.h"
#include "targets/boundaries/ring_placement.h"
#include "targets/target_reading.h"

using omr::Boundary;
using omr::BoundaryArc;
using omr::RingFamily;

namespace
{
constexpr double AREA = 1. / 9;  // of the scene's rings in the image over those on their plane

TargetScene tiltedScene()
{
  TargetScene scene;
  scene.homography = tiltedView({240.3, 180.6}, .6, .7, std::sqrt(AREA), 900);
  return scene;
}

/** The family of a homography, exact. */
RingFamily familyOf(const cv::Matx33d& plane_to_image, double& scale)
{
  // With [A + c h^T, c; h^T, 1] A need not be symmetric: a turn of the plane makes it so.
  const cv::Matx33d h = plane_to_image * (1 / plane_to_image(2, 2));
  RingFamily family;
  family.center = {h(0, 2), h(1, 2)};
  const cv::Vec2d perspective(h(2, 0), h(2, 1));
  const cv::Matx22d a(h(0, 0) - h(0, 2) * h(2, 0), h(0, 1) - h(0, 2) * h(2, 1), h(1, 0) - h(1, 2) * h(2, 0),
                      h(1, 1) - h(1, 2) * h(2, 1));
  cv::Matx22d u;
  cv::Matx22d vt;
  cv::Vec2d w;
  cv::SVD::compute(a, w, u, vt);
  scale = std::sqrt(w[0] * w[1]);
  const cv::Matx22d symmetric = u * cv::Matx22d(w[0] / scale, 0, 0, w[1] / scale) * u.t();
  const cv::Vec2d turned = u * vt * perspective * (1 / scale);
  family.a = symmetric(0, 0);
  family.b = symmetric(0, 1);
  family.d = symmetric(1, 1);
  family.hx = turned[0];
  family.hy = turned[1];
  return family;
}

struct Placed
{
  RingFamily truth, family;
  std::vector<double> radii;
  std::optional<double> deviation;  // stated

  /** Distance of the outermost ellipse's centre from the true one [px]. */
  double error() const
  {
    return cv::norm(family.ellipse(radii.back()).center - truth.ellipse(radii.back()).center);
  }
};

/** Places rings that are 0.2 px off. @param agreeing directions in which they show. */
Placed place(const TargetScene& scene, const cv::Mat& image, omr::AngleBins agreeing = ~omr::AngleBins{0})
{
  Placed placed;
  double scale = 1;
  placed.truth = placed.family = familyOf(scene.homography, scale);
  for (const double radius : scene.radii)
  {
    placed.radii.push_back(radius * scale);
  }
  placed.family.center += cv::Point2d(.12, -.16);
  Boundary boundary;
  boundary.agreeing = agreeing;
  placed.deviation =
      omr::placeRings(image, std::vector<Boundary>(placed.radii.size(), boundary), placed.family, placed.radii);
  return placed;
}

TargetScene threeRings(const std::string& colors, double width)
{
  TargetScene scene;
  scene.colors = colors;
  scene.radii = {width, 2 * width, 3 * width};
  scene.sheet_half_side = 3 * width + 7;
  return scene;
}

omr::RingCandidate grown(const TargetScene& scene, const cv::Mat& image)
{
  omr::EdgelMap map(image);
  RingFamily family;
  family.center = projectedCenter(scene);
  omr::RingCandidate candidate;
  EXPECT_TRUE(omr::growCandidate(map, image, family, scene.radii, candidate));
  return candidate;
}
}  // namespace

TEST(RingPlacement, isRightToThreeHundredthsOfAPixel)
{
  for (const unsigned seed : {1, 2, 3})
  {
    TargetScene scene = tiltedScene();
    scene.seed = seed;
    EXPECT_LT(place(scene, renderTarget(scene)).error(), .03) << seed;
  }
}

TEST(RingPlacement, whatCoversAPartCountsLittle)
{
  TargetScene scene = tiltedScene();
  scene.cover = 40;
  scene.cover_offset = {70, 30};
  EXPECT_LT(place(scene, renderTarget(scene)).error(), .06);
}

TEST(RingPlacement, statesItsErrorAlsoWhereLittleShows)
{
  constexpr omr::AngleBins THIRD = (omr::AngleBins{1} << omr::ANGLE_BINS / 3) - 1;
  double before = 0;
  for (const omr::AngleBins agreeing : {~omr::AngleBins{0}, THIRD})
  {
    double squared = 0;
    double stated = 0;
    constexpr int RUNS = 30;
    for (unsigned seed = 1; seed <= RUNS; ++seed)
    {
      TargetScene scene = tiltedScene();
      scene.seed = seed;
      const Placed placed = place(scene, renderTarget(scene), agreeing);
      squared += placed.error() * placed.error() / 2;  // of each coordinate
      ASSERT_TRUE(placed.deviation);
      stated += *placed.deviation * *placed.deviation;
    }
    const double ratio = std::sqrt(squared / stated);
    EXPECT_GT(ratio, .4) << std::sqrt(stated / RUNS);
    EXPECT_LT(ratio, 1.5) << std::sqrt(stated / RUNS);
    EXPECT_GT(stated, 4 * before);
    before = stated;
  }
}

TEST(RingPlacement, aGreenRingBesideARedOneShowsToo)
{
  TargetScene scene = tiltedScene();
  scene.colors = "RGRGB";
  double scale = 1;
  const RingFamily family = familyOf(scene.homography, scale);
  std::vector<double> radii;
  for (const double radius : scene.radii)
  {
    radii.push_back(radius * scale);
  }
  std::vector<double> squared(radii.size());
  std::vector<int> count(radii.size());
  for (const BoundaryArc& arc : omr::measureArcs(renderTarget(scene), family, radii))
  {
    const double off = cv::norm(family.toPlane(arc.position)) - radii[arc.ring];
    squared[arc.ring] += off * off;
    ++count[arc.ring];
  }
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    ASSERT_GT(count[k], 6) << k;
    EXPECT_LT(std::sqrt(squared[k] / count[k]), .35) << k;  // gamma moves all of a boundary alike
  }
}

TEST(RingPlacement, ringsStayWhereNothingShows)
{
  const TargetScene scene = tiltedScene();
  const cv::Mat image = renderTarget(scene);
  for (const Placed& placed :
       {place(scene, image, 0), place(scene, cv::Mat(image.size(), CV_8UC3, cv::Scalar(90, 90, 90)))})
  {
    EXPECT_NEAR(.2, placed.error(), .01);
    EXPECT_FALSE(placed.deviation);
  }
}

TEST(RingPlacement, whatThePixelsDoNotPlaceIsNoTarget)
{
  const TargetScene scene;
  const cv::Mat image = renderTarget(scene);
  const omr::RingCandidate candidate = grown(scene, image);
  EXPECT_EQ(1U, omr::readTargets(image, {candidate}, 3).size());
  EXPECT_EQ(1U, omr::readTargets({}, {candidate}, 3).size()) << "no pixels to ask";
  EXPECT_EQ(0U, omr::readTargets(cv::Mat(image.size(), CV_8UC3, cv::Scalar(90, 90, 90)), {candidate}, 3).size());
}

TEST(RingPlacement, ofSmallRingsThatAreLessClearAllAreReadAndOneHasAHue)
{
  const auto isTarget = [](const std::string& colors, double evidence) {
    const TargetScene scene = threeRings(colors, 4.5);
    const cv::Mat image = renderTarget(scene);
    omr::RingCandidate candidate = grown(scene, image);
    candidate.evidence = evidence;
    return !omr::readTargets(image, {candidate}, 3).empty();
  };
  EXPECT_TRUE(isTarget("PWP", .97));
  EXPECT_FALSE(isTarget("PWP", .9)) << "eyes and lenses have rings, too";
  EXPECT_TRUE(isTarget("BWP", .9));
}

TEST(RingPlacement, aDiskThatSomethingHidesMayBeUnknownWhereTheOthersAreCertain)
{
  const auto letters = [](const std::string& colors, bool is_disk_shown) {
    const TargetScene scene = threeRings(colors, 6);
    const cv::Mat image = renderTarget(scene);
    omr::RingCandidate candidate = grown(scene, image);
    candidate.evidence = .8;
    candidate.boundaries.front().shown = is_disk_shown;
    const std::vector<omr::Target> targets = omr::readTargets(image, {candidate}, 3);
    return targets.empty() ? "" : targets[0].colors;
  };
  EXPECT_EQ("BRP", letters("BRP", true));
  EXPECT_EQ("?RP", letters("BRP", false));
  EXPECT_EQ("", letters("PWP", false)) << "eyes have no hue";
}

TEST(RingPlacement, needsNoBoundaries)
{
  const TargetScene scene = tiltedScene();
  double scale = 1;
  RingFamily family = familyOf(scene.homography, scale);
  const cv::Point2d center = family.center;
  std::vector<double> radii;
  for (const double radius : scene.radii)
  {
    radii.push_back(radius * scale);
  }
  family.center += cv::Point2d(.12, -.16);
  omr::placeRings(renderTarget(scene), {Boundary()}, family, radii);
  EXPECT_LT(cv::norm(family.center - center), .1);
}

TEST(RingPlacement, ringsBeyondTheImageAreNotRead)
{
  TargetScene scene = tiltedScene();
  scene.homography = tiltedView({3, 4}, .6, .7, std::sqrt(AREA), 900);
  const cv::Mat image = renderTarget(scene);
  const Placed placed = place(scene, image);
  ASSERT_TRUE(placed.deviation);
  EXPECT_LT(*placed.deviation, .6);
  EXPECT_LT(placed.error(), 1.5 * *placed.deviation);
  const std::vector<BoundaryArc> arcs = omr::measureArcs(image, placed.truth, placed.radii);
  EXPECT_GT(arcs.size(), 20U);
  const cv::Rect2d around(-2, -2, image.cols + 3, image.rows + 3);
  for (const BoundaryArc& arc : arcs)
  {
    EXPECT_TRUE(around.contains(arc.position)) << arc.position;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
