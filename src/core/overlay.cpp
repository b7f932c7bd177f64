#include "outdoor_omr/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "bent_outline.h"

namespace omr
{
namespace
{
using Color = cv::Scalar;

const Color YELLOW(0, 255, 255);
const Color BLUE(255, 0, 0);
const Color GREEN(0, 255, 0);
const Color RED(0, 0, 255);
const Color BLACK(0, 0, 0);

// OpenCV draws at fixed-point coordinates: 4 bits are 1/16 px.
constexpr int SHIFT = 4;
constexpr double FIXED_POINT = 1 << SHIFT;

/** A picture and the stroke that suits its size. */
struct Canvas
{
  cv::Mat image;
  double scale;   ///< 1 at 480 px on the shorter side, never less
  int thickness;  ///< of a line [px]
};

Canvas makeCanvas(const cv::Mat& image)
{
  const double scale = std::max(1., std::min(image.cols, image.rows) / 480.);
  return {image, scale, static_cast<int>(std::lround(scale))};
}

/** Whether OpenCV's fixed-point drawing can take the position: a marker may reach beyond the picture, but not far. */
bool drawable(const Canvas& canvas, const cv::Point2d& point)
{
  const double reach = 4. * std::max(canvas.image.cols, canvas.image.rows) + 1000;
  return std::abs(point.x) <= reach && std::abs(point.y) <= reach;
}

cv::Point fixedPoint(const cv::Point2d& point)
{
  return {static_cast<int>(std::lround(point.x * FIXED_POINT)), static_cast<int>(std::lround(point.y * FIXED_POINT))};
}

void drawLine(Canvas& canvas, const cv::Point2d& from, const cv::Point2d& to, const Color& color)
{
  if (drawable(canvas, from) && drawable(canvas, to))
  {
    cv::line(canvas.image, fixedPoint(from), fixedPoint(to), color, canvas.thickness, cv::LINE_AA, SHIFT);
  }
}

void drawCircle(Canvas& canvas, const cv::Point2d& center, double radius, const Color& color, int thickness)
{
  if (drawable(canvas, center))
  {
    const int fixed_radius = static_cast<int>(std::lround(radius * FIXED_POINT));
    cv::circle(canvas.image, fixedPoint(center), fixed_radius, color, thickness, cv::LINE_AA, SHIFT);
  }
}

void drawEllipse(Canvas& canvas, const cv::RotatedRect& ellipse, const Color& color)
{
  const cv::Point2d axes(ellipse.size.width, ellipse.size.height);
  if (drawable(canvas, ellipse.center) && drawable(canvas, axes) && axes.x > 0 && axes.y > 0 &&
      std::isfinite(ellipse.angle))
  {
    const cv::Point half_axes = fixedPoint(axes / 2);
    cv::ellipse(canvas.image, fixedPoint(ellipse.center), cv::Size(half_axes.x, half_axes.y), ellipse.angle, 0, 360,
                color, (canvas.thickness + 1) / 2, cv::LINE_AA, SHIFT);
  }
}

/** Writes a line of text with a dark outline; anchor is the text's lower left corner, moved so that all is inside. */
void drawText(Canvas& canvas, const std::string& text, const cv::Point2d& anchor, const Color& color)
{
  if (!drawable(canvas, anchor))
  {
    return;
  }
  const int font = cv::FONT_HERSHEY_SIMPLEX;
  const double font_scale = 0.45 * canvas.scale;
  const int outline = 3 * canvas.thickness;
  int below = 0;
  const cv::Size size = cv::getTextSize(text, font, font_scale, outline, &below);
  const int x = std::max(outline, std::min(cvRound(anchor.x), canvas.image.cols - size.width - outline));
  const int y = std::max(size.height + outline, std::min(cvRound(anchor.y), canvas.image.rows - below - outline));
  cv::putText(canvas.image, text, {x, y}, font, font_scale, BLACK, outline, cv::LINE_AA);
  cv::putText(canvas.image, text, {x, y}, font, font_scale, color, canvas.thickness, cv::LINE_AA);
}

/** Colours of neighbouring numbers lie far apart on the colour circle (golden ratio), none near the targets' yellow. */
Color boardColor(std::size_t index)
{
  const double golden_ratio = 0.6180339887;
  const double turn = std::fmod(0.7 + golden_ratio * static_cast<double>(index), 1.);
  const double hue_degrees = 90 + 300 * turn;
  const cv::Mat hsv(1, 1, CV_8UC3, Color(std::fmod(hue_degrees, 360.) / 2, 255, 255));
  cv::Mat bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  const auto& pixel = bgr.at<cv::Vec3b>(0, 0);
  return {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]), static_cast<double>(pixel[2])};
}

/** A deterministic pseudo-random colour; every channel is at least 48, so it is never the blue or the yellow. */
cv::Vec3b regionColor(int label)
{
  auto hash = static_cast<std::uint32_t>(label) + 1;  // the finaliser of MurmurHash3: neighbours differ in all channels
  hash = (hash ^ (hash >> 16U)) * 0x85ebca6bU;
  hash = (hash ^ (hash >> 13U)) * 0xc2b2ae35U;
  hash ^= hash >> 16U;
  const auto channel = [hash](unsigned shift) { return static_cast<std::uint8_t>(48 + (hash >> shift & 0xffU) % 208); };
  return {channel(0), channel(8), channel(16)};
}

/** Paints every region in a colour of its own, the first blue, edge pixels yellow (paper, section 3). */
void paintRegions(cv::Mat& image, const cv::Mat& labels, const cv::Mat& edges)
{
  int first = -1;
  for (int y = 0; y < image.rows; ++y)
  {
    const int* label = labels.ptr<int>(y);
    const std::uint8_t* edge = edges.empty() ? nullptr : edges.ptr(y);
    auto* pixel = image.ptr<cv::Vec3b>(y);
    for (int x = 0; x < image.cols; ++x)
    {
      if (edge != nullptr && edge[x] != 0)
      {
        pixel[x] = cv::Vec3b(0, 255, 255);
        continue;
      }
      first = first < 0 ? label[x] : first;
      pixel[x] = label[x] == first ? cv::Vec3b(255, 0, 0) : regionColor(label[x]);
    }
  }
}

/** Mean side of the board's squares [px], from its outer quadrilateral. */
double squareSide(const Checkerboard& board)
{
  const double area = std::abs(cv::contourArea(std::vector<cv::Point2f>(board.corners.begin(), board.corners.end())));
  const double squares = std::max(1, board.rows * board.cols);
  return std::isfinite(area) ? std::sqrt(area / squares) : 0;
}

/** An upright green cross where the corner was seen, a tilted red one where it is only predicted. */
void drawInnerCorner(Canvas& canvas, const cv::Point2d& corner, double arm, bool seen)
{
  const cv::Point2d along = seen ? cv::Point2d(arm, 0) : cv::Point2d(arm, arm);
  const cv::Point2d across = seen ? cv::Point2d(0, arm) : cv::Point2d(arm, -arm);
  const Color& color = seen ? GREEN : RED;
  drawLine(canvas, corner - along, corner + along, color);
  drawLine(canvas, corner - across, corner + across, color);
}

std::string sizeText(const Checkerboard& board)
{
  return (board.size_certain ? "" : ">= ") + std::to_string(board.rows) + " x " + std::to_string(board.cols);
}

void drawCheckerboard(Canvas& canvas, const Checkerboard& board, const Color& color)
{
  const double mark = std::max(1., std::min(0.2 * squareSide(board), 6 * canvas.scale));
  const std::vector<cv::Point2f> outline = bentOutline(board);
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    drawLine(canvas, outline[i], outline[(i + 1) % outline.size()], color);
  }
  drawCircle(canvas, board.corners[0], 3 * canvas.scale, color, cv::FILLED);
  for (std::size_t i = 0; i < std::min(board.squares.size(), board.squares_seen.size()); ++i)
  {
    if (board.squares_seen[i])
    {
      drawCircle(canvas, board.squares[i], mark, color, canvas.thickness);
    }
  }
  for (std::size_t i = 0; i < std::min(board.inner_corners.size(), board.inner_corners_seen.size()); ++i)
  {
    drawInnerCorner(canvas, board.inner_corners[i], mark, board.inner_corners_seen[i]);
  }
  const auto& top = *std::min_element(board.corners.begin(), board.corners.end(),
                                      [](const cv::Point2f& a, const cv::Point2f& b) { return a.y < b.y; });
  drawText(canvas, sizeText(board), cv::Point2d(top) - cv::Point2d(0, 6 * canvas.scale), color);
}

/** Where a target's label begins: above its outer ring, so that it hides neither the rings nor a neighbour. */
cv::Point2d labelAnchor(const Target& target, double gap)
{
  const cv::Size2f outer = target.rings.empty() ? cv::Size2f() : target.rings.back().size;
  const double reach = 0.5 * std::max(outer.width, outer.height);
  return target.center - cv::Point2d(0.7 * reach, reach + gap);
}

void drawTarget(Canvas& canvas, const Target& target, std::size_t id)
{
  for (const cv::RotatedRect& ring : target.rings)
  {
    drawEllipse(canvas, ring, YELLOW);
  }
  const double radius = 5 * canvas.scale;
  drawCircle(canvas, target.center, radius, BLACK, 3 * canvas.thickness);
  drawCircle(canvas, target.center, radius, YELLOW, canvas.thickness);
  drawText(canvas, std::to_string(id) + ": " + target.colors, labelAnchor(target, radius), YELLOW);
}

void drawDashed(Canvas& canvas, const cv::Point2d& from, const cv::Point2d& to, const Color& color)
{
  const double dash = 5 * canvas.scale;
  const int count = std::max(1, cvRound(cv::norm(to - from) / dash));
  for (int i = 0; i < count; i += 2)
  {
    drawLine(canvas, from + (to - from) * i / count, from + (to - from) * std::min(i + 1, count) / count, color);
  }
}

/** Green where a marker was read. */
void drawCandidate(Canvas& canvas, const Candidate& candidate)
{
  const Color& color = candidate.read ? GREEN : RED;
  const cv::Point2d top_left = candidate.box.tl();
  const cv::Point2d bottom_right = candidate.box.br();
  const cv::Point2d top_right(bottom_right.x, top_left.y);
  const cv::Point2d bottom_left(top_left.x, bottom_right.y);
  drawDashed(canvas, top_left, top_right, color);
  drawDashed(canvas, top_right, bottom_right, color);
  drawDashed(canvas, bottom_right, bottom_left, color);
  drawDashed(canvas, bottom_left, top_left, color);
}

void checkInput(const cv::Mat& bgr, const RegionMap& regions)
{
  if (bgr.empty() || bgr.type() != CV_8UC3)
  {
    throw std::invalid_argument("expected an image of type CV_8UC3 that is not empty");
  }
  if (!regions.labels.empty() && (regions.labels.size() != bgr.size() || regions.labels.type() != CV_32SC1))
  {
    throw std::invalid_argument("the labels do not belong to this image");
  }
  if (!regions.edges.empty() && (regions.edges.size() != bgr.size() || regions.edges.type() != CV_8UC1))
  {
    throw std::invalid_argument("the edge mask does not belong to this image");
  }
}
}  // namespace

cv::Mat drawOverlay(const cv::Mat& bgr, const Markers& markers, const RegionMap& regions)
{
  checkInput(bgr, regions);
  Canvas canvas = makeCanvas(bgr.clone());
  if (!regions.labels.empty())
  {
    paintRegions(canvas.image, regions.labels, regions.edges);
  }
  for (const Candidate& candidate : markers.candidates)
  {
    drawCandidate(canvas, candidate);
  }
  for (std::size_t i = 0; i < markers.checkerboards.size(); ++i)
  {
    drawCheckerboard(canvas, markers.checkerboards[i], boardColor(i));
  }
  for (std::size_t i = 0; i < markers.targets.size(); ++i)
  {
    drawTarget(canvas, markers.targets[i], i);
  }
  return canvas.image;
}

}  // namespace omr
