#include <gtest/gtest.h>

#include <functional>
#include <regex>
#include <stdexcept>

#include "sheet.h"
#include "sheet_writers.h"

using omr::arrangeSheet;
using omr::Shape;
using omr::Sheet;
using omr::SheetContent;

namespace
{
const cv::Size2d A4(210, 297);
const cv::Vec3b BLACK(0, 0, 0);
const cv::Vec3b WHITE(255, 255, 255);

SheetContent boardOf(int rows, int cols, double square)
{
  SheetContent content;
  content.checkerboards = {cv::Size(cols, rows)};
  content.square = square;
  return content;
}

SheetContent targetOf(const std::string& colors, double ring)
{
  SheetContent content;
  content.targets = {colors};
  content.ring = ring;
  return content;
}

std::string refusal(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "";
}

/** The numbers that the groups of a pattern match, one vector a match. */
std::vector<std::vector<double>> numbersOf(const std::string& text, const std::string& pattern)
{
  std::vector<std::vector<double>> result;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression); match != std::sregex_iterator(); ++match)
  {
    result.emplace_back();
    for (std::size_t group = 1; group < match->size(); ++group)
    {
      result.back().push_back(std::stod((*match)[group]));
    }
  }
  return result;
}
}  // namespace

TEST(Sheet, parsesSizes)
{
  EXPECT_EQ(cv::Size(10, 7), omr::parseCheckerboard("7x10"));
  EXPECT_EQ(cv::Size(5, 7), omr::parseCheckerboard("7x5"));
  for (const char* wrong : {"", "7", "x", "7x", "4x9", "5x6", "7x22", "-7x10", "7x10x3", "7 by 10", "7x10mm", "1e9x7"})
  {
    EXPECT_THROW(omr::parseCheckerboard(wrong), std::invalid_argument) << wrong;
  }
  EXPECT_EQ(cv::Size2d(297, 420), omr::parsePage("A3"));
  EXPECT_EQ(cv::Size2d(300.5, 200), omr::parsePage("300.5x200"));
  for (const char* wrong : {"", "A9", "a4", "300", "x", "0x100", "-300x200", "300x200x100", "nanx200", "1e9x200"})
  {
    EXPECT_THROW(omr::parsePage(wrong), std::invalid_argument) << wrong;
  }
}

TEST(Sheet, drawsTheBlackSquaresOfACheckerboardWithAMarginOfOneSquare)
{
  const Sheet sheet = arrangeSheet(boardOf(5, 8, 20), A4);
  std::vector<Shape> squares;
  for (const Shape& shape : sheet.shapes)
  {
    if (shape.kind == Shape::Kind::rectangle && shape.size.height == 20)
    {
      squares.push_back(shape);
    }
  }
  ASSERT_EQ(20U, squares.size());
  const cv::Point2d first = squares.front().position;
  EXPECT_GE(first.x, 20);
  EXPECT_GE(first.y, 20);
  EXPECT_EQ(first + cv::Point2d(20, 20), squares[4].position);  // second row
  EXPECT_EQ(first + cv::Point2d(120, 80), squares.back().position);
  for (const Shape& shape : sheet.shapes)
  {
    const bool below = shape.position.y - (shape.kind == Shape::Kind::text ? shape.size.height : 0) >= first.y + 120;
    EXPECT_TRUE(below || shape.size.height == 20) << "something is drawn in the white margin";
  }
}

TEST(Sheet, drawsRingsFromTheOutside)
{
  const Sheet sheet = arrangeSheet(targetOf("RWPGB", 12), A4);
  std::vector<double> radii;
  for (const Shape& shape : sheet.shapes)
  {
    if (shape.kind == Shape::Kind::circle)
    {
      EXPECT_EQ(sheet.shapes[1].position, shape.position);
      radii.push_back(shape.size.width);
    }
  }
  EXPECT_EQ((std::vector<double>{60, 48, 36, 24, 12}), radii);
}

TEST(Sheet, markersKeepApartAndOnThePage)
{
  SheetContent content = boardOf(5, 7, 12);
  content.checkerboards.push_back({9, 6});
  content.targets = {"RWP", "PGB", "GRGB"};
  content.ring = 8;
  const Sheet sheet = arrangeSheet(content, omr::parsePage("A3"));
  std::vector<cv::Rect2d> circles;
  for (const Shape& shape : sheet.shapes)
  {
    const bool circle = shape.kind == Shape::Kind::circle;
    const cv::Point2d reach = circle ? cv::Point2d(shape.size) : cv::Point2d();
    const cv::Rect2d box(shape.position - reach, shape.position + (circle ? reach : cv::Point2d(shape.size)));
    EXPECT_GE(std::min(box.x, box.y), 0);
    EXPECT_LE(box.br().x, sheet.page.width);
    EXPECT_LE(box.br().y, sheet.page.height);
    if (circle && (circles.empty() || (circles.back() & box) != box))
    {
      for (const cv::Rect2d& other : circles)
      {
        EXPECT_EQ(0, (other & box).area());
      }
      circles.push_back(box);
    }
  }
  EXPECT_EQ(3U, circles.size());
}

TEST(Sheet, refusesWhatDoesNotFitAndSaysHowMuchRoomThereIs)
{
  EXPECT_EQ(
      "the checkerboard 7 x 10 squares of 30 mm does not fit: with its margin it takes 360 x 276 mm; a page of "
      "210 x 297 mm has 210 x 277 mm for all its markers",
      refusal([] { arrangeSheet(boardOf(7, 10, 30), A4); }));
  SheetContent many = targetOf("RPG", 12);
  many.targets.assign(4, "RPG");
  EXPECT_EQ("", refusal([&] { arrangeSheet(many, A4); }));
  many.targets.assign(5, "RPG");
  EXPECT_NE("", refusal([&] { arrangeSheet(many, A4); }));
  EXPECT_NE("", refusal([] { arrangeSheet(targetOf("RPG", 5), {90, 200}); }));
}

TEST(Sheet, refusesMarkersThatCannotBeRead)
{
  EXPECT_NE("", refusal([] { arrangeSheet({}, A4); }));
  for (const char* colors : {"", "P", "RR", "RPPG", "RPX", "rpg", "RP?", "RPW", "RPGRPGRPGR"})
  {
    EXPECT_NE("", refusal([&] { arrangeSheet(targetOf(colors, 5), A4); })) << colors;
  }
  for (const double length : {0., -1., 1e9, std::numeric_limits<double>::quiet_NaN()})
  {
    EXPECT_NE("", refusal([&] { arrangeSheet(targetOf("RPG", length), A4); })) << length;
    EXPECT_NE("", refusal([&] { arrangeSheet(boardOf(5, 7, length), A4); })) << length;
  }
}

TEST(Sheet, advisesAgainstBoardsThatLookTheSameUpsideDown)
{
  EXPECT_TRUE(omr::adviceFor(boardOf(7, 10, 10)).empty());
  EXPECT_EQ(1U, omr::adviceFor(boardOf(7, 9, 10)).size());
  EXPECT_EQ(1U, omr::adviceFor(boardOf(6, 8, 10)).size());
}

TEST(SheetWriters, svgIsInMillimetres)
{
  const std::string svg = omr::toSvg(arrangeSheet(boardOf(5, 7, 15), A4));
  EXPECT_NE(std::string::npos, svg.find("width=\"210mm\" height=\"297mm\" viewBox=\"0 0 210 297\""));
  EXPECT_EQ(18U,
            numbersOf(svg, "<rect fill=\"rgb\\(0,0,0\\)\" x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"15\" height=\"15\"")
                .size());
  EXPECT_EQ(1U, numbersOf(svg, "<rect fill=\"rgb\\(0,0,0\\)\" x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"100\"").size());
  const std::string target = omr::toSvg(arrangeSheet(targetOf("RPG", 9), A4));
  EXPECT_EQ((std::vector<std::vector<double>>{{0, 160, 0, 27}, {0, 0, 0, 18}, {255, 0, 0, 9}}),
            numbersOf(target, "<circle fill=\"rgb\\((\\d+),(\\d+),(\\d+)\\)\" .* r=\"([0-9.]+)\""));
}

TEST(SheetWriters, pdfIsInMillimetres)
{
  const std::string pdf = omr::toPdf(arrangeSheet(boardOf(5, 7, 15), A4));
  const auto media_box = numbersOf(pdf, "/MediaBox \\[0 0 ([0-9.]+) ([0-9.]+)\\]");
  ASSERT_EQ(1U, media_box.size());
  EXPECT_NEAR(210 / 25.4 * 72, media_box[0][0], 1e-3);
  EXPECT_NEAR(297 / 25.4 * 72, media_box[0][1], 1e-3);
  const auto scale = numbersOf(pdf, "stream\n([0-9.]+) 0 0 (-[0-9.]+) 0 ([0-9.]+) cm");
  ASSERT_EQ(1U, scale.size());
  EXPECT_NEAR(72 / 25.4, scale[0][0], 1e-6);
  EXPECT_NEAR(-72 / 25.4, scale[0][1], 1e-6);
  EXPECT_NEAR(297 / 25.4 * 72, scale[0][2], 1e-3);
  EXPECT_EQ(18U, numbersOf(pdf, "0 0 0 rg ([0-9.]+) ([0-9.]+) 15 15 re f").size());
}

TEST(SheetWriters, pdfObjectsLieWhereTheTableSays)
{
  const std::string pdf = omr::toPdf(arrangeSheet(targetOf("RWPGB", 12), A4));
  const auto start = numbersOf(pdf, "startxref\n(\\d+)\n%%EOF");
  ASSERT_EQ(1U, start.size());
  EXPECT_EQ("xref\n0 6\n", pdf.substr(static_cast<std::size_t>(start[0][0]), 9));
  const auto offsets = numbersOf(pdf, "(\\d{10}) 00000 n ");
  ASSERT_EQ(5U, offsets.size());
  for (std::size_t i = 0; i < offsets.size(); ++i)
  {
    const std::string object = std::to_string(i + 1) + " 0 obj\n";
    EXPECT_EQ(object, pdf.substr(static_cast<std::size_t>(offsets[i][0]), object.size()));
  }
  const auto length = numbersOf(pdf, "/Length (\\d+) >>");
  const std::size_t content = pdf.find("stream\n") + 7;
  EXPECT_EQ(pdf.find("endstream"), content + static_cast<std::size_t>(length[0][0]));
}

TEST(SheetWriters, imageHasTheColorsAtTheirPlaces)
{
  const double dpi = 127;  // 5 px a mm
  const Sheet sheet = arrangeSheet(targetOf("RWPGB", 12), A4);
  const cv::Mat image = omr::toImage(sheet, dpi);
  EXPECT_EQ(cv::Size(1050, 1485), image.size());
  const cv::Point center(5 * sheet.shapes[1].position);
  const std::vector<cv::Vec3b> colors = {{0, 0, 255}, WHITE, BLACK, {0, 160, 0}, {255, 0, 0}, WHITE};
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(colors[static_cast<std::size_t>(i)], image.at<cv::Vec3b>(center + cv::Point(60 * i + 30, 0))) << i;
    EXPECT_EQ(colors[static_cast<std::size_t>(i)], image.at<cv::Vec3b>(center - cv::Point(0, 60 * i + 30))) << i;
  }
}

TEST(SheetWriters, imageCountsTheShareOfPixelsOnARim)
{
  Sheet sheet;
  sheet.page = {100, 100};
  sheet.shapes = {{Shape::Kind::rectangle, BLACK, {10.5, 20}, {10, 10.25}, ""}};
  const cv::Mat image = omr::toImage(sheet, 25.4);  // 1 px a mm
  EXPECT_EQ(WHITE, image.at<cv::Vec3b>(25, 9));
  EXPECT_NEAR(128, image.at<cv::Vec3b>(25, 10)[0], 1);
  EXPECT_EQ(BLACK, image.at<cv::Vec3b>(25, 11));
  EXPECT_NEAR(191, image.at<cv::Vec3b>(30, 15)[1], 1);
  double dark = 0;
  for (const auto& pixel : cv::Mat_<cv::Vec3b>(image))
  {
    dark += (255 - pixel[2]) / 255.;
  }
  EXPECT_NEAR(102.5, dark, 0.5);
}

TEST(SheetWriters, refusesAbsurdResolutions)
{
  const Sheet sheet = arrangeSheet(targetOf("RPG", 9), A4);
  for (const double dpi : {0., -300., 1e6, std::numeric_limits<double>::quiet_NaN()})
  {
    EXPECT_THROW(omr::toImage(sheet, dpi), std::invalid_argument) << dpi;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
