#include <gtest/gtest.h>

#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "outdoor_omr/settings.h"
#include "own_folder.h"
#include "parameters.h"
#include "sliders.h"

using omr::Parameter;
using omr::Settings;
using outdoor_omr::OmrConfig;

namespace
{
/** What dynamic_reconfigure does with a request for one slider. */
OmrConfig move(const std::string& name, const std::string& value)
{
  dynamic_reconfigure::Config request = ros_test::requestFor(name, value);
  OmrConfig config = OmrConfig::__getDefault__();
  config.__fromMessage__(request);
  return config;
}

std::string bounds(const Parameter& parameter)
{
  std::ostringstream text;
  text << std::setprecision(10);
  if (parameter.type == "choice")
  {
    for (const std::string& choice : parameter.choices)
    {
      text << (choice == parameter.choices.front() ? "" : ", ") << choice;
    }
  }
  else if (parameter.type == "bool")
  {
    text << "true or false";
  }
  else
  {
    text << parameter.min << " to " << parameter.max << " " << parameter.unit;
  }
  return text.str();
}

/** What config/detector.yaml has to say. */
std::string defaultYaml()
{
  std::ostringstream yaml;
  yaml << "# Parameters of the detector with their defaults. Copy this file, keep what you change, and name the copy "
          "in\n"
          "# detect.launch (config:=FILE) or omr_detect (--config FILE).\n";
  for (const Parameter& parameter : omr::parameters())
  {
    yaml << "\n# " << parameter.description << "\n"
         << parameter.name << ": " << omr::getParameter(Settings(), parameter.name) << "  # " << bounds(parameter)
         << "\n";
  }
  return yaml.str();
}

std::string contentOf(const std::string& file)
{
  std::ifstream stream(file);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}
}  // namespace

TEST(Parameters, defaultsAreThoseOfTheSettings)
{
  const Settings settings = omr::toSettings(OmrConfig::__getDefault__());
  for (const Parameter& parameter : omr::parameters())
  {
    EXPECT_EQ(omr::getParameter(Settings(), parameter.name), omr::getParameter(settings, parameter.name))
        << parameter.name;
  }
}

TEST(Parameters, everySliderMovesItsTunableAndNoOther)
{
  for (const Parameter& moved : omr::parameters())
  {
    Settings expected;
    omr::setParameter(expected, moved.name, ros_test::otherValue(moved));
    const Settings settings = omr::toSettings(move(moved.name, ros_test::otherValue(moved)));
    for (const Parameter& parameter : omr::parameters())
    {
      EXPECT_EQ(omr::getParameter(expected, parameter.name), omr::getParameter(settings, parameter.name))
          << parameter.name << " after moving " << moved.name;
    }
  }
}

TEST(Parameters, slidersHaveTheBoundsGroupsAndWordsOfTheList)
{
  const auto& descriptions = OmrConfig::__getParamDescriptions__();
  ASSERT_EQ(omr::parameters().size(), descriptions.size());
  dynamic_reconfigure::Config high;
  dynamic_reconfigure::Config low;
  OmrConfig::__getMax__().__toMessage__(high);
  OmrConfig::__getMin__().__toMessage__(low);
  for (const Parameter& parameter : omr::parameters())
  {
    const auto slider = std::find_if(descriptions.begin(), descriptions.end(),
                                     [&](const auto& description) { return description->name == parameter.name; });
    ASSERT_NE(descriptions.end(), slider) << parameter.name;
    EXPECT_NE(std::string::npos, (*slider)->description.find(parameter.description)) << parameter.name;
    EXPECT_NE(std::string::npos, (*slider)->description.find(parameter.unit)) << parameter.name;
    for (const std::string& choice : parameter.choices)
    {
      EXPECT_NE(std::string::npos, (*slider)->edit_method.find("'" + choice + "'")) << parameter.name;
    }
    if (parameter.type == "int" || parameter.type == "double")
    {
      EXPECT_EQ(parameter.max, std::stod(ros_test::valueIn(high, parameter.name))) << parameter.name;
      EXPECT_EQ(parameter.min, std::stod(ros_test::valueIn(low, parameter.name))) << parameter.name;
    }
  }
}

TEST(Parameters, refusesAWordThatIsNoChoice)
{
  EXPECT_THROW(omr::toSettings(move("filter", "gauss")), std::invalid_argument);
}

TEST(Parameters, yamlFileHoldsTheDefaults)
{
  const std::string made = OUTDOOR_OMR_BUILD "/detector.yaml";  // stays, to be copied
  omr::test::writeTo(made, defaultYaml());
  EXPECT_EQ(defaultYaml(), contentOf(OUTDOOR_OMR_CONFIG "/detector.yaml"))
      << "settings.def has changed: copy " << made << " to config/detector.yaml";
  Settings settings;
  EXPECT_NO_THROW(omr::loadSettings(settings, OUTDOOR_OMR_CONFIG "/detector.yaml"));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
