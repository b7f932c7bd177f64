#include <gtest/gtest.h>

#include <cmath>

#include "view_collector.h"

using omr::ViewCollector;
using outdoor_omr::PartArray;

namespace
{
PartArray viewAt(double stamp)
{
  PartArray view;
  view.header.stamp = ros::Time(stamp);
  return view;
}

/** Of each collection the number of views. */
std::vector<std::size_t> sizes(const std::vector<ViewCollector::Collection>& collections)
{
  std::vector<std::size_t> result;
  for (const ViewCollector::Collection& collection : collections)
  {
    result.push_back(collection.views.size());
  }
  return result;
}

using Sizes = std::vector<std::size_t>;

/** Two cameras that were heard, and nothing that is open. */
class TwoCameras : public testing::Test
{
 protected:
  TwoCameras()
  {
    EXPECT_EQ(sizes(collector_.add(0, viewAt(9.9), 0)), Sizes{1});  // nobody else was ever heard
    EXPECT_EQ(sizes(collector_.add(1, viewAt(9.95), 0.01)), Sizes{});
    EXPECT_EQ(sizes(collector_.takeLate(0.12)), Sizes{1});
  }

  ViewCollector collector_{2, 0.02, 0.1};
};

TEST_F(TwoCameras, viewsOfOneTimeAreOneCollection)
{
  EXPECT_EQ(sizes(collector_.add(0, viewAt(10), 0.2)), Sizes{});
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10.01), 0.22)), Sizes{2});
  EXPECT_EQ(sizes(collector_.takeLate(0.5)), Sizes{});
}

TEST_F(TwoCameras, aSlowOneIsWaitedForThoughTheOtherIsPeriodsAhead)
{
  constexpr double PERIOD = 1. / 30;
  constexpr int FRAMES = 30;
  // What the one says of frame i comes at once, what the other says 1.5 or 2.5 periods later.
  for (const double skew : {1.5, 2.5})
  {
    Sizes done;
    for (double half = 0; half < 2 * FRAMES + 6; ++half)
    {
      const double now = 1 + 10 * skew + half * PERIOD / 2;
      const double stamp = 20 + 10 * skew;
      const auto answer = [&](std::size_t camera, double frame) {
        if (frame >= 0 && frame < FRAMES && frame == std::floor(frame))
        {
          for (const std::size_t size : sizes(collector_.add(camera, viewAt(stamp + frame * PERIOD), now)))
          {
            done.push_back(size);
          }
        }
      };
      answer(0, half / 2);
      answer(1, half / 2 - skew);
      EXPECT_EQ(sizes(collector_.takeLate(now)), Sizes{});
    }
    // The other has been silent for more than a second when it starts: the first frames are not waited for.
    EXPECT_EQ(Sizes(done.end() - 25, done.end()), Sizes(25, 2)) << skew;
  }
}

TEST_F(TwoCameras, aSilentOneIsGivenUpAndAfterASecondNotWaitedFor)
{
  EXPECT_EQ(sizes(collector_.add(0, viewAt(10.2), 0.2)), Sizes{});
  EXPECT_EQ(sizes(collector_.takeLate(0.25)), Sizes{});
  EXPECT_EQ(sizes(collector_.takeLate(0.31)), Sizes{1});
  EXPECT_EQ(sizes(collector_.takeLate(0.5)), Sizes{});
  EXPECT_EQ(sizes(collector_.add(0, viewAt(12), 2)), Sizes{1});
  EXPECT_NEAR(collector_.silence(1, 2), 1.99, 1e-9);
}

TEST_F(TwoCameras, camerasThatAreTriggeredEveryTwoSecondsAreFused)
{
  for (int round = 1; round < 6; ++round)
  {
    const double now = 2. * round;
    const Sizes left = sizes(collector_.add(0, viewAt(10 + now), now + 0.1));
    const Sizes right = sizes(collector_.add(1, viewAt(10 + now), now + 0.15));
    if (round > 2)  // by then their intervals are known
    {
      EXPECT_EQ(left, Sizes{});
      EXPECT_EQ(right, Sizes{2}) << round;
    }
  }
}

TEST_F(TwoCameras, timesAreGivenInTheirOrder)
{
  EXPECT_EQ(sizes(collector_.add(0, viewAt(10.1), 0.2)), Sizes{});
  const auto passed = collector_.add(1, viewAt(10.0), 0.21);  // the other has passed it
  ASSERT_EQ(sizes(passed), Sizes{1});
  EXPECT_EQ(passed[0].stamp, ros::Time(10.0));
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10.1), 0.22)), Sizes{2});
}

TEST(ThreeCameras, timesAreGivenInTheirOrder)
{
  ViewCollector collector(3, 0.02, 0.1);
  for (std::size_t camera = 0; camera < 3; ++camera)
  {
    collector.add(camera, viewAt(9.9), 0);
  }
  collector.takeLate(0.15);
  EXPECT_EQ(sizes(collector.add(0, viewAt(10.1), 0.2)), Sizes{});
  EXPECT_EQ(sizes(collector.add(1, viewAt(10.0), 0.21)), Sizes{});
  EXPECT_EQ(sizes(collector.add(1, viewAt(10.1), 0.22)), Sizes{});
  const auto done = collector.add(2, viewAt(10.1), 0.23);
  ASSERT_EQ(sizes(done), (Sizes{1, 3}));
  EXPECT_EQ(done[0].stamp, ros::Time(10.0));
}

TEST_F(TwoCameras, whatComesTooLateIsLeftOutAndKnown)
{
  collector_.add(0, viewAt(10), 0.2);
  EXPECT_EQ(sizes(collector_.takeLate(0.31)), Sizes{1});
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10), 0.32)), Sizes{});
  EXPECT_TRUE(collector_.isTooLate(1));
  EXPECT_FALSE(collector_.isTooLate(0));
  EXPECT_EQ(sizes(collector_.takeLate(0.6)), Sizes{});
  collector_.add(0, viewAt(10.3), 0.6);
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10.3), 0.61)), Sizes{2});
  EXPECT_FALSE(collector_.isTooLate(1));
}

TEST_F(TwoCameras, aTimeThatTheOtherHasPassedIsNotWaitedFor)
{
  collector_.add(0, viewAt(10), 0.2);
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10.05), 0.21)), Sizes{1});  // it has no view of 10
  EXPECT_EQ(sizes(collector_.add(0, viewAt(10.05), 0.25)), Sizes{2});
}

TEST_F(TwoCameras, whatIsRepeatedIsLeftOut)
{
  collector_.add(0, viewAt(10), 0.2);
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10), 0.21)), Sizes{2});
  EXPECT_EQ(sizes(collector_.add(0, viewAt(10), 0.22)), Sizes{});
  EXPECT_EQ(sizes(collector_.add(0, viewAt(9.999), 0.23)), Sizes{});
  EXPECT_EQ(sizes(collector_.takeLate(0.5)), Sizes{});
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10.3), 0.5)), Sizes{});
  EXPECT_EQ(sizes(collector_.add(0, viewAt(10.3), 0.51)), Sizes{2});
}

TEST_F(TwoCameras, aBagThatBeginsAnewBeginsAnewThoughTheOthersLastViewsComeStill)
{
  collector_.add(0, viewAt(10), 0.2);
  EXPECT_EQ(sizes(collector_.add(0, viewAt(2), 0.25)), Sizes{1});  // what was open
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10), 0.26)), Sizes{});  // of the old round
  EXPECT_FALSE(collector_.isTooLate(0));
  EXPECT_EQ(sizes(collector_.add(1, viewAt(2), 0.27)), Sizes{2});
  EXPECT_EQ(sizes(collector_.takeLate(0.6)), Sizes{});
  EXPECT_EQ(sizes(collector_.add(0, viewAt(2.1), 0.6)), Sizes{});
  EXPECT_EQ(sizes(collector_.add(1, viewAt(2.1), 0.61)), Sizes{2});
}

TEST_F(TwoCameras, aClockThatIsSetBackOnOneComputerDoesNotSilenceTheOther)
{
  for (int i = 1; i < 40; ++i)
  {
    collector_.add(0, viewAt(10 + 0.1 * i - (i > 5 ? 3 : 0)), 0.1 * i);
    collector_.add(1, viewAt(10 + 0.1 * i), 0.1 * i + 0.01);
    collector_.takeLate(0.1 * i + 0.05);
  }
  EXPECT_FALSE(collector_.isTooLate(1));
}

TEST_F(TwoCameras, oneStampFarAheadDoesHarmForASecond)
{
  EXPECT_EQ(sizes(collector_.add(0, viewAt(4e9), 0.2)), Sizes{});
  EXPECT_EQ(sizes(collector_.takeLate(0.31)), Sizes{1});
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10.2), 0.35)), Sizes{});
  EXPECT_TRUE(collector_.isTooLate(1));
  collector_.add(1, viewAt(11.2), 1.4);
  EXPECT_FALSE(collector_.isTooLate(1));
}

TEST_F(TwoCameras, viewsWithoutATimeAreFused)
{
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(sizes(collector_.add(0, viewAt(0), 20 + i)), i == 0 ? Sizes{1} : Sizes{});
    collector_.takeLate(20.05 + i);
    if (i > 0)
    {
      EXPECT_EQ(sizes(collector_.add(1, viewAt(0), 20.06 + i)), Sizes{2});
    }
    else
    {
      collector_.add(1, viewAt(0), 20.06);
      collector_.takeLate(20.5);
    }
  }
}

TEST_F(TwoCameras, twoViewsOfOneCameraAreNeverJoined)
{
  // 100 Hz: two frames lie within the tolerance, and each joins the nearest.
  collector_.add(0, viewAt(10), 0.2);
  collector_.add(0, viewAt(10.01), 0.21);
  const auto first = collector_.add(1, viewAt(10), 0.212);
  ASSERT_EQ(sizes(first), Sizes{2});
  EXPECT_EQ(first[0].views[1].header.stamp, first[0].views[0].header.stamp);
  EXPECT_EQ(sizes(collector_.add(1, viewAt(10.01), 0.222)), Sizes{2});
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
