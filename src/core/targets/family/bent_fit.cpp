#include "bent_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bent_distances.h"
#include "levenberg_marquardt.h"
#include "tukey.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int UNKNOWNS = BENT_UNKNOWNS;
// At the outermost circle. What is usual counts as much as one deviation of the points.
constexpr double USUAL_ANGLE = .6;  // of the bend [rad]
constexpr double USUAL_NORMAL = .6;
constexpr double LARGEST_ANGLE = 1.25;
constexpr double LARGEST_NORMAL = 1.6;
constexpr double LARGEST_ASPECT = 3.5;

using Unknowns = std::array<double, UNKNOWNS>;

Unknowns valuesOf(const RingFamily& f)
{
  return {f.center.x, f.center.y, f.a, f.b, f.d, f.hx, f.hy, f.bend.x, f.bend.y, f.normal.x, f.normal.y, f.hz};
}

constexpr int FIRST_USUAL = 5;  // of the unknowns that have a usual size

Unknowns usualSizes(double radius)
{
  const double h = USUAL_PERSPECTIVE / radius;
  const double k = USUAL_ANGLE / radius;
  return {0, 0, 0, 0, 0, h, h, k, k, USUAL_NORMAL, USUAL_NORMAL, h};
}

/** Sums over the points of a ring. */
struct RingSums
{
  std::array<BentRow, UNKNOWNS + 1> normal{};
  BentRow right{};
};

/** A point's row and its part in the sums. */
struct WeightedRow
{
  const double* row;
  double weight;
  double error;
};

/** One row of the sums after the other: it stays in registers. */
OMR_VECTORIZED void addRows(const WeightedRow* rows, std::size_t count, RingSums& sums)
{
  constexpr std::size_t SIZE = std::tuple_size<BentRow>::value;
  for (int i = 0; i <= UNKNOWNS; ++i)
  {
    BentRow sum{};
    for (std::size_t p = 0; p < count; ++p)
    {
      const double* row = rows[p].row;
      const double factor = rows[p].weight * row[i];
      for (std::size_t j = 0; j < SIZE; ++j)
      {
        sum[j] += factor * row[j];
      }
    }
    sums.normal[i] = sum;
  }
  BentRow right{};
  for (std::size_t p = 0; p < count; ++p)
  {
    const double factor = rows[p].weight * rows[p].error;
    for (std::size_t j = 0; j < SIZE; ++j)
    {
      right[j] += factor * rows[p].row[j];
    }
  }
  sums.right = right;
}

bool isPlausible(const RingFamily& family, const std::vector<double>& radii)
{
  double inner = 0;
  for (const double radius : radii)
  {
    if (!(radius > inner))
    {
      return false;
    }
    inner = radius;
  }
  return std::hypot(family.hx, family.hy) * inner < LARGEST_PERSPECTIVE &&
         std::abs(family.hz) * inner < LARGEST_PERSPECTIVE && cv::norm(family.bend) * inner < LARGEST_ANGLE &&
         cv::norm(family.normal) < LARGEST_NORMAL && family.aspect() < LARGEST_ASPECT && family.isBent();
}
}  // namespace

BentFit::BentFit(const std::vector<BoundaryPoint>& points, const RingFamily& family, std::vector<double> radii)
    : points_(points), family_(family), radii_(std::move(radii))
{
  measureBent(points_, family_, radii_, places_, errors_);
}

bool BentFit::run(int max_steps)
{
  std::vector<double> sizes;
  RingFamily next;
  std::vector<double> next_radii;
  std::vector<cv::Point2d> next_places;
  std::vector<double> next_errors;
  levenbergMarquardt(
      max_steps, 1e-3,
      [&] {
        limit_ = tukeyLimit(errors_, sizes);
        build();
        return cost(family_, radii_, errors_);
      },
      [&](double damping) {
        next = family_;
        next_radii = radii_;
        next_places = places_;
        if (!solve(damping, next, next_radii))
        {
          return std::numeric_limits<double>::infinity();
        }
        measureBent(points_, next, next_radii, next_places, next_errors);
        return cost(next, next_radii, next_errors);
      },
      [&] {
        family_ = next;
        radii_ = next_radii;
        places_.swap(next_places);
        errors_.swap(next_errors);
      });
  return isPlausible(family_, radii_);
}

double BentFit::loss(double limit) const
{
  return tukeyLoss(errors_, limit) / static_cast<double>(errors_.size());
}

double BentFit::rms() const
{
  return tukeyRms(errors_, limit_);
}

double BentFit::cost(const RingFamily& family, const std::vector<double>& radii,
                     const std::vector<double>& errors) const
{
  const Unknowns sizes = usualSizes(radii.back());
  const Unknowns values = valuesOf(family);
  double prior = 0;
  for (int i = FIRST_USUAL; i < UNKNOWNS; ++i)
  {
    prior += (values[i] / sizes[i]) * (values[i] / sizes[i]);
  }
  return tukeyLoss(errors, limit_) + 3 * prior / (TUKEY * TUKEY);
}

void BentFit::build()
{
  differentiateBent(places_, family_, rows_);
  std::vector<std::vector<WeightedRow>> rows(radii_.size());
  for (std::size_t p = 0; p < points_.size(); ++p)
  {
    const double weight = tukeyWeight(errors_[p], limit_);
    if (weight > 0)
    {
      rows[points_[p].ring].push_back({rows_[p].data(), weight, errors_[p]});
    }
  }
  const int size = UNKNOWNS + static_cast<int>(radii_.size());
  normal_ = cv::Mat::zeros(size, size, CV_64F);
  right_ = cv::Mat::zeros(size, 1, CV_64F);
  for (int k = 0; k < static_cast<int>(rows.size()); ++k)
  {
    RingSums sums;
    addRows(rows[k].data(), rows[k].size(), sums);
    const auto place = [&](int unknown) { return unknown < UNKNOWNS ? unknown : UNKNOWNS + k; };
    for (int i = 0; i <= UNKNOWNS; ++i)
    {
      right_.at<double>(place(i)) -= sums.right[i];
      for (int j = 0; j <= UNKNOWNS; ++j)
      {
        normal_.at<double>(place(i), place(j)) += sums.normal[i][j];
      }
    }
  }
  addGauge();
  addPrior();
}

void BentFit::addGauge()
{
  const std::array<double, 3> det = {family_.d, -2 * family_.b, family_.a};
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      normal_.at<double>(2 + i, 2 + j) += GAUGE_WEIGHT * det[i] * det[j];
    }
  }
}

void BentFit::addPrior()
{
  const Unknowns sizes = usualSizes(radii_.back());
  const Unknowns values = valuesOf(family_);
  for (int i = FIRST_USUAL; i < UNKNOWNS; ++i)
  {
    const double prior = limit_ * limit_ / (TUKEY * TUKEY * sizes[i] * sizes[i]);
    normal_.at<double>(i, i) += prior;
    right_.at<double>(i) -= prior * values[i];
  }
}

bool BentFit::solve(double damping, RingFamily& family, std::vector<double>& radii) const
{
  cv::Mat damped = normal_.clone();
  for (int i = 0; i < damped.rows; ++i)
  {
    damped.at<double>(i, i) = damped.at<double>(i, i) * (1 + damping) + 1e-9;
  }
  cv::Mat solution;
  if (!cv::solve(damped, right_, solution, cv::DECOMP_CHOLESKY))
  {
    return false;
  }
  const double* step = solution.ptr<double>();
  family.center += cv::Point2d(step[0], step[1]);
  family.a += step[2];
  family.b += step[3];
  family.d += step[4];
  family.hx += step[5];
  family.hy += step[6];
  family.bend += cv::Point2d(step[7], step[8]);
  family.normal += cv::Point2d(step[9], step[10]);
  family.hz += step[11];
  const double det = family.a * family.d - family.b * family.b;
  if (!(det > .25 && det < 4 && family.a > 0))
  {
    return false;
  }
  const double scale = std::sqrt(det);
  for (double* value : {&family.a, &family.b, &family.d, &family.hx, &family.hy, &family.hz, &family.bend.x,
                        &family.bend.y, &family.normal.x, &family.normal.y})
  {
    *value /= scale;
  }
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    radii[k] = (radii[k] + step[UNKNOWNS + static_cast<int>(k)]) * scale;
  }
  return isPlausible(family, radii);
}

}  // namespace omr
