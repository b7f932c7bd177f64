#include <gtest/gtest.h>

#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "outdoor_omr/settings.h"
#include "parameters.h"

using outdoor_omr::OmrConfig;
using outdoor_omr::Parameter;
using outdoor_omr::Settings;

namespace
{
/** A value other than the default, as text; every tunable has one. */
std::string otherValue(const Parameter& parameter)
{
  const std::string value = outdoor_omr::getParameter(Settings(), parameter.name);
  if (parameter.type == "bool")
  {
    return value == "true" ? "false" : "true";
  }
  if (parameter.type == "choice")
  {
    return parameter.choices.front() == value ? parameter.choices.back() : parameter.choices.front();
  }
  std::ostringstream bound;
  bound << std::setprecision(10) << (std::stod(value) == parameter.max ? parameter.min : parameter.max);
  return bound.str();
}

/** What dynamic_reconfigure does with a request for one slider. */
OmrConfig move(const std::string& name, const std::string& value)
{
  dynamic_reconfigure::Config request;
  for (const Parameter& parameter : outdoor_omr::parameters())
  {
    if (parameter.name != name)
    {
      continue;
    }
    if (parameter.type == "bool")
    {
      dynamic_reconfigure::ConfigTools::appendParameter(request, name, value == "true");
    }
    else if (parameter.type == "int")
    {
      dynamic_reconfigure::ConfigTools::appendParameter(request, name, std::stoi(value));
    }
    else if (parameter.type == "double")
    {
      dynamic_reconfigure::ConfigTools::appendParameter(request, name, std::stod(value));
    }
    else
    {
      dynamic_reconfigure::ConfigTools::appendParameter(request, name, value);
    }
  }
  OmrConfig config = OmrConfig::__getDefault__();
  config.__fromMessage__(request);
  return config;
}

std::string bounds(const Parameter& parameter)
{
  std::ostringstream text;
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
  for (const Parameter& parameter : outdoor_omr::parameters())
  {
    yaml << "\n# " << parameter.description << "\n"
         << parameter.name << ": " << outdoor_omr::getParameter(Settings(), parameter.name) << "  # "
         << bounds(parameter) << "\n";
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
  const Settings settings = outdoor_omr::toSettings(OmrConfig::__getDefault__());
  for (const Parameter& parameter : outdoor_omr::parameters())
  {
    EXPECT_EQ(outdoor_omr::getParameter(Settings(), parameter.name),
              outdoor_omr::getParameter(settings, parameter.name))
        << parameter.name;
  }
}

TEST(Parameters, everySliderMovesItsTunableAndNoOther)
{
  for (const Parameter& moved : outdoor_omr::parameters())
  {
    Settings expected;
    outdoor_omr::setParameter(expected, moved.name, otherValue(moved));
    const Settings settings = outdoor_omr::toSettings(move(moved.name, otherValue(moved)));
    for (const Parameter& parameter : outdoor_omr::parameters())
    {
      EXPECT_EQ(outdoor_omr::getParameter(expected, parameter.name),
                outdoor_omr::getParameter(settings, parameter.name))
          << parameter.name << " after moving " << moved.name;
    }
  }
}

TEST(Parameters, slidersHaveTheBoundsGroupsAndWordsOfTheList)
{
  const auto& descriptions = OmrConfig::__getParamDescriptions__();
  ASSERT_EQ(outdoor_omr::parameters().size(), descriptions.size());
  OmrConfig high = OmrConfig::__getMax__();
  OmrConfig low = OmrConfig::__getMin__();
  dynamic_reconfigure::Config high_values;
  dynamic_reconfigure::Config low_values;
  high.__toMessage__(high_values);
  low.__toMessage__(low_values);
  for (const Parameter& parameter : outdoor_omr::parameters())
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
    int integer = 0;
    double number = 0;
    if (dynamic_reconfigure::ConfigTools::getParameter(high_values, parameter.name, integer))
    {
      EXPECT_EQ(parameter.max, integer) << parameter.name;
      dynamic_reconfigure::ConfigTools::getParameter(low_values, parameter.name, integer);
      EXPECT_EQ(parameter.min, integer) << parameter.name;
    }
    if (dynamic_reconfigure::ConfigTools::getParameter(high_values, parameter.name, number))
    {
      EXPECT_EQ(parameter.max, number) << parameter.name;
      dynamic_reconfigure::ConfigTools::getParameter(low_values, parameter.name, number);
      EXPECT_EQ(parameter.min, number) << parameter.name;
    }
  }
}

TEST(Parameters, refusesAWordThatIsNoChoice)
{
  EXPECT_THROW(outdoor_omr::toSettings(move("filter", "gauss")), std::invalid_argument);
}

TEST(Parameters, yamlFileHoldsTheDefaults)
{
  const std::string made = testing::TempDir() + "detector.yaml";
  std::ofstream(made) << defaultYaml();
  EXPECT_EQ(defaultYaml(), contentOf(OUTDOOR_OMR_CONFIG "/detector.yaml"))
      << "settings.def has changed: copy " << made << " to config/detector.yaml";
  Settings settings;
  EXPECT_NO_THROW(outdoor_omr::loadSettings(settings, OUTDOOR_OMR_CONFIG "/detector.yaml"));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
