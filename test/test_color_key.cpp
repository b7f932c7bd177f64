#include "targets/letters/color_key.h"

#include <gtest/gtest.h>

using omr::LinearColor;

namespace
{
/** As if the rings had been measured in these ways. */
std::vector<omr::ColorMeasurement> ways(const std::vector<std::vector<LinearColor>>& measured)
{
  std::vector<omr::ColorMeasurement> result;
  for (const std::vector<LinearColor>& rings : measured)
  {
    result.emplace_back([rings] { return rings; });
  }
  return result;
}

/** Letters of rings that do not lie close to circles. */
std::string readColorKey(const std::vector<omr::ColorMeasurement>& measurements, const std::vector<bool>& seen,
                         bool is_sharp)
{
  return omr::readColorKey(measurements, seen, is_sharp, false).letters;
}

/** All rings are seen, measured in one way, and sharp. */
omr::KeyReading readRings(std::vector<LinearColor> rings, const LinearColor& around)
{
  const std::vector<bool> seen(rings.size(), true);
  rings.push_back(around);
  return omr::readColorKey(ways({rings}), seen, true, false);
}

std::string readColorKey(const std::vector<LinearColor>& rings, const LinearColor& around)
{
  return readRings(rings, around).letters;
}

const LinearColor WHITE(.8, .8, .8);
const LinearColor BLACK(.055, .055, .055);
const LinearColor RED(.53, .05, .05);
const LinearColor GREEN(.04, .26, .08);
const LinearColor BLUE(.05, .07, .3);

std::vector<LinearColor> under(const LinearColor& light, std::vector<LinearColor> colors)
{
  for (LinearColor& color : colors)
  {
    color = color.mul(light);
  }
  return colors;
}
}  // namespace

TEST(ColorKey, readsAllLettersOnPaper)
{
  EXPECT_EQ("WPRGB", readColorKey({WHITE, BLACK, RED, GREEN, BLUE}, WHITE));
  EXPECT_EQ("BGRPW", readColorKey({BLUE, GREEN, RED, BLACK, WHITE}, BLACK));
}

TEST(ColorKey, lightAndItsTintDoNotMatter)
{
  for (const LinearColor& light : {LinearColor(1, .7, .5), LinearColor(.1, .1, .12), LinearColor(.03, .03, .03)})
  {
    EXPECT_EQ("RWPGB", readColorKey(under(light, {RED, WHITE, BLACK, GREEN, BLUE}), WHITE.mul(light)));
  }
}

TEST(ColorKey, whiteIsFoundInARingWhenTheSurroundingsAreNotWhite)
{
  const LinearColor yellow_paint(.6, .4, .05);
  EXPECT_EQ("RWPGB", readColorKey({RED, WHITE, BLACK, GREEN, BLUE}, yellow_paint));
  EXPECT_EQ("PWPW", readColorKey({BLACK, WHITE, BLACK, WHITE}, LinearColor(.2, .2, .2)));
}

TEST(ColorKey, saturatedRingsSayTheLevelWhereNothingIsWhite)
{
  EXPECT_EQ("RGBP", readColorKey({RED, GREEN, BLUE, BLACK}, LinearColor(.12, .12, .12)));
}

TEST(ColorKey, hazeLiftsAllRings)
{
  std::vector<LinearColor> rings = {RED, WHITE, BLACK, GREEN, BLUE};
  for (LinearColor& ring : rings)
  {
    ring = .7 * ring + LinearColor::all(.25);
  }
  EXPECT_EQ("RWPGB", readColorKey(rings, .7 * WHITE + LinearColor::all(.25)));
}

TEST(ColorKey, unknownWhereNoLetterFits)
{
  const LinearColor yellow(.7, .6, .04);  // as red as red, brighter than green
  EXPECT_EQ("P?P", readColorKey({BLACK, yellow, BLACK}, WHITE));
}

TEST(ColorKey, nothingFromNothing)
{
  EXPECT_EQ("", readColorKey({}, WHITE));
}

TEST(ColorKey, linearLightInvertsSrgb)
{
  EXPECT_DOUBLE_EQ(0, omr::linearLight(0));
  EXPECT_DOUBLE_EQ(1, omr::linearLight(255));
  EXPECT_NEAR(.2159, omr::linearLight(128), 1e-3);
}

TEST(ColorKey, aShadowOnSomeRingsAloneIsBrightnessNotHue)
{
  EXPECT_EQ("WPWBG", readColorKey({WHITE, BLACK, WHITE, BLUE * .6, GREEN * .5}, WHITE));
  EXPECT_EQ("GWPBG", readColorKey({GREEN * .5, WHITE, BLACK, BLUE, GREEN}, WHITE));
}

TEST(ColorKey, throughAThickHaze)
{
  std::vector<LinearColor> rings = {RED, WHITE, GREEN, BLUE};
  for (LinearColor& ring : rings)
  {
    ring = .25 * ring + LinearColor::all(.6);
  }
  EXPECT_EQ("RWGB", readColorKey(rings, .25 * WHITE + LinearColor::all(.6)));
}

TEST(ColorKey, whatIsAroundMayLieInAShadowThatTheRingsDoNot)
{
  // RBG in a haze, bars of shadow across its sheet, as seen in a path-traced scene.
  EXPECT_EQ("RBG",
            readColorKey({LinearColor(.471, .25, .253), LinearColor(.236, .271, .458), LinearColor(.227, .319, .263)},
                         LinearColor(.499, .527, .543)));
}

TEST(ColorKey, aHazeHasNoTintWhereTheLightIsWarm)
{
  // BRGP in a drawn scene: behind a haze of the white's tint the red ring is as dark as black.
  EXPECT_EQ("BRGP", readColorKey({LinearColor(.232, .236, .262), LinearColor(.308, .231, .23),
                                  LinearColor(.238, .279, .236), LinearColor(.231, .228, .227)},
                                 LinearColor(.354, .331, .314)));
}

TEST(ColorKey, theWayOfMeasuringThatOneKeyExplainsDecides)
{
  // Gloss on half of the rings: what was measured in the brightest directions is white.
  const std::vector<LinearColor> glossy = {WHITE, WHITE, LinearColor(.5, .7, .55), WHITE, WHITE};
  const std::vector<LinearColor> dark = {RED, WHITE, GREEN, BLUE, WHITE};
  const std::vector<bool> seen(4, true);
  EXPECT_EQ("RWGB", readColorKey(ways({glossy, dark}), seen, true));
  EXPECT_EQ("RWGB", readColorKey(ways({dark, glossy}), seen, true));
}

TEST(ColorKey, aLetterThatAnotherWayWouldChangeAtLittleCostIsUnknown)
{
  // RBPRG, the second ring in gloss: W at a cost of 6.93 as it was measured first, B at 6.95 in the darkest directions.
  const std::vector<LinearColor> glossy = {LinearColor(.3, .046, .05),    LinearColor(.383, .426, .573),
                                           LinearColor(.078, .057, .043), LinearColor(.439, .042, .072),
                                           LinearColor(.038, .184, .082), WHITE};
  const std::vector<LinearColor> dark = {LinearColor(.519, .029, .063), LinearColor(.165, .165, .4),
                                         LinearColor(.052, .042, .059), LinearColor(.667, .048, .054),
                                         LinearColor(.034, .36, .072),  WHITE};
  const std::vector<bool> seen(5, true);
  EXPECT_EQ("R?PRG", readColorKey(ways({glossy, dark}), seen, true));
  EXPECT_EQ("RWPRG", readColorKey(ways({glossy}), seen, true));
  EXPECT_EQ("RBPRG", readColorKey(ways({dark}), seen, true));
}

TEST(ColorKey, noFurtherWayIsMeasuredWhereAKeyExplainsTheFirst)
{
  std::vector<omr::ColorMeasurement> measurements = ways({{RED, WHITE, GREEN, BLUE, WHITE}});
  measurements.emplace_back([] {
    ADD_FAILURE();
    return std::vector<LinearColor>(5, WHITE);
  });
  EXPECT_EQ("RWGB", readColorKey(measurements, std::vector<bool>(4, true), true));
}

TEST(ColorKey, aHiddenRingIsUnknownAndTellsNothing)
{
  const LinearColor skin(.6, .35, .2);
  EXPECT_EQ("??GB", readColorKey(ways({{skin, skin, GREEN, BLUE, WHITE}}), {false, false, true, true}, true));
  EXPECT_EQ("???P", readColorKey(ways({{skin, skin, skin, BLACK * 2., WHITE}}), {false, false, false, true}, true));
  EXPECT_EQ("??", readColorKey(ways({{skin, skin, WHITE}}), {false, false}, true));
}

TEST(ColorKey, glossOnOneRingOfSharpOnes)
{
  // As a flash does: the disk is pale, the others are not. Where the blur may be why, nothing is known.
  const auto glossy = ways({{RED + LinearColor::all(.25), WHITE, GREEN, BLUE, BLACK, WHITE}});
  const std::vector<bool> seen(5, true);
  EXPECT_EQ("RWGBP", readColorKey(glossy, seen, true));
  EXPECT_EQ("?WGBP", readColorKey(glossy, seen, false));
}

TEST(ColorKey, greyIsNoGreen)
{
  // A black disk below gloss.
  const std::vector<LinearColor> rings = {LinearColor(.174, .193, .195), LinearColor(.452, .155, .155),
                                          LinearColor(.104, .257, .152), LinearColor(.095, .111, .29),
                                          LinearColor(.398, .076, .087)};
  EXPECT_EQ("?RGBR", readColorKey(rings, LinearColor(.671, .625, .658)));
}

TEST(ColorKey, clearLettersMayExplainCloseRingsWorse)
{
  // WRB below the shadows of bars, as seen in a path-traced scene.
  const std::vector<LinearColor> rings = {LinearColor(.098, .123, .124), LinearColor(.09, .022, .018),
                                          LinearColor(.034, .047, .134), LinearColor(.259, .286, .219)};
  const auto read = [&](bool is_close) {
    return omr::readColorKey(ways({rings}), std::vector<bool>(3, true), false, is_close);
  };
  EXPECT_EQ("???", read(false).letters);
  EXPECT_EQ("WRB", read(true).letters);
}

TEST(ColorKey, aMixtureOfTwoRingsIsNotCertain)
{
  EXPECT_TRUE(readRings({RED, WHITE, GREEN}, WHITE).is_certain);
  EXPECT_FALSE(readRings({RED, .6 * BLUE + .4 * BLACK, GREEN}, WHITE).is_certain);
  EXPECT_FALSE(readRings({RED, .5 * RED + .5 * GREEN, BLUE}, WHITE).is_certain);
}

TEST(ColorKey, nothingIsCertainBehindHaze)
{
  const auto behind = [](double haze) {
    std::vector<LinearColor> rings = {RED, WHITE, GREEN, BLUE};
    for (LinearColor& ring : rings)
    {
      ring = (1 - haze) * ring + LinearColor::all(.8 * haze);
    }
    return readRings(rings, WHITE);
  };
  EXPECT_TRUE(behind(.1).is_certain);
  EXPECT_EQ("RWGB", behind(.3).letters);
  EXPECT_FALSE(behind(.3).is_certain);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
