// Parameters of the running detector: sliders, words, parameters that are set before it starts.

#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <outdoor_omr/CheckerboardArray.h>
#include <outdoor_omr/TargetArray.h>
#include <rosgraph_msgs/Log.h>

#include <map>

#include "nodelet_manager.h"
#include "ros_test.h"
#include "sliders.h"

using omr::Parameter;
using omr::Settings;
using ros_test::Listener;
using ros_test::NodeletManager;
using ros_test::valueIn;
using ros_test::waitFor;
using rosgraph_msgs::Log;

namespace
{
dynamic_reconfigure::Config set(const dynamic_reconfigure::Config& request)
{
  dynamic_reconfigure::Reconfigure call;
  call.request.config = request;
  EXPECT_TRUE(ros::service::call("/detector/set_parameters", call));
  return call.response.config;
}

dynamic_reconfigure::Config set(const std::string& name, const std::string& value)
{
  return set(ros_test::requestFor(name, value));
}

std::string current(const std::string& name)
{
  return valueIn(set(dynamic_reconfigure::Config()), name);
}

std::string defaultOf(const std::string& name)
{
  return omr::getParameter(Settings(), name);
}

/** Whether somebody logged these words at this level. */
bool logged(const Listener<Log>& log, const Log::_level_type& level, const std::string& words)
{
  for (const auto& line : log.messages())
  {
    if (line->level == level && line->msg.find(words) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

/** How one slider is moved, and whether that must change what the detector publishes. */
struct Move
{
  std::string value;
  bool acts;
  std::map<std::string, std::string> before;  ///< sliders that stand elsewhere than at their defaults
};

const std::map<std::string, std::string> PAINTED = {{"overlay_regions", "true"}};

const std::map<std::string, Move> MOVES = {
    {"filter", {"none", true, PAINTED}},
    {"filter_size", {"5", true, PAINTED}},
    {"sobel_threshold", {"300", true, PAINTED}},
    {"edge_threshold", {"adaptive", true, {{"overlay_regions", "true"}, {"sobel_threshold", "2040"}}}},
    {"sobel_floor",
     {"2040", true, {{"overlay_regions", "true"}, {"sobel_threshold", "2040"}, {"edge_threshold", "adaptive"}}}},
    {"fill_method", {"sweep", false, PAINTED}},  // two ways to the same labels
    {"sweep_rounds", {"1", false, {{"overlay_regions", "true"}, {"fill_method", "sweep"}}}},
    {"region_min_area", {"1000000", true, {}}},
    {"region_max_share", {"0.0001", true, {}}},
    {"detect_checkerboards", {"false", true, {}}},
    {"checkerboard_second_look", {"false", true, {}}},
    {"checkerboard_looks", {"0", true, {}}},
    {"detect_targets", {"false", true, {}}},
    {"target_min_rings", {"9", true, {}}},
    {"candidate_mode", {"all", true, {}}},
    {"candidate_looks", {"0", false, {{"candidate_mode", "all"}}}},  // all of its candidates are read already
    {"overlay_regions", {"true", true, {}}},
};

/** Shows the detector one and the same picture and keeps what it publishes. */
class Eye
{
 public:
  bool open()
  {
    return waitFor([&] {
      return camera_.getNumSubscribers() > 0 && checkerboards_.connected() && targets_.connected() &&
             overlay_.connected();
    });
  }

  /** @param values of the sliders that do not stand at their defaults. @return all that was published; empty: nothing.
   */
  std::string look(const std::map<std::string, std::string>& values)
  {
    for (const Parameter& parameter : omr::parameters())
    {
      const auto value = values.find(parameter.name);
      set(parameter.name, value == values.end() ? defaultOf(parameter.name) : value->second);
    }
    const std::size_t shots = overlay_.count() + 1;
    camera_.publish(ros_test::toMessage(ros_test::markerScene(), ros::Time(1000)));
    if (!waitFor(
            [&] { return checkerboards_.count() == shots && targets_.count() == shots && overlay_.count() == shots; }))
    {
      return "";
    }
    std::ostringstream all;
    for (const auto& board : checkerboards_.messages().back()->checkerboards)
    {
      all << board;
    }
    for (const auto& target : targets_.messages().back()->targets)
    {
      all << target;
    }
    const auto& pixels = overlay_.messages().back()->data;
    all.write(reinterpret_cast<const char*>(pixels.data()), static_cast<std::streamsize>(pixels.size()));
    return all.str();
  }

 private:
  const ros::Publisher camera_ = ros::NodeHandle().advertise<sensor_msgs::Image>("image", 1);
  const Listener<outdoor_omr::CheckerboardArray> checkerboards_{"detector/checkerboards"};
  const Listener<outdoor_omr::TargetArray> targets_{"detector/targets"};
  const Listener<sensor_msgs::Image> overlay_{"detector/overlay"};
};

/** A manager with the detector in it, started without parameters of an earlier test. */
class Reconfigure : public testing::Test
{
 protected:
  Reconfigure()
  {
    // Words logged before the manager's connection stands are lost: wait until some have come.
    EXPECT_TRUE(waitFor([&] {
      return NodeletManager::load() && NodeletManager::unload() && logged(log_, Log::INFO, "Detecting markers on");
    }));
    ros::param::del("/detector");
  }

  NodeletManager manager_;
  const Listener<Log> log_{"/rosout"};
};
}  // namespace

TEST_F(Reconfigure, everySliderReadsBackWhatWasSet)
{
  ASSERT_TRUE(NodeletManager::load());
  for (const Parameter& parameter : omr::parameters())
  {
    EXPECT_EQ(defaultOf(parameter.name), current(parameter.name)) << parameter.name;
    const std::string value = ros_test::otherValue(parameter);
    EXPECT_EQ(value, valueIn(set(parameter.name, value), parameter.name)) << parameter.name;
    EXPECT_EQ(value, current(parameter.name)) << parameter.name;
    set(parameter.name, defaultOf(parameter.name));
  }
}

TEST_F(Reconfigure, refusesWhatTheSettingsDoNotAdmit)
{
  ASSERT_TRUE(NodeletManager::load());
  EXPECT_EQ("median", valueIn(set("filter", "median"), "filter"));
  EXPECT_EQ("median", valueIn(set("filter", "gauss"), "filter"));
  EXPECT_EQ("median", current("filter"));
  EXPECT_TRUE(
      waitFor([&] { return logged(log_, Log::ERROR, "'filter' is one of none, gaussian, median, not 'gauss'"); }));
  EXPECT_EQ("3", valueIn(set("filter_size", "4"), "filter_size"));
  EXPECT_TRUE(waitFor([&] { return logged(log_, Log::ERROR, "'filter_size' = 4 has no centre pixel"); }));
}

TEST_F(Reconfigure, usesGoodParametersAtTheStartAndNamesTheBadOnes)
{
  ros::param::set("/detector/sobel_threshold", 60);
  ros::param::set("/detector/sobel_floor", "30");  // as a yaml file has what stands in quotes, or 1e-3
  ros::param::set("/detector/detect_targets", "false");
  ros::param::set("/detector/sobel_treshold", 70);
  ros::param::set("/detector/devise", "gpu");
  ros::param::set("/detector/filter", "gauss");
  ros::param::set("/detector/filter_size", "wide");
  ros::param::set("/detector/region_min_area", 0);
  ros::param::set("/detector/region_max_share", std::vector<double>{0.5, 0.6});
  ASSERT_TRUE(NodeletManager::load());
  EXPECT_EQ("60", current("sobel_threshold"));
  EXPECT_EQ("30", current("sobel_floor"));
  EXPECT_EQ("false", current("detect_targets"));
  for (const std::string name : {"filter", "filter_size", "region_min_area", "region_max_share"})
  {
    EXPECT_EQ(defaultOf(name), current(name)) << name;
  }
  for (const std::string words : {"'/detector/sobel_treshold'; the nearest name is 'sobel_threshold'",
                                  "'/detector/devise'; the nearest name is 'device'",
                                  "'filter' is one of none, gaussian, median, not 'gauss'; the default gaussian stays",
                                  "'filter_size' is a whole number, not 'wide'; the default 3 stays",
                                  "'region_min_area' = 0 is out of bounds: 1 to 1000000 px; the default 4 stays",
                                  "/detector/region_max_share: it is not a single value; the default 0.125 stays"})
  {
    EXPECT_TRUE(waitFor([&] { return logged(log_, Log::WARN, words); }, 5)) << words;
  }
  EXPECT_FALSE(logged(log_, Log::WARN, "'sobel_threshold' "));
}

TEST_F(Reconfigure, saysWhyItCannotStartAndLeavesTheManagerAlive)
{
  ros::param::set("/detector/device", "no such device");
  EXPECT_FALSE(NodeletManager::load());
  EXPECT_TRUE(waitFor([&] { return logged(log_, Log::FATAL, "no such device"); }, 5));
  ros::param::del("/detector/device");
  EXPECT_TRUE(NodeletManager::load());
}

TEST_F(Reconfigure, everySliderActsOnTheNextImage)
{
  ASSERT_TRUE(NodeletManager::load());
  Eye eye;
  ASSERT_TRUE(eye.open());
  for (const Parameter& parameter : omr::parameters())
  {
    const auto move = MOVES.find(parameter.name);
    ASSERT_NE(MOVES.end(), move) << "no test moves the slider " << parameter.name;
    std::map<std::string, std::string> values = move->second.before;
    const std::string before = eye.look(values);
    values[parameter.name] = move->second.value;
    ASSERT_NE("", before);
    EXPECT_EQ(move->second.acts, before != eye.look(values)) << parameter.name;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_reconfigure");
  ros::NodeHandle nh;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
