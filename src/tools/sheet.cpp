#include "sheet.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <stdexcept>

namespace omr
{
namespace
{
const cv::Vec3b BLACK(0, 0, 0);

// Printed at full saturation: what a camera sees of a colour is duller than what was printed.
const std::map<char, cv::Vec3b> RING_COLORS = {
    {'W', {255, 255, 255}}, {'P', BLACK}, {'R', {0, 0, 255}}, {'G', {0, 160, 0}}, {'B', {255, 0, 0}}};

constexpr double PAGE_MARGIN = 8;  // [mm]; what common printers cannot print on is 3 to 6 mm
constexpr double FONT_SIZE = 3.5;  // [mm]
constexpr double LINE_HEIGHT = 6;  // [mm]
constexpr double RULER_LENGTH = 100;
constexpr double RULER_HEIGHT = 12;  // [mm] with its text

/** One marker with its margin and its label, drawn as if its top left corner were the origin. */
struct Block
{
  std::string name;
  double margin = 0;  ///< white on every side [mm]
  cv::Size2d size;    ///< [mm]
  std::vector<Shape> shapes;
};

std::string number(double value)
{
  std::ostringstream text;
  text << std::setprecision(6) << value;
  return text.str();
}

std::string sizeText(const cv::Size2d& size)
{
  return number(size.width) + " x " + number(size.height) + " mm";
}

Shape rectangle(const cv::Point2d& corner, const cv::Size2d& size, const cv::Vec3b& color)
{
  return {Shape::Kind::rectangle, color, corner, size, ""};
}

Shape label(const cv::Point2d& position, const std::string& text)
{
  return {Shape::Kind::text, BLACK, position, {0, FONT_SIZE}, text};
}

/** Upper bound of the width of a text in Helvetica [mm]: a letter is on average half as wide as the font is high. */
double textWidth(const std::string& text)
{
  return 0.6 * FONT_SIZE * static_cast<double>(text.size());
}

/** Margin, marker, margin, label; the margins are white because nothing is drawn there. */
Block makeBlock(const std::string& name, const cv::Size2d& marker, double margin)
{
  Block block;
  block.margin = margin;
  block.name = name;
  block.size = {std::max(marker.width + 2 * margin, textWidth(name) + margin),
                marker.height + 2 * margin + LINE_HEIGHT};
  block.shapes.push_back(label({margin, marker.height + 2 * margin + FONT_SIZE}, name));
  return block;
}

Block makeCheckerboard(const cv::Size& squares, double side)
{
  const std::string name = "checkerboard " + std::to_string(squares.height) + " x " + std::to_string(squares.width) +
                           " squares of " + number(side) + " mm";
  Block block = makeBlock(name, cv::Size2d(squares.width * side, squares.height * side), std::max(side, PAGE_MARGIN));
  const cv::Point2d corner(block.margin, block.margin);
  for (int row = 0; row < squares.height; ++row)
  {
    for (int col = row % 2; col < squares.width; col += 2)
    {
      block.shapes.push_back(rectangle(corner + side * cv::Point2d(col, row), {side, side}, BLACK));
    }
  }
  return block;
}

void checkTarget(const std::string& colors)
{
  const std::string name = "target '" + colors + "': ";
  if (colors.size() < 2 || colors.size() > 9)
  {
    throw std::invalid_argument(name + "a target has 2 to 9 rings");
  }
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    if (RING_COLORS.count(colors[i]) == 0)
    {
      throw std::invalid_argument(name + "a ring is W white, P black, R red, G green or B blue");
    }
    if (i > 0 && colors[i] == colors[i - 1])
    {
      throw std::invalid_argument(name + "neighbouring rings of the same colour are one ring");
    }
  }
  if (colors.back() == 'W')
  {
    throw std::invalid_argument(name + "a white outer ring cannot be told from the paper");
  }
}

Block makeTarget(const std::string& colors, double ring)
{
  checkTarget(colors);
  const double radius = ring * static_cast<double>(colors.size());
  Block block = makeBlock("target " + colors + " with rings of " + number(ring) + " mm", {2 * radius, 2 * radius},
                          std::max(ring, PAGE_MARGIN));
  const cv::Point2d center(radius + block.margin, radius + block.margin);
  for (std::size_t i = colors.size(); i-- > 0;)  // the outermost first: each next disk covers its middle
  {
    const double disk = ring * static_cast<double>(i + 1);
    block.shapes.push_back({Shape::Kind::circle, RING_COLORS.at(colors[i]), center, {disk, disk}, ""});
  }
  return block;
}

std::vector<Block> makeBlocks(const SheetContent& content)
{
  std::vector<Block> blocks;
  for (const cv::Size& squares : content.checkerboards)
  {
    blocks.push_back(makeCheckerboard(squares, content.square));
  }
  for (const std::string& colors : content.targets)
  {
    blocks.push_back(makeTarget(colors, content.ring));
  }
  return blocks;
}

void append(Sheet& sheet, const std::vector<Shape>& shapes, const cv::Point2d& offset)
{
  for (Shape shape : shapes)
  {
    shape.position += offset;
    sheet.shapes.push_back(shape);
  }
}

/** A line with a mark every 10 mm, and what it should measure. */
std::vector<Shape> makeRuler()
{
  const double stroke = 0.25;
  std::vector<Shape> shapes = {rectangle({0, 4 - stroke / 2}, {RULER_LENGTH, stroke}, BLACK),
                               label({0, 4 + 1.5 * FONT_SIZE}, "100 mm: measure it; print at 100 %, never \"fit\"")};
  for (int mark = 0; mark <= 10; ++mark)
  {
    const double height = mark % 5 == 0 ? 4 : 2;
    shapes.push_back(rectangle({10. * mark - stroke / 2, 4 - height}, {stroke, height}, BLACK));
  }
  return shapes;
}

/** A page's side in mm: at least 50, so that the ruler's unit makes sense, at most 10 m. */
double parseSide(const std::string& text)
{
  std::istringstream stream(text);
  double side = 0;
  char rest = 0;
  if (!(stream >> side) || stream >> rest || !(side >= 50 && side <= 10000))
  {
    throw std::invalid_argument("a page's side is 50 to 10000 mm, not '" + text + "'");
  }
  return side;
}

void checkLength(const std::string& name, double length)
{
  if (!(length > 0 && length <= 1000))
  {
    throw std::invalid_argument(name + " is more than 0 and at most 1000 mm, not " + number(length));
  }
}
}  // namespace

cv::Size parseCheckerboard(const std::string& text)
{
  std::istringstream stream(text);
  int rows = 0;
  int cols = 0;
  char cross = 0;
  char rest = 0;
  if (!(stream >> rows >> cross >> cols) || cross != 'x' || stream >> rest)
  {
    throw std::invalid_argument("a checkerboard is given as ROWSxCOLS squares, for example 7x10, not '" + text + "'");
  }
  if (std::min(rows, cols) < 5 || std::max(rows, cols) < 7 || std::max(rows, cols) > 21)
  {
    throw std::invalid_argument("a checkerboard has 5x7 to 21x21 squares, not " + text);
  }
  return {cols, rows};
}

cv::Size2d parsePage(const std::string& text)
{
  static const std::map<std::string, cv::Size2d> PAGES = {{"A4", {210, 297}}, {"A3", {297, 420}}, {"A2", {420, 594}}};
  const auto page = PAGES.find(text);
  if (page != PAGES.end())
  {
    return page->second;
  }
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos)
  {
    throw std::invalid_argument("a page is A4, A3, A2 or WIDTHxHEIGHT in mm, not '" + text + "'");
  }
  return {parseSide(text.substr(0, cross)), parseSide(text.substr(cross + 1))};
}

Sheet arrangeSheet(const SheetContent& content, const cv::Size2d& page)
{
  checkLength("the side of a square", content.square);
  checkLength("the width of a ring", content.ring);
  const std::vector<Block> blocks = makeBlocks(content);
  if (blocks.empty())
  {
    throw std::invalid_argument("nothing to draw: give a checkerboard or a target");
  }
  Sheet sheet;
  sheet.page = page;
  // The markers' own margins may lie where a printer cannot print.
  const cv::Size2d room(page.width, page.height - PAGE_MARGIN - RULER_HEIGHT);
  if (page.width < RULER_LENGTH + 2 * PAGE_MARGIN)
  {
    throw std::invalid_argument("the page is too narrow for the ruler of 100 mm");
  }
  cv::Point2d corner(0, 0);
  double row_height = 0;
  for (const Block& block : blocks)
  {
    if (corner.x + block.size.width > room.width)
    {
      corner = {0, corner.y + row_height};
      row_height = 0;
    }
    if (corner.x + block.size.width > room.width || corner.y + block.size.height > room.height)
    {
      throw std::invalid_argument("the " + block.name + " does not fit: with its margin it takes " +
                                  sizeText(block.size) + "; a page of " + sizeText(page) + " has " + sizeText(room) +
                                  " for all its markers");
    }
    append(sheet, block.shapes, corner);
    corner.x += block.size.width;
    row_height = std::max(row_height, block.size.height);
  }
  append(sheet, makeRuler(), {PAGE_MARGIN, room.height});
  return sheet;
}

std::vector<std::string> adviceFor(const SheetContent& content)
{
  std::vector<std::string> advice;
  for (const cv::Size& squares : content.checkerboards)
  {
    if ((squares.width + squares.height) % 2 == 0)
    {
      advice.push_back("a checkerboard of " + std::to_string(squares.height) + " x " + std::to_string(squares.width) +
                       " squares looks the same upside down; where that matters, make one side odd and one even");
    }
  }
  return advice;
}

}  // namespace omr
