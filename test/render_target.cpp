#include "render_target.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace
{
constexpr int SUPERSAMPLING = 4;
const cv::Vec3d SKIN = {.2, .35, .6};

cv::Vec3d reflectance(char letter)
{
  switch (letter)
  {
    case 'W':
      return {1, 1, 1};
    case 'P':
      return {.07, .07, .07};
    case 'R':
      return {.06, .06, .66};
    case 'G':
      return {.1, .33, .05};
    case 'B':
      return {.38, .09, .06};
    default:
      throw std::invalid_argument("no such colour");
  }
}

double toGrey(double linear)
{
  const double value = std::min(1., std::max(0., linear));
  return 255 * (value <= .0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - .055);
}

/** The sheet's point that a camera far away sees at a point of the plane. */
cv::Point2d onSheet(const TargetScene& scene, const cv::Point2d& q)
{
  if (scene.bend == 0)
  {
    return q;
  }
  const double sine = std::min(.99, std::max(-.99, scene.bend * q.x));
  const double depth = (1 - std::sqrt(1 - sine * sine)) / scene.bend;
  return {std::asin(sine) / scene.bend, (q.y - depth * std::sin(scene.bend_tilt)) / std::cos(scene.bend_tilt)};
}

cv::Vec3d surface(const TargetScene& scene, const cv::Point2d& seen, cv::RNG& random)
{
  const cv::Point2d q = onSheet(scene, seen);
  const double r = std::hypot(q.x, q.y);
  if (scene.occluder > 0 && q.x > scene.radii.back() * (1 - 2 * scene.occluder))
  {
    return SKIN;
  }
  if (std::hypot(q.x - scene.cover_offset.x, q.y - scene.cover_offset.y) < scene.cover)
  {
    return SKIN;
  }
  for (std::size_t k = 0; k < scene.radii.size(); ++k)
  {
    if (r < scene.radii[k])
    {
      return reflectance(scene.colors[k]);
    }
  }
  if (std::max(std::abs(q.x), std::abs(q.y)) < scene.sheet_half_side)
  {
    return {1, 1, 1};
  }
  return scene.ground * std::max(0., 1 + random.gaussian(scene.texture));
}
}  // namespace

cv::Matx33d tiltedView(const cv::Point2d& center, double tilt, double direction, double scale, double focal)
{
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  const cv::Matx33d turn(c, -s, 0, s, c, 0, 0, 0, 1);
  const cv::Matx33d view(scale * std::cos(tilt), 0, 0, 0, scale, 0, scale * std::sin(tilt) / focal, 0, 1);
  const cv::Matx33d shift(1, 0, center.x, 0, 1, center.y, 0, 0, 1);
  return shift * turn * view * turn.t();
}

cv::Mat renderTarget(const TargetScene& scene)
{
  cv::RNG random(scene.seed);
  const cv::Matx33d inverse = scene.homography.inv();
  const cv::Point2d center = projectedCenter(scene);
  cv::Mat fine(scene.size * SUPERSAMPLING, CV_32FC3);
  for (int y = 0; y < fine.rows; ++y)
  {
    for (int x = 0; x < fine.cols; ++x)
    {
      // The centre of the top-left pixel is (0, 0).
      const cv::Point2d p((x + .5) / SUPERSAMPLING - .5, (y + .5) / SUPERSAMPLING - .5);
      const cv::Vec3d q = inverse * cv::Vec3d(p.x, p.y, 1);
      double light = scene.light * (1 + scene.gradient * (p.x / scene.size.width - .5));
      const double behind = (p.x - center.x - scene.shadow_offset) + .4 * (p.y - center.y);
      light *= behind > 0 && behind < scene.shadow_width ? scene.shadow : 1;
      const cv::Point2d from_gloss = p - center - scene.gloss_offset;
      const double added = scene.veil + scene.gloss * std::exp(-from_gloss.dot(from_gloss) /
                                                               (2 * scene.gloss_radius * scene.gloss_radius));
      const cv::Vec3d color =
          surface(scene, cv::Point2d(q[0] / q[2], q[1] / q[2]), random).mul(scene.tint) * light + cv::Vec3d::all(added);
      fine.at<cv::Vec3f>(y, x) = cv::Vec3f(color);
    }
  }
  if (scene.blur > 0)
  {
    cv::GaussianBlur(fine, fine, cv::Size(), scene.blur * SUPERSAMPLING);
  }
  cv::Mat linear;
  cv::resize(fine, linear, scene.size, 0, 0, cv::INTER_AREA);
  cv::Mat image(scene.size, CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        image.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<uchar>(toGrey(linear.at<cv::Vec3f>(y, x)[c]) + random.gaussian(scene.noise));
      }
    }
  }
  return image;
}

cv::Point2d projectedCenter(const TargetScene& scene)
{
  const cv::Vec3d p = scene.homography * cv::Vec3d(0, 0, 1);
  return {p[0] / p[2], p[1] / p[2]};
}
