#include "ink_rest.h"

#include <algorithm>

#include "targets/boundaries/blurred_disk.h"

namespace omr
{
namespace
{
// Relative to the white, as the light is by which they are seen.
constexpr double NOISE = .025;  // of what a pixel adds to the samples
constexpr double SPREAD = .07;  // of an ink
}  // namespace

InkRestPart::InkRestPart(const RaySamples& source, int part, double deviation, const std::vector<double>& radii)
{
  const auto count = static_cast<int>(source.samples.size());
  const auto size = static_cast<int>(radii.size()) + 1;
  cv::Mat_<double> shares(count, size);  // of each ring in each sample's light
  cv::Mat_<double> values(count, part + 1);
  for (int i = 0; i < count; ++i)
  {
    double inner = 0;
    for (int k = 0; k < size; ++k)
    {
      const double outer =
          k + 1 < size ? blurredDisk(i * source.step, radii[static_cast<std::size_t>(k)], source.scale * deviation) : 1;
      shares(i, k) = outer - inner;
      inner = outer;
    }
    for (int c = 0; c <= part; ++c)
    {
      values(i, c) = source.samples[i][part + c];
    }
  }
  const double level = std::max(1., source.white[0]);  // [grey levels]
  const double weight =
      source.step / source.scale / (NOISE * NOISE * level * level);  // of a sample: a pixel counts once
  const double prior = 1 / (SPREAD * SPREAD * level * level);
  const cv::Mat right = weight * shares.t() * values;
  const cv::Mat inverse =
      cv::Mat(weight * shares.t() * shares + prior * cv::Mat::eye(size, size, CV_64F)).inv(cv::DECOMP_CHOLESKY);
  squares = prior * cv::Mat::eye(size, size, CV_64F) - prior * prior * inverse;
  linear = prior * inverse * right;
  rest = weight * values.dot(values) - right.dot(inverse * right);
}

InkRest::InkRest(const InkRestPart& brightness, const InkRestPart& hue) : brightness_(brightness), hue_(hue)
{
}

std::vector<cv::Vec3d> InkRest::slopes(const std::vector<cv::Vec3d>& inks) const
{
  const auto size = static_cast<int>(inks.size());
  std::vector<cv::Vec3d> result(inks.size());
  for (int k = 0; k < size; ++k)
  {
    result[k] -= linear(k);
    for (int j = 0; j < size; ++j)
    {
      result[k] += inks[j].mul(square(k, j));
    }
  }
  return result;
}

double InkRest::of(const std::vector<cv::Vec3d>& inks) const
{
  double rest = brightness_.rest + hue_.rest;
  const std::vector<cv::Vec3d> slope = slopes(inks);
  for (std::size_t k = 0; k < inks.size(); ++k)
  {
    rest += inks[k].dot(slope[k] - linear(static_cast<int>(k)));
  }
  return rest;
}

cv::Vec3d InkRest::square(int k, int j) const
{
  return {brightness_.squares(k, j), hue_.squares(k, j), hue_.squares(k, j)};
}

cv::Vec3d InkRest::linear(int k) const
{
  return {brightness_.linear(k, 0), hue_.linear(k, 0), hue_.linear(k, 1)};
}

}  // namespace omr
