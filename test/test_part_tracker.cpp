#include "outdoor_omr/part_tracker.h"

#include <gtest/gtest.h>

#include <cmath>

using omr::PartTracker;
using omr::TrackedPart;

namespace
{
constexpr double SIGMA = 0.001;  // [m], [rad]

TrackedPart partAt(const std::string& name, double x, double y = 0)
{
  return {name, {cv::Affine3d::Identity().translate({x, y, 1}), cv::Matx66d::eye() * (SIGMA * SIGMA)}, 0, 0};
}

std::vector<std::uint32_t> idsOf(PartTracker& tracker, std::vector<TrackedPart> parts, double time)
{
  tracker.track(parts, time);
  std::vector<std::uint32_t> ids;
  for (const TrackedPart& part : parts)
  {
    ids.push_back(part.id);
  }
  return ids;
}

using Ids = std::vector<std::uint32_t>;

TEST(PartTracker, copiesAreNumberedFromOneAgainWhenOthersHaveGone)
{
  PartTracker tracker({1, 2, 0});
  const auto copiesOf = [&](std::vector<TrackedPart> parts, double time) {
    tracker.track(parts, time);
    Ids copies;
    for (const TrackedPart& part : parts)
    {
      copies.push_back(part.copy);
    }
    return copies;
  };
  EXPECT_EQ(copiesOf({partAt("plate", 0), partAt("plate", 0.5), partAt("pipe", 0)}, 0), (Ids{1, 2, 1}));
  EXPECT_EQ(copiesOf({partAt("plate", 0.5)}, 1), Ids{2});
  EXPECT_EQ(copiesOf({partAt("plate", 0.5), partAt("plate", 9)}, 1.5), (Ids{2, 3}));  // the first may come back
  EXPECT_EQ(copiesOf({partAt("plate", 0.5), partAt("plate", 20)}, 3), (Ids{2, 1}));
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 20)}, 3.1), Ids{5});
}

TEST(PartTracker, copiesKeepTheirNumbersInAnyOrder)
{
  PartTracker tracker({1, 2, 0});
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 0), partAt("plate", 0.5), partAt("pipe", 0)}, 0), (Ids{1, 2, 3}));
  EXPECT_EQ(idsOf(tracker, {partAt("pipe", 0.02), partAt("plate", 0.47), partAt("plate", 0.04)}, 0.1), (Ids{3, 2, 1}));
  // They pass each other at a distance, step by step.
  for (int i = 1; i <= 10; ++i)
  {
    EXPECT_EQ(idsOf(tracker, {partAt("plate", 0.04 + 0.043 * i, 0.1), partAt("plate", 0.47 - 0.043 * i, -0.1)},
                    0.1 + 0.3 * i),
              (Ids{1, 2}));
  }
}

TEST(PartTracker, aNumberIsNeverGivenToAnother)
{
  PartTracker tracker({1, 2, 0});
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 0)}, 0), Ids{1});
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 0.5)}, 0.1), Ids{2});  // 5 m/s: not the same one
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 0)}, 0.2), Ids{1});    // there it is again
  EXPECT_EQ(idsOf(tracker, {}, 1), Ids{});
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 0)}, 1.5), Ids{1});  // hidden for a moment
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 0)}, 4), Ids{3});    // for too long
}

TEST(PartTracker, beginsAnewWhenTimeJumpsBack)
{
  PartTracker tracker({1, 2, 0});
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 0)}, 100), Ids{1});
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 0)}, 50), Ids{2});
  EXPECT_EQ(idsOf(tracker, {partAt("plate", 0)}, 50.1), Ids{2});
}

TEST(PartTracker, doesNotTouchPosesUnlessAskedTo)
{
  PartTracker tracker({1, 2, 0});
  std::vector<TrackedPart> parts{partAt("plate", 0)};
  tracker.track(parts, 0);
  parts = {partAt("plate", 0.001)};
  tracker.track(parts, 0.1);
  EXPECT_EQ(parts[0].estimate.pose.translation()[0], 0.001);
}

TEST(PartTracker, smoothsAtRestAndFollowsAMoveAtOnce)
{
  PartTracker tracker({1, 2, 0.5});
  cv::RNG random(1);
  double squares = 0;
  int count = 0;
  for (int i = 0; i < 200; ++i)
  {
    std::vector<TrackedPart> parts{partAt("plate", random.gaussian(SIGMA))};
    tracker.track(parts, 0.1 * i);
    if (i >= 50)
    {
      squares += std::pow(parts[0].estimate.pose.translation()[0], 2);
      ++count;
    }
  }
  // Of an exponential mean with weight a the variance is a / (2 - a), here 0.1.
  EXPECT_LT(std::sqrt(squares / count), 0.5 * SIGMA);
  std::vector<TrackedPart> moved{partAt("plate", 0.02)};
  tracker.track(moved, 20);
  EXPECT_EQ(moved[0].id, 1U);
  EXPECT_EQ(moved[0].estimate.pose.translation()[0], 0.02);
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
