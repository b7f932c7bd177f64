#include "outdoor_omr/parts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "board_surface.h"
#include "yaml_file.h"
#include "yaml_pose.h"

namespace omr
{
namespace
{
// Bounds [m] that catch a file written in millimetres.
constexpr double MIN_SQUARE = 0.001;
constexpr double MAX_SQUARE = 1;
constexpr double MIN_RING = 0.0005;
constexpr double MAX_RING = 0.5;
constexpr double MIN_RADIUS = 0.01;
constexpr double MAX_RADIUS = 100;
constexpr int MIN_ROWS = 5;  // squares, as the detector's (paper, section 3.4: 5x7 to 21x21)
constexpr int MIN_COLS = 7;
constexpr int MAX_SIDE = 21;
constexpr int MAX_COPIES = 100;
constexpr std::size_t MIN_RINGS = 2;
constexpr std::size_t MAX_RINGS = 9;
constexpr double TOUCH = 1e-6;  // [m]; markers that share an edge do not overlap

/** Shorter sides of the part's largest marker that another one may lie from the first board. Positions in millimetres
 * below the bound of 50 pass for metres; but markers that do not overlap are half a side apart, which read as metres is
 * 500 sides. In metres 200 sides of a board of 7 x 10 squares of 20 mm are 28 m, and a camera of 4000 px that sees both
 * has 20 px for the board. */
constexpr double MAX_SIDES_APART = 200;

bool readChoice(const YamlFile& map, const std::string& key, const std::string& usual, const std::string& other)
{
  if (!map.has(key))
  {
    return false;
  }
  const std::string expected = "'" + usual + "' or '" + other + "'";
  const YamlFile node = map.get(key, expected);
  const std::string word = node.text(expected);
  if (word != usual && word != other)
  {
    node.fail("expected " + expected + ", not '" + word + "'");
  }
  return word == other;
}

void readSurface(const YamlFile& surface, PartCheckerboard& board)
{
  surface.allowOnly({"cylinder", "axis", "side"}, "a map with the key 'cylinder'; without 'surface' a board is flat");
  const std::string expected = "the radius of the cylinder in metres, 0.01 to 100";
  const YamlFile cylinder = surface.get("cylinder", expected);
  const double radius = cylinder.number(expected, MIN_RADIUS, MAX_RADIUS);
  board.axis_along_x = readChoice(surface, "axis", "y", "x");
  board.curvature = readChoice(surface, "side", "outside", "inside") ? -1 / radius : 1 / radius;
  const double length = (board.axis_along_x ? board.rows : board.cols) * board.square;
  if (length > CV_PI * radius)
  {
    cylinder.fail("the board is " + std::to_string(length) + " m long around the axis, more than half the girth, " +
                  std::to_string(CV_PI * radius) + " m; is the axis along the board's other side?");
  }
}

PartCheckerboard readCheckerboard(const YamlFile& node)
{
  node.allowOnly({"rows", "cols", "square", "pose", "surface"}, "a map with 'rows', 'cols' and 'square'");
  PartCheckerboard board;
  const std::string short_side = "the squares along the shorter side, 5 to 21";
  const std::string long_side = "the squares along the longer side, 7 to 21";
  board.rows = node.get("rows", short_side).integer(short_side, MIN_ROWS, MAX_SIDE);
  const YamlFile cols = node.get("cols", long_side);
  board.cols = cols.integer(long_side, MIN_COLS, MAX_SIDE);
  if (board.rows > board.cols)
  {
    cols.fail("expected at least as many as rows, " + std::to_string(board.rows) +
              "; swap the two and turn the board's pose by 90 degrees");
  }
  const std::string square = "the side of a square in metres, 0.001 to 1";
  board.square = node.get("square", square).number(square, MIN_SQUARE, MAX_SQUARE);
  board.pose = node.has("pose") ? readPose(node.get("pose", "a pose")) : cv::Affine3d::Identity();
  if (node.has("surface"))
  {
    readSurface(node.get("surface", "a surface"), board);
  }
  return board;
}

PartTarget readTarget(const YamlFile& node)
{
  node.allowOnly({"colors", "ring", "xyz"}, "a map with 'colors', 'ring' and 'xyz'");
  PartTarget target;
  const std::string expected = "2 to 9 letters of W P R G B, from the inner disk outwards";
  const YamlFile colors = node.get("colors", expected);
  target.colors = colors.text(expected);
  const bool is_colors = target.colors.find_first_not_of("WPRGB") == std::string::npos;
  if (!is_colors || target.colors.size() < MIN_RINGS || target.colors.size() > MAX_RINGS)
  {
    colors.fail("expected " + expected + ", not '" + target.colors + "'");
  }
  if (std::adjacent_find(target.colors.begin(), target.colors.end()) != target.colors.end())
  {
    colors.fail("'" + target.colors + "': expected neighbouring rings of different colours");
  }
  const std::string ring = "the width of a ring in metres, 0.0005 to 0.5";
  target.ring = node.get("ring", ring).number(ring, MIN_RING, MAX_RING);
  target.center = cv::Point3d(readPosition(node.get("xyz", POSITION_IN_METRES)));
  return target;
}

/** The ground a marker covers, as balls; `node` is where it stands in the file. */
struct Cover
{
  YamlFile node;
  std::vector<cv::Point3d> centers;
  double radius = 0;
};

Cover coverOf(const YamlFile& node, const PartCheckerboard& board)
{
  Cover cover{node, {}, board.square / 2};
  for (int row = 0; row < board.rows; ++row)
  {
    for (int col = 0; col < board.cols; ++col)
    {
      const cv::Affine3d frame = touchingFrame(board, (col + 0.5 - board.cols / 2.0) * board.square,
                                               (row + 0.5 - board.rows / 2.0) * board.square);
      cover.centers.emplace_back(board.pose * cv::Point3d(frame.translation()));
    }
  }
  return cover;
}

void refuseOverlap(const Cover& a, const Cover& b)
{
  for (const cv::Point3d& of_a : a.centers)
  {
    for (const cv::Point3d& of_b : b.centers)
    {
      if (cv::norm(of_a - of_b) < a.radius + b.radius - TOUCH)
      {
        b.node.fail("this marker overlaps " + a.node.key());
      }
    }
  }
}

void refuseFar(const Part& part, const std::vector<Cover>& covers)
{
  double side = 0;
  for (const PartCheckerboard& board : part.checkerboards)
  {
    side = std::max(side, board.rows * board.square);
  }
  for (const PartTarget& target : part.targets)
  {
    side = std::max(side, 2 * target.ring * static_cast<double>(target.colors.size()));
  }
  for (const Cover& cover : covers)
  {
    const double distance = cv::norm(cover.centers.front() - covers.front().centers.front());
    if (distance > MAX_SIDES_APART * side)
    {
      cover.node.fail("this marker is " + std::to_string(distance) + " m from " + covers.front().node.key() +
                      ", more than 200 times the shorter side of the part's largest marker, " + std::to_string(side) +
                      " m: expected positions in metres, not in millimetres");
    }
  }
}

std::string readName(const YamlFile& part)
{
  const std::string expected = "a name of letters, digits and _ - . / that does not begin with /: it names a TF frame";
  const YamlFile node = part.get("name", expected);
  std::string name = node.text(expected);
  const auto fits = [](unsigned char letter) {
    return std::isalnum(letter) != 0 || std::string("_-./").find(static_cast<char>(letter)) != std::string::npos;
  };
  if (!std::all_of(name.begin(), name.end(), fits) || name.front() == '/')
  {
    node.fail("expected " + expected + ", not '" + name + "'");
  }
  return name;
}

Part readPart(const YamlFile& node)
{
  node.allowOnly({"name", "copies", "checkerboards", "targets"}, "a map with 'name', 'checkerboards' and 'targets'");
  Part part;
  part.name = readName(node);
  if (node.has("copies"))
  {
    const std::string expected = "the number of like parts that may be in view at once, 1 to 100";
    part.copies = node.get("copies", expected).integer(expected, 1, MAX_COPIES);
  }
  std::vector<Cover> covers;
  const std::string boards = "a list of one checkerboard or more";
  const YamlFile board_list = node.get("checkerboards", boards);
  for (const YamlFile& entry : board_list.list(boards))
  {
    part.checkerboards.push_back(readCheckerboard(entry));
    covers.push_back(coverOf(entry, part.checkerboards.back()));
  }
  if (part.checkerboards.empty())
  {
    board_list.fail("expected " + boards);
  }
  if (node.has("targets"))
  {
    for (const YamlFile& entry : node.get("targets", "a list of targets").list("a list of targets"))
    {
      part.targets.push_back(readTarget(entry));
      const PartTarget& target = part.targets.back();
      covers.push_back({entry, {target.center}, target.ring * static_cast<double>(target.colors.size())});
    }
  }
  for (std::size_t i = 1; i < covers.size(); ++i)
  {
    std::for_each(covers.begin(), covers.begin() + static_cast<std::ptrdiff_t>(i),
                  [&](const Cover& other) { refuseOverlap(other, covers[i]); });
  }
  refuseFar(part, covers);
  return part;
}

/** Whether a name is that of the TF frame of a part's copy. */
bool isFrameOfCopy(const std::string& name, const Part& part)
{
  const std::string start = part.name + "_";
  return part.copies > 1 && name.size() > start.size() && name.rfind(start, 0) == 0 &&
         name.find_first_not_of("0123456789", start.size()) == std::string::npos;
}
}  // namespace

std::vector<Part> readParts(const std::string& file)
{
  const YamlFile root = YamlFile::load(file);
  root.allowOnly({"parts"}, "a map with the key 'parts'");
  const std::string expected = "a list of one part or more";
  const YamlFile list = root.get("parts", expected);
  std::vector<Part> parts;
  for (const YamlFile& entry : list.list(expected))
  {
    Part part = readPart(entry);
    if (std::any_of(parts.begin(), parts.end(), [&](const Part& other) { return other.name == part.name; }))
    {
      entry.get("name", "a name").fail("another part has the name '" + part.name + "' already");
    }
    for (const Part& other : parts)
    {
      if (isFrameOfCopy(part.name, other) || isFrameOfCopy(other.name, part))
      {
        entry.get("name", "a name")
            .fail("'" + part.name + "' and '" + other.name + "' would share a TF frame: that of a copy is NAME_NUMBER");
      }
    }
    parts.push_back(std::move(part));
  }
  if (parts.empty())
  {
    list.fail("expected " + expected);
  }
  return parts;
}

}  // namespace omr
