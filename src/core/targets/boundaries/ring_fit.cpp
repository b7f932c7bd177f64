#include "ring_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "blurred_disk.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr std::array<double, 2> USUAL_BLUR = {1, 2};  // deviation, of brightness and hue [px]
// Sharp and soft lenses have others: in "distance" 362 instead of 359 letters are right. It takes half of the mean
// square that the usual blur leaves to prefer them: with .7 hues are sharpened that are even.
constexpr std::array<double, 3> FACTORS = {1, .6, 1.4};
constexpr double WORTH = .5;
constexpr double PRIOR = .05;  // weight of the ring's blurred colour, in samples

constexpr std::size_t LANES = 4;  // rows of the equations are as long as vectors like

/** Adds the products of a row with itself and with its values to the normal equations. */
OMR_VECTORIZED void addRow(const double* row, std::size_t size, std::size_t stride, const cv::Vec2d& values,
                           double* normal, cv::Vec2d* right)
{
  for (std::size_t a = 0; a < size; ++a)
  {
    const double factor = row[a];
    double* sums = normal + a * stride;
    for (std::size_t b = 0; b < stride; ++b)
    {
      sums[b] += factor * row[b];
    }
    right[a] += factor * values;
  }
}
}  // namespace

RingFit::RingFit(const std::vector<cv::Vec3d>& samples, double step, const std::vector<double>& radii)
    : samples_(samples), step_(step), radii_(radii), disks_(radii.size())
{
  findBlur(false);
  findBlur(true);
}

/** Takes the deviation that fits best, and blurs the disks with it. */
void RingFit::findBlur(bool is_hue)
{
  const std::size_t part = is_hue ? 1 : 0;
  std::vector<cv::Vec3d> colors(radii_.size() + 1);
  std::vector<Blurred> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double factor : FACTORS)
  {
    const double deviation = factor * USUAL_BLUR[part];
    for (std::size_t k = 0; k < radii_.size(); ++k)
    {
      disks_[k][part] = blur(radii_[k], deviation);
    }
    const double rest = fitPart(is_hue, colors) / (factor == 1 ? 1 : WORTH);
    if (rest < least)
    {
      least = rest;
      deviations_[part] = deviation;
      best = disks_;
    }
  }
  disks_ = best;
}

void RingFit::insert(std::size_t k, double radius)
{
  radii_.insert(radii_.begin() + static_cast<std::ptrdiff_t>(k), radius);
  disks_.insert(disks_.begin() + static_cast<std::ptrdiff_t>(k),
                {blur(radius, deviations_[0]), blur(radius, deviations_[1])});
}

void RingFit::erase(std::size_t k)
{
  radii_.erase(radii_.begin() + static_cast<std::ptrdiff_t>(k));
  disks_.erase(disks_.begin() + static_cast<std::ptrdiff_t>(k));
}

RingFit::Result RingFit::fit()
{
  Result result;
  result.colors.resize(radii_.size() + 1);
  result.rms = std::sqrt(fitPart(false, result.colors) + fitPart(true, result.colors));
  return result;
}

std::vector<double> RingFit::blur(double radius, double deviation) const
{
  std::vector<double> disk;
  for (std::size_t i = 0; i < samples_.size(); ++i)
  {
    disk.push_back(blurredDisk(static_cast<double>(i) * step_, radius, deviation));
  }
  return disk;
}

cv::Vec2d RingFit::value(std::size_t sample, bool is_hue) const
{
  const cv::Vec3d& color = samples_[sample];
  return is_hue ? cv::Vec2d(color[1], color[2]) : cv::Vec2d(color[0], 0);
}

/** @return mean square of what is left. */
double RingFit::fitPart(bool is_hue, std::vector<cv::Vec3d>& colors)
{
  const std::size_t size = radii_.size() + 1;
  const std::size_t stride = (size + LANES - 1) / LANES * LANES;
  shares_.assign(samples_.size() * stride, 0);
  normal_.assign(size * stride, 0);
  right_.assign(size, cv::Vec2d());
  for (std::size_t i = 0; i < samples_.size(); ++i)
  {
    double* row = &shares_[i * stride];
    double inner = 0;
    for (std::size_t k = 0; k < size; ++k)
    {
      const double outer = k + 1 < size ? disks_[k][is_hue ? 1 : 0][i] : 1;
      row[k] = outer - inner;
      inner = outer;
    }
    addRow(row, size, stride, value(i, is_hue), normal_.data(), right_.data());
  }
  addPrior(is_hue, stride);
  const auto rows = static_cast<int>(size);
  cv::Mat solution;
  cv::solve(cv::Mat(rows, rows, CV_64F, normal_.data(), stride * sizeof(double)),
            cv::Mat(rows, 2, CV_64F, right_.data()), solution, cv::DECOMP_CHOLESKY);
  for (int k = 0; k < rows; ++k)
  {
    const auto solved = solution.at<cv::Vec2d>(k);
    colors[k] = is_hue ? cv::Vec3d(colors[k][0], solved[0], solved[1]) : cv::Vec3d(solved[0], 0, 0);
  }
  return squaredRest(is_hue, stride, solution) / static_cast<double>(samples_.size());
}

/** Pulls each ring's colour to that in its middle. */
void RingFit::addPrior(bool is_hue, std::size_t stride)
{
  for (std::size_t k = 0; k < right_.size(); ++k)
  {
    const double outer = k < radii_.size() ? radii_[k] : radii_.back() + SURROUNDING;
    const double middle = k == 0 ? 0 : .5 * (radii_[k - 1] + outer);
    const auto i = std::min(static_cast<std::size_t>(std::lround(middle / step_)), samples_.size() - 1);
    normal_[k * stride + k] += PRIOR;
    right_[k] += PRIOR * value(i, is_hue);
  }
}

double RingFit::squaredRest(bool is_hue, std::size_t stride, const cv::Mat& solution) const
{
  double sum = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i)
  {
    cv::Vec2d rest = -value(i, is_hue);
    for (int k = 0; k < solution.rows; ++k)
    {
      rest += shares_[i * stride + k] * solution.at<cv::Vec2d>(k);
    }
    sum += rest.dot(rest);
  }
  return sum;
}

}  // namespace omr
