#include "bent_sheet.h"

#include <algorithm>
#include <cmath>

#include "bent_point.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int STEPS = 8;            // of Newton's method
constexpr double CONVERGED = 1e-3;  // [px]; what is left after so small a step is its square
constexpr double SMALLEST_GRADIENT = 1e-6;
constexpr double SMALLEST_RADIUS = 1e-6;

/** Of an angle. */
struct Turn
{
  double sine;
  double shortening;  // 1 - cosine, exact for the smallest angles
};

/** Taylor's series, exact to the last digits up to BentPoint::LARGEST_ANGLE: the library's take one value at a time. */
inline Turn turn(double angle)
{
  constexpr std::array<double, 9> SINE = {1. / 6,
                                          1. / 120,
                                          1. / 5040,
                                          1. / 362880,
                                          1. / 39916800,
                                          1. / 6227020800,
                                          1. / 1307674368000,
                                          1. / 355687428096000,
                                          1. / 121645100408832000};
  constexpr std::array<double, 9> COSINE = {1. / 12,
                                            1. / 360,
                                            1. / 20160,
                                            1. / 1814400,
                                            1. / 239500800,
                                            1. / 43589145600,
                                            1. / 10461394944000,
                                            1. / 3201186852864000,
                                            1. / 1216451004088320000};
  const double squared = angle * angle;
  double sine = SINE.back();
  double cosine = COSINE.back();
  for (int i = static_cast<int>(SINE.size()) - 2; i >= 0; --i)
  {
    sine = SINE[i] - squared * sine;
    cosine = COSINE[i] - squared * cosine;
  }
  return {angle - angle * squared * sine, .5 * squared * (1 - squared * cosine)};
}

using Sheet = BentSheet::Numbers;

/** BentPoint's, without vectors. */
struct Place
{
  double u, angle;        // across the axis [px], of the bend there
  Turn turn;              // by that angle
  double move;            // towards the axis [px]
  double sx, sy, z, w;    // see BentPoint
  double ox, oy;          // the image's offset
  double xs, xt, ys, yt;  // the offset's derivatives by s,
  double xz, yz;          // by z,
  double xx, xy, yx, yy;  // and by the place
};

inline Place placeAt(const Sheet& f, double qx, double qy)
{
  Place p;
  p.u = qx * f.ex + qy * f.ey;
  const double angle = f.curvature * p.u;
  const double bounded = angle < BentPoint::LARGEST_ANGLE ? angle : BentPoint::LARGEST_ANGLE;
  p.angle = bounded > -BentPoint::LARGEST_ANGLE ? bounded : -BentPoint::LARGEST_ANGLE;
  p.turn = turn(p.angle);
  const double rest = p.u - p.angle / f.curvature;
  const double cosine = 1 - p.turn.shortening;
  p.move = p.turn.sine / f.curvature + cosine * rest - p.u;
  p.sx = qx + p.move * f.ex;
  p.sy = qy + p.move * f.ey;
  p.z = p.turn.shortening / f.curvature + p.turn.sine * rest;
  p.w = 1 + f.hx * p.sx + f.hy * p.sy + f.hz * p.z;
  const double inverse = 1 / p.w;
  p.ox = (f.a * p.sx + f.b * p.sy + p.z * f.nx) * inverse;
  p.oy = (f.b * p.sx + f.d * p.sy + p.z * f.ny) * inverse;
  p.xs = (f.a - p.ox * f.hx) * inverse;
  p.xt = (f.b - p.ox * f.hy) * inverse;
  p.ys = (f.b - p.oy * f.hx) * inverse;
  p.yt = (f.d - p.oy * f.hy) * inverse;
  p.xz = (f.nx - p.ox * f.hz) * inverse;
  p.yz = (f.ny - p.oy * f.hz) * inverse;
  // Along the axis s goes with q; across it by the cosine, and z by the sine.
  const double x_across = p.turn.sine * p.xz - p.turn.shortening * (p.xs * f.ex + p.xt * f.ey);
  const double y_across = p.turn.sine * p.yz - p.turn.shortening * (p.ys * f.ex + p.yt * f.ey);
  p.xx = p.xs + x_across * f.ex;
  p.xy = p.xt + x_across * f.ey;
  p.yx = p.ys + y_across * f.ex;
  p.yy = p.yt + y_across * f.ey;
  return p;
}

/** Gradient of the radius. */
struct Gradient
{
  double x, y;
};

inline Gradient gradientAt(const Place& p, double qx, double qy)
{
  const double radius = std::sqrt(qx * qx + qy * qy);
  const double scale = 1 / ((p.xx * p.yy - p.xy * p.yx) * (radius > SMALLEST_RADIUS ? radius : SMALLEST_RADIUS));
  return {scale * (p.yy * qx - p.yx * qy), scale * (p.xx * qy - p.xy * qx)};
}

OMR_VECTORIZED void imagesOf(const Sheet& sheet, const double* qx, const double* qy, std::size_t size, double* x,
                             double* y)
{
  const Sheet f = sheet;
  for (std::size_t i = 0; i < size; ++i)
  {
    const Place place = placeAt(f, qx[i], qy[i]);
    x[i] = place.ox;
    y[i] = place.oy;
  }
}

/** A step of Newton's method. @param open is 0 where it has converged. @return whether it has everywhere. */
OMR_VECTORIZED bool approach(const Sheet& sheet, const double* x, const double* y, std::size_t size, double* qx,
                             double* qy, double* open)
{
  const Sheet f = sheet;
  const double longest = .5 / f.curvature;  // half a curvature's radius: the next place is linear so far
  double left = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const Place p = placeAt(f, qx[i], qy[i]);
    const double inverse = 1 / (p.xx * p.yy - p.xy * p.yx);
    const double dx = x[i] - p.ox;
    const double dy = y[i] - p.oy;
    const double change_x = (p.yy * dx - p.xy * dy) * inverse;
    const double change_y = (p.xx * dy - p.yx * dx) * inverse;
    const double length = std::sqrt(change_x * change_x + change_y * change_y);
    const double share = length > longest ? longest / length : 1;
    qx[i] += open[i] != 0 ? share * change_x : 0;
    qy[i] += open[i] != 0 ? share * change_y : 0;
    open[i] = length < CONVERGED ? 0 : open[i];
  }
  for (std::size_t i = 0; i < size; ++i)
  {
    left += open[i];
  }
  return left == 0;
}

OMR_VECTORIZED void gradientsAt(const Sheet& sheet, const double* qx, const double* qy, std::size_t size, double* x,
                                double* y)
{
  const Sheet f = sheet;
  for (std::size_t i = 0; i < size; ++i)
  {
    const Gradient gradient = gradientAt(placeAt(f, qx[i], qy[i]), qx[i], qy[i]);
    x[i] = gradient.x;
    y[i] = gradient.y;
  }
}

OMR_VECTORIZED void differentiateAt(const Sheet& sheet, const double* qx, const double* qy, std::size_t size,
                                    BentSheet::Derivatives& derivatives)
{
  const Sheet f = sheet;
  for (std::size_t i = 0; i < size; ++i)
  {
    const Place p = placeAt(f, qx[i], qy[i]);
    const Gradient gradient = gradientAt(p, qx[i], qy[i]);
    const double length = std::sqrt(gradient.x * gradient.x + gradient.y * gradient.y);
    // Where the image of the circle moves outwards, the distance falls.
    const double scale = -1 / (length > SMALLEST_GRADIENT ? length : SMALLEST_GRADIENT);
    const double gx = scale * gradient.x;
    const double gy = scale * gradient.y;
    const double inverse = 1 / p.w;
    const double sx = inverse * p.sx;
    const double sy = inverse * p.sy;
    const double z = inverse * p.z;
    const double along = gx * p.ox + gy * p.oy;
    derivatives[0][i] = gx;
    derivatives[1][i] = gy;
    derivatives[2][i] = gx * sx;
    derivatives[3][i] = gx * sy + gy * sx;
    derivatives[4][i] = gy * sy;
    derivatives[5][i] = -sx * along;
    derivatives[6][i] = -sy * along;
    // The bend's length bends the sheet more, its direction turns the axis.
    const double by_x = gx * p.xs + gy * p.ys;  // by s
    const double by_y = gx * p.xt + gy * p.yt;
    const double by_z = gx * p.xz + gy * p.yz;
    const double by_across = by_x * f.ex + by_y * f.ey;
    const double by_along = by_y * f.ex - by_x * f.ey;
    const double radius = 1 / f.curvature;
    const double cosine = 1 - p.turn.shortening;
    const double by_length =
        radius * radius *
        (by_across * (p.angle * cosine - p.turn.sine) + by_z * (p.angle * p.turn.sine - p.turn.shortening));
    const double v = qy[i] * f.ex - qx[i] * f.ey;  // along the axis
    const double by_turn = radius * (p.move * by_along + v * (by_z * p.turn.sine - by_across * p.turn.shortening));
    derivatives[7][i] = by_length * f.ex - by_turn * f.ey;
    derivatives[8][i] = by_length * f.ey + by_turn * f.ex;
    derivatives[9][i] = gx * z;
    derivatives[10][i] = gy * z;
    derivatives[11][i] = -z * along;
    derivatives[BENT_UNKNOWNS][i] = scale;
  }
}
}  // namespace

BentSheet::BentSheet(const RingFamily& family) : center_(family.center)
{
  const double curvature = std::hypot(family.bend.x, family.bend.y);
  numbers_ = {family.a,
              family.b,
              family.d,
              family.hx,
              family.hy,
              family.hz,
              family.normal.x,
              family.normal.y,
              curvature,
              family.bend.x / curvature,
              family.bend.y / curvature};
}

void BentSheet::toImage(const Points& places, std::size_t size, Points& image) const
{
  imagesOf(numbers_, places.x.data(), places.y.data(), size, image.x.data(), image.y.data());
  for (std::size_t i = 0; i < size; ++i)
  {
    image.x[i] += center_.x;
    image.y[i] += center_.y;
  }
}

void BentSheet::toPlane(const Points& image, std::size_t size, Points& places) const
{
  Points offsets;
  Values open;
  for (std::size_t i = 0; i < size; ++i)
  {
    offsets.x[i] = image.x[i] - center_.x;
    offsets.y[i] = image.y[i] - center_.y;
    open[i] = 1;
  }
  for (int step = 0; step < STEPS; ++step)
  {
    if (approach(numbers_, offsets.x.data(), offsets.y.data(), size, places.x.data(), places.y.data(), open.data()))
    {
      break;
    }
  }
}

void BentSheet::gradients(const Points& places, std::size_t size, Points& gradients) const
{
  gradientsAt(numbers_, places.x.data(), places.y.data(), size, gradients.x.data(), gradients.y.data());
}

void BentSheet::differentiate(const Points& places, std::size_t size, Derivatives& derivatives) const
{
  differentiateAt(numbers_, places.x.data(), places.y.data(), size, derivatives);
}

}  // namespace omr
