#include <gtest/gtest.h>

#include <cmath>

#include "targets/candidate/ring_acceptance.h"

namespace
{
/** Rings of which 72 % of the directions show, all alike. @param rms of their edgels [px] */
omr::RingCandidate halfHidden(std::size_t count, double rms)
{
  omr::RingCandidate candidate;
  candidate.image_size = {640, 480};
  candidate.boundaries.resize(count);
  candidate.ring_count = static_cast<int>(count);
  candidate.visible = .72;
  candidate.evidence = .9;
  candidate.rings.rms = rms;
  for (std::size_t k = 1; k <= count; ++k)
  {
    candidate.rings.radii.push_back(28. * static_cast<double>(k) / static_cast<double>(count));
  }
  return candidate;
}
}  // namespace

TEST(RingAcceptance, threeHalfHiddenRingsFitCloserThanMany)
{
  EXPECT_TRUE(omr::isTarget(halfHidden(5, .15), 3));
  EXPECT_FALSE(omr::isTarget(halfHidden(3, .15), 3));
  EXPECT_TRUE(omr::isTarget(halfHidden(3, .13), 3));
}

TEST(RingAcceptance, manyTurnsOutweighFewDirections)
{
  const auto shown = [](omr::AngleBins bins, std::size_t count, double rms) {
    omr::Boundary boundary;
    boundary.coherence = 1;
    boundary.agreeing = boundary.supported = bins;
    omr::RingCandidate candidate = halfHidden(count, rms);
    candidate.visible = omr::share(bins);
    candidate.boundaries.assign(count, boundary);
    return candidate;
  };
  const omr::AngleBins spread = 0x0FFFFF000FFFFF00;  // 40 of 64
  const omr::AngleBins half = 0x0000000FFFFFFFFF;    // 36 of 64, on one side
  EXPECT_FALSE(omr::isClearTarget(shown(spread, 5, .1), 3));
  EXPECT_TRUE(omr::isTarget(shown(spread, 5, .1), 3));
  EXPECT_FALSE(omr::isTarget(shown(spread, 5, .2), 3));
  EXPECT_TRUE(omr::isTarget(shown(spread, 3, .06), 3));
  EXPECT_FALSE(omr::isTarget(shown(spread, 3, .1), 3));
  EXPECT_FALSE(omr::isTarget(shown(half, 5, .06), 3)) << "an arch";
}

TEST(RingAcceptance, veryClearRingsMayBeSeenInAWiderView)
{
  const auto seenAslant = [](double focal, double radius, double clearness) {
    omr::RingCandidate candidate = halfHidden(4, .1);
    candidate.visible = 1;
    candidate.evidence = clearness;
    for (double& of_ring : candidate.rings.radii)
    {
      of_ring *= radius / 28;
    }
    omr::RingFamily& family = candidate.rings.family;
    family.a = std::sqrt(2.);  // at 60 degrees
    family.d = 1 / family.a;
    family.hx = std::sin(CV_PI / 3) * family.a / focal + .1 / radius;
    return omr::isTarget(candidate, 3);
  };
  EXPECT_TRUE(seenAslant(330, 28, .85)) << "less than 90 degrees: half the image is 320 px wide";
  EXPECT_FALSE(seenAslant(250, 28, .85));
  EXPECT_TRUE(seenAslant(250, 28, .97));
  EXPECT_TRUE(seenAslant(110, 28, .97)) << "less than 143 degrees";
  EXPECT_FALSE(seenAslant(100, 28, .97));
  EXPECT_FALSE(seenAslant(250, 14, .97));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
