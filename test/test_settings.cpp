#include <gtest/gtest.h>

#include <stdexcept>

#include "messages_of.h"
#include "outdoor_omr/settings.h"
#include "own_folder.h"

using omr::Filter;
using omr::Settings;
using omr::test::messageOf;
using omr::test::writeFile;

TEST(Settings, defaultsAreInBounds)
{
  EXPECT_NO_THROW(Settings().check());
}

TEST(Settings, everyParameterReadsBackWhatWasSet)
{
  const Settings defaults;
  for (const omr::Parameter& parameter : omr::parameters())
  {
    Settings settings;
    const std::string value = omr::getParameter(defaults, parameter.name);
    omr::setParameter(settings, parameter.name, value);
    EXPECT_EQ(value, omr::getParameter(settings, parameter.name)) << parameter.name;
    EXPECT_FALSE(parameter.description.empty()) << parameter.name;
  }
}

TEST(Settings, refusesValuesOutOfBoundsAndKeepsTheOld)
{
  Settings settings;
  EXPECT_THROW(omr::setParameter(settings, "sobel_threshold", "0"), std::invalid_argument);
  EXPECT_THROW(omr::setParameter(settings, "sobel_threshold", "2041"), std::invalid_argument);
  EXPECT_THROW(omr::setParameter(settings, "filter_size", "4"), std::invalid_argument);
  EXPECT_THROW(omr::setParameter(settings, "sobel_threshold", "12x"), std::invalid_argument);
  EXPECT_THROW(omr::setParameter(settings, "region_max_share", "nan"), std::invalid_argument);
  EXPECT_THROW(omr::setParameter(settings, "detect_targets", "1"), std::invalid_argument);
  EXPECT_EQ(Settings().sobel_threshold, settings.sobel_threshold);
  EXPECT_EQ(Settings().filter_size, settings.filter_size);
}

TEST(Settings, saysWhatIsWrongAndWhatIsExpected)
{
  Settings settings;
  EXPECT_EQ("'filter' is one of none, gaussian, median, not 'gauss'",
            messageOf([&] { omr::setParameter(settings, "filter", "gauss"); }));
  EXPECT_EQ("there is no parameter 'sobel_treshold'; the nearest name is 'sobel_threshold'",
            messageOf([&] { omr::setParameter(settings, "sobel_treshold", "3"); }));
  EXPECT_EQ("'sobel_threshold' = 0 is out of bounds: 1 to 2040 grey levels",
            messageOf([&] { omr::setParameter(settings, "sobel_threshold", "0"); }));
}

TEST(Settings, readsYaml)
{
  Settings settings;
  omr::loadSettings(settings,
                    writeFile("settings.yaml", "filter: median\nsobel_threshold: 60\ndetect_targets: false\n"));
  EXPECT_EQ(Filter::median, settings.filter);
  EXPECT_EQ(60, settings.sobel_threshold);
  EXPECT_FALSE(settings.detect_targets);
}

TEST(Settings, yamlErrorsNameFileAndLineAndChangeNothing)
{
  Settings settings;
  const std::string file = writeFile("settings.yaml", "filter: median\n\nsobel_threshold: many\n");
  const std::string message = messageOf([&] { omr::loadSettings(settings, file); });
  EXPECT_EQ(file + ":3: 'sobel_threshold' is a whole number, not 'many'", message);
  EXPECT_EQ(Settings().filter, settings.filter);
  EXPECT_NE("", messageOf([&] { omr::loadSettings(settings, writeFile("settings.yaml", "- 1\n- 2\n")); }));
  EXPECT_NE("", messageOf([&] { omr::loadSettings(settings, writeFile("settings.yaml", "filter: [median\n")); }));
  EXPECT_NE("", messageOf([&] { omr::loadSettings(settings, writeFile("settings.yaml", "filter: [median]\n")); }));
  EXPECT_NE("", messageOf([&] { omr::loadSettings(settings, "/nonexistent.yaml"); }));
  EXPECT_EQ("cannot read the file '/': is it a directory?", messageOf([&] { omr::loadSettings(settings, "/"); }));
  const std::string twice = writeFile("settings.yaml", "sobel_threshold: 60\nfilter: none\nsobel_threshold: 100\n");
  EXPECT_EQ(twice + ":3: the key 'sobel_threshold' stands here twice",
            messageOf([&] { omr::loadSettings(settings, twice); }));
  EXPECT_EQ(Settings().sobel_threshold, settings.sobel_threshold);
  const std::string empty = writeFile("settings.yaml", "sobel_threshold: 60\nfilter:\n");
  EXPECT_EQ(empty + ":2: expected a single value of 'filter'", messageOf([&] { omr::loadSettings(settings, empty); }));
  EXPECT_NO_THROW(omr::loadSettings(settings, writeFile("settings.yaml", "")));
}

TEST(Settings, yamlBehindASecondDocumentsBeginningIsRefused)
{
  Settings settings;
  const std::string two = writeFile("settings.yaml", "filter: median\n---\n\nsobel_threshold: 60\n");
  EXPECT_EQ(two + ":4: a second document, behind '---', would be ignored: expected a file of one; remove the '---'",
            messageOf([&] { omr::loadSettings(settings, two); }));
  EXPECT_EQ(Settings().filter, settings.filter);
  EXPECT_NE("",
            messageOf([&] { omr::loadSettings(settings, writeFile("settings.yaml", "---\n---\nfilter: median\n")); }));
  EXPECT_NE("",
            messageOf([&] { omr::loadSettings(settings, writeFile("settings.yaml", "filter: median\n---\n]\n")); }));
  omr::loadSettings(
      settings, writeFile("settings.yaml", "# of a site\n---\nfilter: median\n---\n"));  // one, begun and ended by ---
  EXPECT_EQ(Filter::median, settings.filter);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
