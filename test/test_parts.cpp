#include <gtest/gtest.h>

#include <cmath>

#include "messages_of.h"
#include "outdoor_omr/parts.h"
#include "own_folder.h"

using omr::innerCorners;
using omr::Part;
using omr::PartCheckerboard;
using omr::readParts;
using omr::test::messageOf;
using omr::test::writeFile;

namespace
{
const std::string BOARD = "{rows: 7, cols: 10, square: 0.02}";

/** A file of one part with these checkerboards and targets, in flow style. */
std::string partWith(const std::string& checkerboards, const std::string& targets = "[]")
{
  return "parts:\n- name: plate\n  checkerboards: " + checkerboards + "\n  targets: " + targets + "\n";
}

std::vector<Part> parse(const std::string& text)
{
  return readParts(writeFile("parts.yaml", text));
}

/** What the file's mistake is answered with, behind the name of the file. */
std::string complaint(const std::string& text)
{
  const std::string file = writeFile("parts.yaml", text);
  const std::string message = messageOf<std::invalid_argument>([&] { readParts(file); });
  EXPECT_EQ(message.compare(0, file.size(), file), 0) << "no file in '" << message << "'";
  return message.substr(std::min(message.size(), file.size()));
}

TEST(Parts, workedExample)
{
  const std::vector<Part> parts = readParts(OUTDOOR_OMR_CONFIG "/parts.yaml");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "plate");
  ASSERT_EQ(parts[0].checkerboards.size(), 1U);
  EXPECT_EQ(parts[0].checkerboards[0].rows, 7);
  EXPECT_EQ(parts[0].checkerboards[0].cols, 9);
  EXPECT_EQ(parts[0].checkerboards[0].curvature, 0);
  ASSERT_EQ(parts[0].targets.size(), 2U);
  EXPECT_EQ(parts[0].targets[1].colors, "GRGPB");
  EXPECT_EQ(parts[0].targets[1].center, cv::Point3d(0.3, 0, 0));
  EXPECT_DOUBLE_EQ(parts[1].checkerboards[0].curvature, 1 / 0.08415);
  EXPECT_TRUE(parts[1].checkerboards[0].axis_along_x);
  // All corners of the board lie on the pipe, whose axis is the part's x.
  for (const cv::Point3d& corner : innerCorners(parts[1].checkerboards[0]))
  {
    EXPECT_NEAR(std::hypot(corner.y, corner.z), 0.08415, 1e-12);
  }
}

TEST(Parts, poseTurnsAboutFixedAxesInTheirOrder)
{
  const Part part =
      parse(partWith("[{rows: 7, cols: 10, square: 0.02, "
                     "pose: {xyz: [1, 2, 3], rpy_degrees: [90, 0, 90]}}]"))[0];
  // Roll carries z to -y, yaw -y to x.
  const cv::Vec3d normal = part.checkerboards[0].pose.rotation() * cv::Vec3d(0, 0, 1);
  EXPECT_LT(cv::norm(normal - cv::Vec3d(1, 0, 0)), 1e-12);
  EXPECT_EQ(part.checkerboards[0].pose.translation(), cv::Vec3d(1, 2, 3));
}

TEST(Parts, poseTakesAQuaternion)
{
  // Half a turn about x + y swaps the two.
  const Part part =
      parse(partWith("[{rows: 7, cols: 10, square: 0.02, "
                     "pose: {xyz: [0, 0, 0], quaternion: [0.7071, 0.7071, 0, 0]}}]"))[0];
  const cv::Vec3d turned = part.checkerboards[0].pose.rotation() * cv::Vec3d(1, 0, 0);
  EXPECT_LT(cv::norm(turned - cv::Vec3d(0, 1, 0)), 1e-4);
}

TEST(Parts, targetMayEndInWhiteOnDarkGround)
{
  EXPECT_EQ(parse(partWith("[" + BOARD + "]", "[{colors: RBW, ring: 0.01, xyz: [1, 0, 0]}]"))[0].targets[0].colors,
            "RBW");
}

TEST(Parts, markersMayLieTensOfMetresApartWhereOneIsLarge)
{
  const std::string target = "[{colors: RGB, ring: 0.01, xyz: [27, 0, 0]}]";
  EXPECT_EQ(parse(partWith("[" + BOARD + "]", target))[0].targets.size(), 1U);
  const std::string small = "{rows: 5, cols: 7, square: 0.01}";
  EXPECT_NE(complaint(partWith("[" + small + "]", target)), "");
  // Of a target as well as of a board.
  const std::string large = "[{colors: RGB, ring: 0.03, xyz: [27, 0, 0]}]";
  EXPECT_EQ(parse(partWith("[" + small + "]", large))[0].targets.size(), 1U);
}

TEST(Parts, millimetresAreFoundHoweverTheMarkersLie)
{
  // The least that markers beside each other are apart: half a short side and half a target, here of 15 and 2 mm.
  EXPECT_NE(complaint(partWith("[{rows: 5, cols: 21, square: 0.003}]", "[{colors: RG, ring: 0.0005, xyz: [0, 9, 0]}]")),
            "");
}

TEST(Parts, copies)
{
  EXPECT_EQ(parse(partWith("[" + BOARD + "]"))[0].copies, 1);
  EXPECT_EQ(parse("parts:\n- {name: plate, copies: 3, checkerboards: [" + BOARD + "]}")[0].copies, 3);
}

TEST(Parts, innerCornersAreOrderedRowByRowAboutTheMiddle)
{
  const std::vector<cv::Point3d> corners = innerCorners(parse(partWith("[" + BOARD + "]"))[0].checkerboards[0]);
  ASSERT_EQ(corners.size(), 6U * 9);
  EXPECT_LT(cv::norm(corners[0] - cv::Point3d(-0.08, -0.05, 0)), 1e-12);
  EXPECT_LT(cv::norm(corners[1] - cv::Point3d(-0.06, -0.05, 0)), 1e-12);
  EXPECT_LT(cv::norm(corners.back() - cv::Point3d(0.08, 0.05, 0)), 1e-12);
}

TEST(Parts, cylinder)
{
  for (const std::string side : {"outside", "inside"})
  {
    for (const std::string axis : {"x", "y"})
    {
      const PartCheckerboard board = parse(partWith(
          "[{rows: 7, cols: 10, square: 0.02, surface: {cylinder: 0.1, axis: " + axis + ", side: " + side + "}}]"))[0]
                                         .checkerboards[0];
      const double center = side == "outside" ? 0.1 : -0.1;  // the axis lies behind the surface, or before it
      const std::vector<cv::Point3d> corners = innerCorners(board);
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        const double across = axis == "x" ? corners[i].y : corners[i].x;
        EXPECT_NEAR(std::hypot(across, corners[i].z - center), 0.1, 1e-12);
      }
      // Neighbours around the axis are a square apart along the surface, so a chord apart in space.
      const double chord = 2 * 0.1 * std::sin(0.02 / 0.1 / 2);
      const cv::Point3d neighbour = axis == "x" ? corners[9] : corners[1];
      EXPECT_NEAR(cv::norm(neighbour - corners[0]), chord, 1e-12);
    }
  }
  const PartCheckerboard usual =
      parse(partWith("[{rows: 7, cols: 10, square: 0.02, surface: {cylinder: 0.1}}]"))[0].checkerboards[0];
  EXPECT_FALSE(usual.axis_along_x);
  EXPECT_GT(usual.curvature, 0);
}

TEST(Parts, fileThatCannotBeRead)
{
  EXPECT_EQ(messageOf<std::runtime_error>([] { readParts("/nonexistent/parts.yaml"); }),
            "cannot read the file '/nonexistent/parts.yaml'");
  EXPECT_EQ(messageOf<std::runtime_error>([] { readParts("/"); }), "cannot read the file '/': is it a directory?");
}

struct Mistake
{
  std::string text;
  std::string answer;
};

TEST(Parts, mistakesAreNamed)
{
  const std::vector<Mistake> mistakes = {
      {"", ":1: expected a map with the key 'parts'"},
      {"parts: [", ":1: not valid yaml"},
      {"- 1", ":1: expected a map with the key 'parts'"},
      {"part: []", ":1: there is no key 'part': expected parts"},
      {"parts:", ":1: the key 'parts' has no value: expected a list of one part or more"},
      {"{}", ":1: the key 'parts' is missing: expected a list of one part or more"},
      {"parts: {}", ":1: parts: expected a list of one part or more"},
      {"parts: []", ":1: parts: expected a list of one part or more"},
      {"parts:\n- plate", ":2: parts[0]: expected a map with 'name', 'checkerboards' and 'targets'"},
      {"parts:\n- checkerboards: []", ":2: parts[0]: the key 'name' is missing: expected a name"},
      {"parts:\n- name: a plate\n  checkerboards: [" + BOARD + "]", ":2: parts[0].name: expected a name of letters"},
      {"parts:\n- name: /plate\n  checkerboards: [" + BOARD + "]", ":2: parts[0].name: expected a name of letters"},
      {"parts:\n- name: plate", ":2: parts[0]: the key 'checkerboards' is missing"},
      {"parts:\n- name: plate\n  name: pipe\n  checkerboards: [" + BOARD + "]",
       ":3: parts[0]: the key 'name' stands here twice"},
      {"parts:\n- {name: a, checkerboards: [" + BOARD + "]}\n- {name: a, checkerboards: [" + BOARD + "]}",
       ":3: parts[1].name: another part has the name 'a' already"},
      {"parts:\n- {name: bolt_1, checkerboards: [" + BOARD + "]}\n- {name: bolt, copies: 2, checkerboards: [" + BOARD +
           "]}",
       ":3: parts[1].name: 'bolt' and 'bolt_1' would share a TF frame: that of a copy is NAME_NUMBER"},
      {"parts:\n- name: plate\n  copies: 0\n  checkerboards: [" + BOARD + "]",
       ":3: parts[0].copies: expected the number of like parts that may be in view at once, 1 to 100, not '0'"},
      {partWith("[]"), ":3: parts[0].checkerboards: expected a list of one checkerboard or more"},
      {partWith("[" + BOARD + "]", "3"), ":4: parts[0].targets: expected a list of targets"},
      {partWith("[{cols: 10, square: 0.02}]"), ":3: parts[0].checkerboards[0]: the key 'rows' is missing"},
      {partWith("[{rows: 4, cols: 10, square: 0.02}]"),
       ":3: parts[0].checkerboards[0].rows: expected the squares along the shorter side, 5 to 21, not '4'"},
      {partWith("[{rows: 5.5, cols: 10, square: 0.02}]"), "not '5.5'"},
      {partWith("[{rows: 5, cols: 22, square: 0.02}]"),
       ":3: parts[0].checkerboards[0].cols: expected the squares along the longer side, 7 to 21, not '22'"},
      {partWith("[{rows: 10, cols: 7, square: 0.02}]"),
       ":3: parts[0].checkerboards[0].cols: expected at least as many as rows, 10; swap the two and turn the board's "
       "pose by 90 degrees"},
      {partWith("[{rows: 7, cols: 10}]"), "the key 'square' is missing: expected the side of a square in metres"},
      {partWith("[{rows: 7, cols: 10, square: 20}]"),
       ":3: parts[0].checkerboards[0].square: expected the side of a square in metres, 0.001 to 1, not '20'"},
      {partWith("[{rows: 7, cols: 10, square: nan}]"), "not 'nan'"},
      {partWith("[{rows: 7, cols: 10, square: 2 cm}]"), "not '2 cm'"},
      {partWith("[{rows: 7, cols: 10, square: [1]}]"), "square: expected the side of a square in metres, 0.001 to 1"},
      {partWith("[{rows: 7, cols: 10, size: 0.02}]"),
       "there is no key 'size': expected one of rows, cols, square, pose, surface"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, pose: {xyz: [1, 2]}}]"),
       "pose.xyz: expected three positions in metres, each -50 to 50, not 2 values"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, pose: {xyz: [1, 2, 300]}}]"),
       "pose.xyz[2]: expected three positions in metres, each -50 to 50, not '300'"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, pose: {rpy: [0, 0, 0]}}]"),
       "pose: there is no key 'rpy': expected one of xyz, rpy_degrees, quaternion"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, pose: {rpy_degrees: [0, 0, 0]}}]"),
       "pose: the key 'xyz' is missing"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, pose: {xyz: [0, 0, 0], rpy_degrees: [0, 0, 400]}}]"),
       "pose.rpy_degrees[2]: expected roll, pitch and yaw in degrees, each -360 to 360, not '400'"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, pose: {xyz: [0, 0, 0], quaternion: [0, 0, 1, 1]}}]"),
       "pose.quaternion: expected a quaternion x, y, z, w of length 1; its length is 1.414214, not 1"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, pose: {xyz: [0, 0, 0], rpy_degrees: [0, 0, 0], quaternion: [0, 0, "
                "0, 1]}}]"),
       "pose.quaternion: the turn is given twice: keep 'rpy_degrees' or 'quaternion'"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, surface: plane}]"),
       "surface: expected a map with the key 'cylinder'; without 'surface' a board is flat"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, surface: {axis: x}}]"),
       "surface: the key 'cylinder' is missing: expected the radius of the cylinder in metres, 0.01 to 100"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, surface: {cylinder: 0}}]"),
       "surface.cylinder: expected the radius of the cylinder in metres, 0.01 to 100, not '0'"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, surface: {cylinder: 0.05}}]"),
       "surface.cylinder: the board is 0.200000 m long around the axis, more than half the girth, 0.157080 m; is the "
       "axis along the board's other side?"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, surface: {cylinder: 0.1, axis: z}}]"),
       "surface.axis: expected 'y' or 'x', not 'z'"},
      {partWith("[{rows: 7, cols: 10, square: 0.02, surface: {cylinder: 0.1, side: out}}]"),
       "surface.side: expected 'outside' or 'inside', not 'out'"},
      {partWith("[" + BOARD + "]", "[{ring: 0.01, xyz: [1, 0, 0]}]"),
       ":4: parts[0].targets[0]: the key 'colors' is missing"},
      {partWith("[" + BOARD + "]", "[{colors: RXB, ring: 0.01, xyz: [1, 0, 0]}]"),
       ":4: parts[0].targets[0].colors: expected 2 to 9 letters of W P R G B, from the inner disk outwards, not 'RXB'"},
      {partWith("[" + BOARD + "]", "[{colors: R, ring: 0.01, xyz: [1, 0, 0]}]"), "not 'R'"},
      {partWith("[" + BOARD + "]", "[{colors: RGRGRGRGRG, ring: 0.01, xyz: [1, 0, 0]}]"), "not 'RGRGRGRGRG'"},
      {partWith("[" + BOARD + "]", "[{colors: RRB, ring: 0.01, xyz: [1, 0, 0]}]"),
       "'RRB': expected neighbouring rings of different colours"},
      {partWith("[" + BOARD + "]", "[{colors: RGB, ring: 10, xyz: [1, 0, 0]}]"),
       "ring: expected the width of a ring in metres, 0.0005 to 0.5, not '10'"},
      {partWith("[" + BOARD + "]", "[{colors: RGB, ring: 0.01}]"), "the key 'xyz' is missing"},
      {partWith("[" + BOARD + "]", "[{colors: RGB, ring: 0.01, xyz: [0.12, 0, 0]}]"),
       ":4: parts[0].targets[0]: this marker overlaps parts[0].checkerboards[0]"},
      {partWith("[" + BOARD + "]",
                "[{colors: RGB, ring: 0.01, xyz: [1, 0, 0]}, {colors: RGB, ring: 0.01, xyz: [1, "
                "0.05, 0]}]"),
       ":4: parts[0].targets[1]: this marker overlaps parts[0].targets[0]"},
      {"parts:\n- name: plate\n  checkerboards: [" + BOARD + "]\n  targets:\n",
       ":4: parts[0]: the key 'targets' has no value: expected a list of targets"},
      {partWith("[{rows: 7, cols: 10,\n  square: }]"), ":4: parts[0].checkerboards[0]: the key 'square' has no value"},
      {partWith("[" + BOARD + "]") + "---\n" + partWith("[" + BOARD + "]"),
       ":6: a second document, behind '---', would be ignored"},
      {partWith("[" + BOARD + "]", "[{colors: RGB, ring: 0.01, xyz: [40, -45, 0]}]"),
       ":4: parts[0].targets[0]: this marker is 60.2"},
      {partWith("[" + BOARD + ", {rows: 5, cols: 7, square: 0.01, pose: {xyz: [0, 29, 0]}}]"),
       " m from parts[0].checkerboards[0], more than 200 times the shorter side of the part's largest marker, 0.140000 "
       "m: expected positions in metres, not in millimetres"},
      {partWith("[" + BOARD + ", " + BOARD + "]"),
       ":3: parts[0].checkerboards[1]: this marker overlaps parts[0].checkerboards[0]"},
  };
  for (const Mistake& mistake : mistakes)
  {
    const std::string said = complaint(mistake.text);
    EXPECT_NE(said.find(mistake.answer), std::string::npos) << mistake.text << "\n  said: " << said;
  }
}

TEST(Parts, markersThatTouchDoNotOverlap)
{
  EXPECT_EQ(parse(partWith("[" + BOARD + "]", "[{colors: RGB, ring: 0.01, xyz: [0.1300001, 0.01, 0]}]")).size(), 1U);
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
