#include "boundary_arcs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lane_equations.h"
#include "median.h"
#include "ring_samples.h"
#include "vectorized.h"

namespace omr
{
namespace
{
// Half of the width over which an edge turns from one level to the other, as of inner corners [px].
constexpr double SOFTNESS = 1.85;
constexpr double MAX_REACH = 3;     // of the pixels to either side of an edge [px]; those farther off say nothing of it
constexpr double REACH_SHARE = .7;  // the same, of the narrower ring beside it
constexpr double ARC_LENGTH = 5;    // [px]
constexpr int MAX_ARCS = 80;        // of a circle
constexpr int MIN_ARCS = 8;
constexpr double MAX_HALF_LENGTH = 4;  // of the pixels along an arc [px]
constexpr double MAX_OFFSET = 1;       // [px]
constexpr int ROUNDS = 3;              // the first finds the levels only
constexpr int MIN_PIXELS = 8;
constexpr int MAX_PIXELS = 96;
constexpr int UNKNOWNS = 3;

/** Pixels beside an edge; 0 everywhere fills up the last ones. */
struct Pixels
{
  int count = 0;
  std::array<Lanes, MAX_PIXELS / LANES> is_pixel = {}, distance = {}, level = {};

  void add(double distance_to_edge, float light)
  {
    const int group = count / LANES;
    const int i = count % LANES;
    is_pixel[group][i] = 1;
    distance[group][i] = static_cast<float>(distance_to_edge);
    level[group][i] = light;
    ++count;
  }
};

/** Where a piece of a boundary is expected: a parabola. */
struct Place
{
  cv::Point2d middle, normal;
  double half_length = 0;  // [px]
  double bow = 0;          // that the boundary falls back from its tangent by, over the squared distance [1/px]
  double reach = 0;        // to either side [px]
};

/** Its level in the middle, half of the step outwards, and how far outside the place it is [px]. */
using Edge = cv::Vec<float, UNKNOWNS>;

struct Sums
{
  LaneEquations<UNKNOWNS> equations;
  Lanes lacking = {};  // squared
};

OMR_VECTORIZED void addUp(const Pixels& pixels, const Edge& edge, float per_softness, Sums& sums)
{
  const int groups = (pixels.count + LANES - 1) / LANES;
  for (int group = 0; group < groups; ++group)
  {
    std::array<Lanes, UNKNOWNS> by;  // each unknown
    Lanes rest;
    for (int i = 0; i < LANES; ++i)
    {
      const float x = clampToOne((pixels.distance[group][i] - edge[2]) * per_softness);
      const float xx = x * x;
      const float a = softEdge(x);
      const float weight = pixels.is_pixel[group][i];
      by[0][i] = weight;
      by[1][i] = a * weight;
      by[2][i] = edge[1] * per_softness * (-1.875F * weight) * (1 - xx) * (1 - xx);
      rest[i] = weight * (pixels.level[group][i] - edge[0] - edge[1] * a);
    }
    sums.equations.add(by, rest);
    for (int i = 0; i < LANES; ++i)
    {
      sums.lacking[i] += rest[i] * rest[i];
    }
  }
}

Pixels gather(const cv::Mat& bgr, const cv::Vec3f& channel, const Place& place)
{
  const cv::Point2d tangent(-place.normal.y, place.normal.x);
  const cv::Point2d half(std::abs(tangent.x) * place.half_length + std::abs(place.normal.x) * place.reach,
                         std::abs(tangent.y) * place.half_length + std::abs(place.normal.y) * place.reach);
  const cv::Point first(cvCeil(place.middle.x - half.x), cvCeil(place.middle.y - half.y));
  const cv::Point last(cvFloor(place.middle.x + half.x), cvFloor(place.middle.y + half.y));
  Pixels pixels;
  for (int y = std::max(0, first.y); y <= std::min(bgr.rows - 1, last.y); ++y)
  {
    const auto* row = bgr.ptr<cv::Vec3b>(y);
    for (int x = std::max(0, first.x); x <= std::min(bgr.cols - 1, last.x); ++x)
    {
      const cv::Point2d offset(x - place.middle.x, y - place.middle.y);
      const double along = offset.dot(tangent);
      const double distance = offset.dot(place.normal) + place.bow * along * along;
      if (std::abs(along) < place.half_length && std::abs(distance) < place.reach && pixels.count < MAX_PIXELS)
      {
        pixels.add(distance, channel.dot(cv::Vec3f(row[x])));
      }
    }
  }
  return pixels;
}

/** @return false where there is no edge near the place. */
bool fitEdge(const cv::Mat& bgr, const cv::Vec3f& channel, const Place& place, BoundaryArc& arc)
{
  constexpr double RIDGE = 1e-3;
  const Pixels pixels = gather(bgr, channel, place);
  if (pixels.count < MIN_PIXELS)
  {
    return false;
  }
  Edge edge;
  cv::Matx33d normal;
  for (int round = 0; round < ROUNDS; ++round)
  {
    Sums sums;
    addUp(pixels, edge, static_cast<float>(1 / SOFTNESS), sums);
    normal = sums.equations.normalMatrix(RIDGE);
    edge += Edge(normal.solve(sums.equations.rightSide(), cv::DECOMP_CHOLESKY));
    if (!(std::abs(edge[2]) < MAX_OFFSET))
    {
      return false;
    }
    arc.lacking = std::sqrt(total(sums.lacking) / pixels.count);
  }
  arc.position = place.middle + edge[2] * place.normal;
  arc.step = 2 * edge[1];
  arc.steepness = std::sqrt(1 / normal.inv(cv::DECOMP_CHOLESKY)(2, 2));
  arc.pixels = pixels.count;
  return true;
}

/** The mixture of B, G and R in which a boundary shows best: that of its step, but more of the grey, which compression
 * leaves sharp. Grey alone does not show a green ring beside a red one: centres of targets RMS 0.20 instead of 0.16 px
 * on the occlusion set. @param inner, outer radii of the rings' middles to either side [px]. */
cv::Vec3f channelOf(const cv::Mat& bgr, const RingFamily& family, double inner, double outer)
{
  constexpr int LOOKS = 32;
  constexpr float MORE_GREY = 3;
  const cv::Vec3f grey(GREY_WEIGHTS[0], GREY_WEIGHTS[1], GREY_WEIGHTS[2]);
  const cv::Rect image(cv::Point(), bgr.size());
  std::array<std::vector<float>, 3> steps;
  for (int i = 0; i < LOOKS; ++i)
  {
    const double phi = 2 * CV_PI * i / LOOKS;
    const cv::Point2d direction(std::cos(phi), std::sin(phi));
    const cv::Point inside = family.toImage(inner * direction);
    const cv::Point outside = family.toImage(outer * direction);
    if (image.contains(inside) && image.contains(outside))
    {
      const cv::Vec3f step = cv::Vec3f(bgr.at<cv::Vec3b>(outside)) - cv::Vec3f(bgr.at<cv::Vec3b>(inside));
      for (int c = 0; c < 3; ++c)
      {
        steps[c].push_back(step[c]);
      }
    }
  }
  if (steps[0].empty())
  {
    return grey;
  }
  const cv::Vec3f step(median(steps[0]), median(steps[1]), median(steps[2]));
  const cv::Vec3f channel = step + MORE_GREY * step.dot(grey) * grey;
  return channel * (1 / std::max(1e-6, cv::norm(channel)));
}
}  // namespace

std::vector<BoundaryArc> measureArcs(const cv::Mat& bgr, const RingFamily& family, const std::vector<double>& radii)
{
  std::vector<BoundaryArc> arcs;
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const double radius = radii[k];
    const double inside = radius - (k > 0 ? radii[k - 1] : 0);
    const double width = k + 1 < radii.size() ? std::min(inside, radii[k + 1] - radius) : inside;
    const cv::Vec3f channel = channelOf(bgr, family, radius - width / 2, radius + width / 2);
    const int count = std::clamp(cvRound(2 * CV_PI * radius / ARC_LENGTH), MIN_ARCS, MAX_ARCS);
    const auto on_circle = [&](double number) {
      const double phi = 2 * CV_PI * number / count;
      return cv::Point2d(std::cos(phi), std::sin(phi)) * radius;
    };
    for (int i = 0; i < count; ++i)
    {
      const cv::Point2d q = on_circle(i + .5);
      const cv::Point2d gradient = family.radiusGradient(q);
      const cv::Point2d from = family.toImage(on_circle(i));
      const cv::Point2d to = family.toImage(on_circle(i + 1));
      const double half_chord = cv::norm(to - from) / 2;
      Place place;
      place.middle = family.toImage(q);
      place.normal = gradient / cv::norm(gradient);
      place.half_length = std::min(half_chord, MAX_HALF_LENGTH);
      place.bow = (place.middle - (from + to) / 2).dot(place.normal) / (half_chord * half_chord);
      place.reach = std::min(MAX_REACH, REACH_SHARE * width / cv::norm(gradient));
      BoundaryArc arc;
      arc.ring = static_cast<int>(k);
      arc.turn = (i + .5) / count;
      if (fitEdge(bgr, channel, place, arc))
      {
        arcs.push_back(arc);
      }
    }
  }
  return arcs;
}

}  // namespace omr
