#include "corner_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lane_equations.h"
#include "vectorized.h"

namespace omr
{
namespace
{
// Of the square, to each side. Beyond the middle the same edges serve the neighbours as well, which measures squares of
// 3 to 20 px better than half a square does: RMS 0.058 instead of 0.081 px.
constexpr float REACH_SHARE = 0.75F;
constexpr float MAX_REACH = 12;  // px; 16: 0.026 instead of 0.028 in the sun, 0.075 instead of 0.064 under hard shadow
// Half of the width over which an edge turns from dark to light [px]. Sharp pictures have this. Fitted to each corner
// it gains nothing: it must be near only, since an error of it moves both sides of an edge alike.
constexpr float SOFTNESS = 1.85F;
constexpr float BAND = 2.5F;      // of pixels along the edges [softness]; those farther off say nothing of the position
constexpr float MAX_MOVE = 0.3F;  // squares
constexpr int ROUNDS = 5;         // the first finds the grey values only; 4 are too few under hard shadow
// From this round on pixels that the picture lacks much at count less (Tukey): those of what covers a part of the
// corner, or of a shadow's edge. Their limit: the contrast of the squares, and what noise there is. RMS 0.064 instead
// of 0.072 px where things cover parts of boards, 0.058 instead of 0.064 under hard shadow; earlier, blurred ones
// suffer.
constexpr int FIRST_ROBUST = 3;
constexpr float LIMIT = 2;           // of the difference between opposite quadrants and the others
constexpr float LEAST_LIMIT = 8;     // grey levels, added to it
constexpr float LEAST_CONTRAST = 1;  // grey levels
constexpr int UNKNOWNS = 6;
constexpr int MAX_PIXELS = 640;  // 25 x 25, rounded up to LANES

/** Pixels around a corner; 0 everywhere fills up the last ones. */
struct Pixels
{
  Lanes is_pixel = {};
  Lanes u = {}, v = {};  // distances from the lattice lines through the given corner [softness]
  Lanes grey = {};
};

struct Window
{
  int count = 0;
  std::array<Pixels, MAX_PIXELS / LANES> pixels;
};

/** How the picture has to change: by its grey values - the mean, the step across either edge, and what opposite
 * quadrants differ by from the others - and by a move along u and v [softness]. */
using Unknowns = cv::Vec<float, UNKNOWNS>;

struct Sums
{
  LaneEquations<UNKNOWNS> equations;
  Lanes lacking = {};  // squared
};

/** Adds up the equations of the picture as it is. @param per_limit 1 / grey levels that a pixel of weight 0 lacks. */
OMR_VECTORIZED void addUp(const Window& window, const Unknowns& picture, float per_limit, Sums& sums)
{
  const int groups = (window.count + LANES - 1) / LANES;
  for (int group = 0; group < groups; ++group)
  {
    const Pixels& pixels = window.pixels[group];
    std::array<Lanes, UNKNOWNS> by;  // each unknown
    Lanes rest;
    Lanes squared;
    for (int i = 0; i < LANES; ++i)
    {
      const float x = clampToOne(pixels.u[i] - picture[4]);
      const float y = clampToOne(pixels.v[i] - picture[5]);
      const float xx = x * x;
      const float yy = y * y;
      const float a = softEdge(x);
      const float b = softEdge(y);
      const float lacking = pixels.grey[i] - picture[0] - picture[1] * a - (picture[2] + picture[3] * a) * b;
      const float share = lacking * per_limit;
      const float inside = 1 - share * share;
      const float weight = pixels.is_pixel[i] * 0.5F * (inside + std::abs(inside));  // root of Tukey's
      squared[i] = pixels.is_pixel[i] * lacking * lacking;
      by[0][i] = weight;
      by[1][i] = a * weight;
      by[2][i] = b * weight;
      by[3][i] = a * b * weight;
      by[4][i] = (picture[1] + picture[3] * b) * (-1.875F * weight) * (1 - xx) * (1 - xx);
      by[5][i] = (picture[2] + picture[3] * a) * (-1.875F * weight) * (1 - yy) * (1 - yy);
      rest[i] = lacking * weight;
    }
    sums.equations.add(by, rest);
    for (int i = 0; i < LANES; ++i)
    {
      sums.lacking[i] += squared[i];
    }
  }
}

/** The change by least squares over all pixels; a picture without edges does not move. @param lacking receives the RMS
 * of what the picture lacked before it [grey levels]. */
Unknowns changeOf(const Window& window, const Unknowns& picture, float per_limit, float& lacking)
{
  constexpr float RIDGE = 1e-3F;
  Sums sums;
  addUp(window, picture, per_limit, sums);
  lacking = std::sqrt(total(sums.lacking) / static_cast<float>(std::max(1, window.count)));
  return sums.equations.normalMatrix(RIDGE).solve(sums.equations.rightSide(), cv::DECOMP_CHOLESKY);
}

/** The pixels along both edges. @param across_u, across_v gradients of the distances from the lines [softness / px].
 * @param reach_u, reach_v the largest distances [softness]. */
void gather(const cv::Mat& grey, const cv::Rect& box, const cv::Point2f& corner, const cv::Point2f& across_u,
            const cv::Point2f& across_v, float reach_u, float reach_v, Window& window)
{
  for (int y = box.y; y < box.br().y; ++y)
  {
    const auto* row = grey.ptr<uchar>(y);
    for (int x = box.x; x < box.br().x; ++x)
    {
      const cv::Point2f offset(static_cast<float>(x) - corner.x, static_cast<float>(y) - corner.y);
      const float u = across_u.dot(offset);
      const float v = across_v.dot(offset);
      const bool outside = std::abs(u) > reach_u || std::abs(v) > reach_v;
      const bool off_the_edges = std::abs(u) > BAND && std::abs(v) > BAND;
      if (outside || off_the_edges || window.count == MAX_PIXELS)
      {
        continue;
      }
      Pixels& pixels = window.pixels[window.count / LANES];
      const int i = window.count % LANES;
      pixels.is_pixel[i] = 1;
      pixels.u[i] = u;
      pixels.v[i] = v;
      pixels.grey[i] = row[x];
      ++window.count;
    }
  }
}
}  // namespace

CornerFit fitCorner(const cv::Mat& grey, const LocalFrame& corner)
{
  const float area = cross(corner.u, corner.v);
  if (area == 0)
  {
    return {corner.node};
  }
  const float share_u = std::min(REACH_SHARE, MAX_REACH / length(corner.u));
  const float share_v = std::min(REACH_SHARE, MAX_REACH / length(corner.v));
  const int width = cvCeil(std::abs(corner.u.x) * share_u + std::abs(corner.v.x) * share_v);
  const int height = cvCeil(std::abs(corner.u.y) * share_u + std::abs(corner.v.y) * share_v);
  const cv::Rect box(cvRound(corner.node.x) - width, cvRound(corner.node.y) - height, 2 * width + 1, 2 * height + 1);
  if ((box & cv::Rect({0, 0}, grey.size())) != box)
  {
    return {corner.node};
  }
  const float square_u = std::abs(area) / length(corner.v) / SOFTNESS;
  const float square_v = std::abs(area) / length(corner.u) / SOFTNESS;
  const cv::Point2f across_u = cv::Point2f(corner.v.y, -corner.v.x) * (square_u / area);
  const cv::Point2f across_v = cv::Point2f(-corner.u.y, corner.u.x) * (square_v / area);
  Window window;
  gather(grey, box, corner.node, across_u, across_v, share_u * square_u, share_v * square_v, window);
  Unknowns picture;
  float lacking = 0;
  for (int round = 0; round < ROUNDS; ++round)
  {
    const float limit = LIMIT * std::abs(picture[3]) + LEAST_LIMIT;
    const float per_limit = round < FIRST_ROBUST ? 0 : 1 / limit;
    picture += changeOf(window, picture, per_limit, lacking);
    if (!(std::max(std::abs(picture[4]), std::abs(picture[5])) < MAX_MOVE * std::min(square_u, square_v)))
    {
      return {corner.node};
    }
  }
  const float contrast = std::max(LEAST_CONTRAST, std::abs(picture[3]));
  const float step = std::max({LEAST_CONTRAST, std::abs(picture[1]), std::abs(picture[2])});
  return {corner.at(picture[4] / square_u, picture[5] / square_v), lacking / contrast, contrast / step, 2 * picture[3]};
}

}  // namespace omr
