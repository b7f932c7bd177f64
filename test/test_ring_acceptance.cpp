#include <gtest/gtest.h>

#include "targets/ring_candidate.h"

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

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
