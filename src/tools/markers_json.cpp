#include "markers_json.h"

#include <cmath>

namespace omr
{
namespace
{
using Json = nlohmann::ordered_json;

/** @param parts of a pixel: a thousandth is far below the accuracy of a corner (0.05 px). */
double rounded(double value, double parts = 1000)
{
  return std::round(value * parts) / parts;
}

template <typename Point>
Json toJson(const Point& point)
{
  return Json::array({rounded(point.x), rounded(point.y)});
}

template <typename Points>
Json toJsonArray(const Points& points)
{
  Json array = Json::array();
  for (const auto& point : points)
  {
    array.push_back(toJson(point));
  }
  return array;
}

Json toJson(const Checkerboard& board)
{
  return {{"rows", board.rows},
          {"cols", board.cols},
          {"inner_corners", toJsonArray(board.inner_corners)},
          {"inner_corners_seen", board.inner_corners_seen},
          {"corners", toJsonArray(board.corners)},
          {"squares_seen", board.squares_seen},
          {"regularity", rounded(board.regularity)},
          {"size_certain", board.size_certain}};
}

Json toJson(const cv::RotatedRect& ellipse)
{
  return {{"center", toJson(ellipse.center)},
          {"axes", Json::array({rounded(ellipse.size.width), rounded(ellipse.size.height)})},
          {"angle", rounded(ellipse.angle)}};
}

Json toJson(const Target& target)
{
  Json rings = Json::array();
  for (const cv::RotatedRect& ring : target.rings)
  {
    rings.push_back(toJson(ring));
  }
  return {{"colors", target.colors},
          {"center", toJson(target.center)},
          {"rings", rings},
          {"outermost_deviation", rounded(target.outermost_deviation, 1e4)}};
}

Json toJson(const Candidate& candidate)
{
  return {{"kind", candidate.kind == MarkerKind::checkerboard ? "checkerboard" : "target"},
          {"box", {candidate.box.x, candidate.box.y, candidate.box.width, candidate.box.height}},
          {"score", rounded(candidate.score)},
          {"cell", candidate.cell},
          {"windows", candidate.windows},
          {"read", candidate.read}};
}
}  // namespace

Json toJson(const std::string& image, const cv::Size& size, double milliseconds, const Markers& markers)
{
  Json steps = Json::object();
  for (const StepTime& time : markers.times)
  {
    steps[time.step] = rounded(time.milliseconds);
  }
  Json checkerboards = Json::array();
  for (const Checkerboard& board : markers.checkerboards)
  {
    checkerboards.push_back(toJson(board));
  }
  Json sections = Json::array();
  for (const Checkerboard& section : markers.sections)
  {
    sections.push_back(toJson(section));
  }
  Json targets = Json::array();
  for (const Target& target : markers.targets)
  {
    targets.push_back(toJson(target));
  }
  Json candidates = Json::array();
  for (const Candidate& candidate : markers.candidates)
  {
    candidates.push_back(toJson(candidate));
  }
  return {{"image", image},          {"width", size.width},
          {"height", size.height},   {"time_ms", rounded(milliseconds)},
          {"steps_ms", steps},       {"checkerboards", checkerboards},
          {"sections", sections},    {"targets", targets},
          {"candidates", candidates}};
}

}  // namespace omr
