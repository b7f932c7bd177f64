// Candidates and the region to zoom into, as the running detector publishes them.

#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <outdoor_omr/CandidateArray.h>
#include <outdoor_omr/CheckerboardArray.h>
#include <sensor_msgs/RegionOfInterest.h>

#include <map>

#include "ros_test.h"
#include "sliders.h"

using outdoor_omr::Candidate;
using ros_test::Listener;
using ros_test::waitFor;

namespace
{
class CandidatesTopicTest : public testing::Test
{
 protected:
  void SetUp() override
  {
    ASSERT_TRUE(waitFor([this] {
      return camera_.getNumSubscribers() > 0 && checkerboards_.connected() && candidates_.connected() &&
             regions_.connected();
    }));
  }

  void TearDown() override
  {
    set({{"candidate_mode", "none"}, {"detect_checkerboards", "true"}, {"detect_targets", "true"}});
  }

  static void set(const std::map<std::string, std::string>& values)
  {
    for (const auto& [name, value] : values)
    {
      dynamic_reconfigure::Reconfigure call;
      call.request.config = ros_test::requestFor(name, value);
      ASSERT_TRUE(ros::service::call("/detector/set_parameters", call));
    }
  }

  /** Shows the detector a picture with markers. */
  void show(const ros::Time& stamp)
  {
    const std::size_t shots = checkerboards_.count() + 1;
    camera_.publish(ros_test::toMessage(ros_test::markerScene(), stamp));
    ASSERT_TRUE(waitFor([&] { return checkerboards_.count() == shots; }));
  }

  ros::NodeHandle nh_;
  ros::Publisher camera_ = nh_.advertise<sensor_msgs::Image>("image", 1);
  Listener<outdoor_omr::CheckerboardArray> checkerboards_{"/detector/checkerboards"};
  Listener<outdoor_omr::CandidateArray> candidates_{"/detector/candidates"};
  Listener<sensor_msgs::RegionOfInterest> regions_{"/detector/region_of_interest"};
};
}  // namespace

TEST_F(CandidatesTopicTest, whatIsReadNeedsNoZoom)
{
  set({{"candidate_mode", "all"}});
  show(ros::Time(100, 5));
  ASSERT_TRUE(waitFor([this] { return candidates_.count() == 1 && regions_.count() == 1; }));
  const auto message = candidates_.messages().front();
  EXPECT_EQ(ros::Time(100, 5), message->header.stamp);
  EXPECT_EQ("camera", message->header.frame_id);
  EXPECT_EQ(640U, message->width);
  EXPECT_EQ(480U, message->height);
  bool board = false;
  for (const Candidate& candidate : message->candidates)
  {
    board = board || candidate.kind == Candidate::CHECKERBOARD;
    EXPECT_TRUE(candidate.read) << candidate;
  }
  EXPECT_TRUE(board);
  EXPECT_EQ(0U, regions_.messages().front()->width);
  EXPECT_EQ(0U, regions_.messages().front()->height);
}

TEST_F(CandidatesTopicTest, theRegionOfInterestCoversWhatIsNotRead)
{
  set({{"candidate_mode", "all"}, {"detect_checkerboards", "false"}, {"detect_targets", "false"}});
  show(ros::Time(200));
  ASSERT_TRUE(waitFor([this] { return candidates_.count() == 1 && regions_.count() == 1; }));
  const auto region = regions_.messages().front();
  const cv::Rect zoom(region->x_offset, region->y_offset, region->width, region->height);
  const auto message = candidates_.messages().front();
  EXPECT_FALSE(message->candidates.empty());
  for (const Candidate& candidate : message->candidates)
  {
    const cv::Rect box(candidate.box.x_offset, candidate.box.y_offset, candidate.box.width, candidate.box.height);
    EXPECT_FALSE(candidate.read);
    EXPECT_EQ(box, box & zoom) << candidate;
    EXPECT_GT(candidate.score, -1);
    EXPECT_LE(candidate.score, 1);
  }
  EXPECT_EQ(zoom, zoom & cv::Rect(0, 0, 640, 480));
}

TEST_F(CandidatesTopicTest, noneAndEnlargePublishNone)
{
  show(ros::Time(300));
  set({{"candidate_mode", "enlarge"}});
  show(ros::Time(301));
  set({{"candidate_mode", "all"}});
  show(ros::Time(302));
  ASSERT_TRUE(waitFor([this] { return candidates_.count() > 0; }));
  EXPECT_EQ(ros::Time(302), candidates_.messages().front()->header.stamp);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_candidates_topic");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
