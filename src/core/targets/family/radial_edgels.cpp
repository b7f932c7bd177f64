#include "radial_edgels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bent_sheet.h"
#include "targets/edges/fast_angle.h"
#include "targets/edges/lane_list.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr double MIN_RADIUS = .8;  // of an edgel [px]
// Of the circle's box, which perspective widens.
constexpr double LEAST_MAGNIFICATION = 1.1;
constexpr double LEAST_NEARNESS = .2;
// Radial edgels for which there is memory at once: to let it grow took 2 % of the CPU time of noise.
constexpr double USUAL_SHARE = .05;  // of the pixels of the family's box
constexpr double MOST_USUAL = 65536;

/** Which edgels are radial: RingFamily::toPlane() and the gradient of the radius, without divisions. */
struct RadialTest
{
  RingFamily family;
  cv::Point2d top_left, bottom_right;  // of the edgels [px]
  double min_squared, max_squared;     // radius [px^2]
  double squared_cosine;
};

constexpr std::size_t CHUNK = BentSheet::CHUNK;

/** Of edgels side by side; garbage where is_radial is 0. The place on the plane is q / scale. */
struct RadialChunk
{
  std::array<double, CHUNK> squared;  // of q
  std::array<double, CHUNK> scale;
  std::array<float, CHUNK> qx, qy;
  std::array<int, CHUNK> brighter_outside;
  std::array<std::int32_t, CHUNK + LaneList::LANES> is_radial;  // -1 or 0
};

OMR_VECTORIZED void testEdgels(const RadialTest& test, const float* x, const float* y, const float* nx, const float* ny,
                               std::size_t size, RadialChunk& chunk)
{
  const RingFamily family = test.family;
  const double left = test.top_left.x;
  const double top = test.top_left.y;
  const double right = test.bottom_right.x;
  const double bottom = test.bottom_right.y;
  const double min_squared = test.min_squared;
  const double max_squared = test.max_squared;
  const double squared_cosine = test.squared_cosine;
  for (std::size_t i = 0; i < size; ++i)
  {
    const double dx = x[i] - family.center.x;
    const double dy = y[i] - family.center.y;
    const double m00 = family.a - dx * family.hx;
    const double m01 = family.b - dx * family.hy;
    const double m10 = family.b - dy * family.hx;
    const double m11 = family.d - dy * family.hy;
    const double det = m00 * m11 - m01 * m10;
    const double qx = m11 * dx - m01 * dy;
    const double qy = m00 * dy - m10 * dx;
    const double squared = qx * qx + qy * qy;
    const double det_squared = det * det;
    // The gradient of the radius, up to a positive factor.
    const double gx = m11 * qx - m10 * qy;
    const double gy = m00 * qy - m01 * qx;
    const double projection = gx * nx[i] + gy * ny[i];
    const bool in_box = (x[i] >= left) & (x[i] <= right) & (y[i] >= top) & (y[i] <= bottom);
    const bool in_reach = (squared <= max_squared * det_squared) & (squared >= min_squared * det_squared);
    const bool is_radial = projection * projection >= squared_cosine * (gx * gx + gy * gy);
    chunk.squared[i] = squared;
    chunk.scale[i] = det;
    chunk.qx[i] = static_cast<float>(qx);
    chunk.qy[i] = static_cast<float>(qy);
    chunk.brighter_outside[i] = projection > 0 ? 1 : 0;
    chunk.is_radial[i] = in_box & in_reach & is_radial ? -1 : 0;
  }
}

/** The same on a bent sheet, where no formula leads from the image to the plane. */
void testBentEdgels(const RadialTest& test, const float* x, const float* y, const float* nx, const float* ny,
                    std::size_t size, RadialChunk& chunk)
{
  RingFamily plane = test.family;
  plane.bend = {};
  BentSheet::Points image;
  BentSheet::Points q;
  BentSheet::Points gradient;
  std::array<std::size_t, CHUNK> inside;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    chunk.is_radial[i] = 0;
    if (x[i] >= test.top_left.x && x[i] < test.bottom_right.x && y[i] >= test.top_left.y && y[i] < test.bottom_right.y)
    {
      const cv::Point2d start = plane.toPlane(cv::Point2d(x[i], y[i]));
      image.x[count] = x[i];
      image.y[count] = y[i];
      q.x[count] = start.x;
      q.y[count] = start.y;
      inside[count++] = i;
    }
  }
  const BentSheet sheet(test.family);
  sheet.toPlane(image, count, q);
  sheet.gradients(q, count, gradient);
  for (std::size_t k = 0; k < count; ++k)
  {
    const std::size_t i = inside[k];
    const double squared = q.x[k] * q.x[k] + q.y[k] * q.y[k];
    const double projection = gradient.x[k] * nx[i] + gradient.y[k] * ny[i];
    const double slope = gradient.x[k] * gradient.x[k] + gradient.y[k] * gradient.y[k];
    chunk.squared[i] = squared;
    chunk.scale[i] = 1;
    chunk.qx[i] = static_cast<float>(q.x[k]);
    chunk.qy[i] = static_cast<float>(q.y[k]);
    chunk.brighter_outside[i] = projection > 0 ? 1 : 0;
    chunk.is_radial[i] = squared <= test.max_squared && squared >= test.min_squared &&
                                 projection * projection >= test.squared_cosine * slope
                             ? -1
                             : 0;
  }
}

/** @param degrees on the plane. */
AngleBins binsAt(float degrees, double radius)
{
  const double angle = degrees * (ANGLE_BINS / 360.);
  const double half = .6 / std::max(.6, radius) * (ANGLE_BINS / (2 * CV_PI));
  // Shifted by a turn, so that conversion rounds down.
  const int first = static_cast<int>(angle - half + ANGLE_BINS);
  const int last = static_cast<int>(angle + half + ANGLE_BINS);
  const AngleBins run = (AngleBins{2} << (last - first)) - 1;
  const int turn = first % ANGLE_BINS;
  return run << turn | run >> (-turn & (ANGLE_BINS - 1));
}

/** Whether the area lies beyond the circle: every third tile of a box around one does. */
bool liesBeyond(const RingFamily& family, double radius, const cv::Rect2d& area)
{
  if (family.isBent())
  {
    return false;
  }
  // The circle's image is convex: the gradient at a corner beyond it is the normal of a line that lies between.
  const cv::Point2d to_middle = family.radiusGradient(family.toPlane((area.tl() + area.br()) / 2));
  const cv::Point2d corner(to_middle.x > 0 ? area.x : area.br().x, to_middle.y > 0 ? area.y : area.br().y);
  const cv::Point2d q = family.toPlane(corner);
  const double squared = q.dot(q);
  const double horizon = squared * (family.hx * family.hx + family.hy * family.hy);  // is convex before
  const cv::Point2d gradient = family.radiusGradient(q);
  return squared > radius * radius && horizon < 1 && gradient.x * to_middle.x >= 0 && gradient.y * to_middle.y >= 0;
}

}  // namespace

void collectRadialEdgels(EdgelMap& map, const RingFamily& family, double max_radius, double min_cosine,
                         std::vector<RadialEdgel>& edgels)
{
  edgels.clear();
  const double nearness = 1 - std::hypot(family.hx, family.hy) * max_radius;  // of the point nearest to the horizon
  const double magnification = std::max(LEAST_MAGNIFICATION, 1 / std::max(LEAST_NEARNESS, nearness));
  const cv::Point2d half = family.halfBox(max_radius) * magnification + cv::Point2d(1, 1);
  edgels.reserve(static_cast<std::size_t>(std::min(MOST_USUAL, USUAL_SHARE * 4 * half.x * half.y)));
  const cv::Point2d top_left = family.center - half;
  const cv::Point2d bottom_right = family.center + half;
  const RadialTest test{
      family, top_left, bottom_right, MIN_RADIUS * MIN_RADIUS, max_radius * max_radius, min_cosine * min_cosine};
  const auto test_edgels = family.isBent() ? testBentEdgels : testEdgels;
  RadialChunk chunk;
  const auto may_reach = [&](const cv::Rect2d& area) { return !liesBeyond(family, max_radius, area); };
  map.visitWanted(top_left.x, top_left.y, bottom_right.x, bottom_right.y, may_reach, [&](const EdgelTile& tile) {
    for (std::size_t first = 0; first < tile.size(); first += CHUNK)
    {
      const float* x = tile.x() + first;
      const float* y = tile.y() + first;
      const std::size_t size = std::min(CHUNK, tile.size() - first);
      test_edgels(test, x, y, tile.nx() + first, tile.ny() + first, size, chunk);
      std::fill_n(chunk.is_radial.begin() + size, LaneList::LANES, 0);
      std::array<std::uint16_t, CHUNK + LaneList::LANES> radial;
      std::size_t count = 0;
      for (std::size_t i = 0; i < size; i += LaneList::LANES)
      {
        count += LaneList::write(LaneList::bitsOf(&chunk.is_radial[i]), static_cast<std::uint16_t>(i), &radial[count]);
      }
      for (std::size_t k = 0; k < count; ++k)
      {
        const std::size_t i = radial[k];
        // Few are radial: only theirs is worth a root and an angle.
        const auto radius = static_cast<float>(std::sqrt(chunk.squared[i]) / chunk.scale[i]);
        edgels.push_back({cv::Point2f(x[i], y[i]), radius, chunk.brighter_outside[i] != 0,
                          binsAt(fastAngle(chunk.qx[i], chunk.qy[i]), radius)});
      }
    }
  });
}

void keepDirections(AngleBins open, std::vector<RadialEdgel>& edgels)
{
  if (~open != 0)
  {
    for (RadialEdgel& edgel : edgels)
    {
      edgel.bins &= open;
    }
    edgels.erase(std::remove_if(edgels.begin(), edgels.end(), [](const RadialEdgel& edgel) { return edgel.bins == 0; }),
                 edgels.end());
  }
}

AngularSupport::AngularSupport(const std::vector<RadialEdgel>& edgels, double max_radius)
    : brighter_(static_cast<std::size_t>(max_radius / CELL) + 1), darker_(brighter_.size())
{
  for (const RadialEdgel& edgel : edgels)
  {
    const auto cell = std::min(brighter_.size() - 1, static_cast<std::size_t>(edgel.radius / CELL));
    (edgel.brighter_outside ? brighter_ : darker_)[cell] |= edgel.bins;
  }
}

std::pair<AngleBins, AngleBins> AngularSupport::apart(double radius, double tolerance) const
{
  const int cells = static_cast<int>(brighter_.size());
  AngleBins brighter = 0;
  AngleBins darker = 0;
  const int last = std::min(cells - 1, static_cast<int>((radius + tolerance) / CELL));
  for (int cell = std::max(0, static_cast<int>((radius - tolerance) / CELL)); cell <= last; ++cell)
  {
    brighter |= brighter_[cell];
    darker |= darker_[cell];
  }
  return {brighter, darker};
}

AngleBins AngularSupport::at(double radius, double tolerance) const
{
  const auto [brighter, darker] = apart(radius, tolerance);
  return countOf(brighter) > countOf(darker) ? brighter : darker;
}

AngleBins AngularSupport::either(double radius, double tolerance) const
{
  const auto [brighter, darker] = apart(radius, tolerance);
  return brighter | darker;
}

}  // namespace omr
