#include "lattice_model.h"

#include <algorithm>
#include <cmath>

#include "homography_fit.h"
#include "least_squares.h"
#include "median.h"

namespace omr
{
namespace
{
constexpr int ROUNDS = 4;              // of re-weighting; the set of outliers does not change any more
constexpr double OUTLIER = 2.5;        // medians of the residuals at which a corner's weight is half
constexpr double QUARTIC_OUTLIER = 5;  // its outermost corners decide much of it and must not lose their weight at once
constexpr double LEAST_MEDIAN = 0.04;  // px; nothing is measured better
constexpr int MIN_CORNERS = 6;         // for a homography that is more than the corners themselves
constexpr double MIN_OUTLIER = 0.4;    // px
constexpr double OUTLIER_RMS = 4;
constexpr int MIN_QUARTIC_CORNERS = 30;  // twice its terms
constexpr double QUARTIC_RIDGE = 0.1;    // a stiffer one keeps the quartic from the outermost corners
}  // namespace

cv::Point2d LatticeModel::place(double row, double col) const
{
  return {(col - col_) / half_width_, (row - row_) / half_height_};
}

void LatticeModel::features(const cv::Point2d& place, double (&values)[MAX_TERMS])
{
  const double x = place.x;
  const double y = place.y;
  const double all[MAX_TERMS] = {1,
                                 x,
                                 y,
                                 x * y,
                                 x * x,
                                 y * y,
                                 x * x * x,
                                 x * x * y,
                                 x * y * y,
                                 y * y * y,
                                 x * x * x * y,
                                 x * y * y * y,
                                 x * x * x * x,
                                 x * x * y * y,
                                 y * y * y * y};
  std::copy(std::begin(all), std::end(all), std::begin(values));
}

cv::Point2f LatticeModel::at(double row, double col) const
{
  return at(place(row, col));
}

cv::Point2f LatticeModel::at(const cv::Point2d& place) const
{
  cv::Point2d point = mapPoint(homography_, place);
  if (terms_ > 0)
  {
    double values[MAX_TERMS];
    features(place, values);
    for (int i = 0; i < terms_; ++i)
    {
      point += values[i] * coefficients_[i];
    }
  }
  return point;
}

LocalFrame LatticeModel::frameAt(double row, double col) const
{
  return {at(row, col), 0.5F * (at(row, col + 1) - at(row, col - 1)), 0.5F * (at(row + 1, col) - at(row - 1, col))};
}

bool LatticeModel::fitPolynomial(const std::vector<cv::Point2d>& places, const std::vector<cv::Point2d>& positions,
                                 const std::vector<double>& weights, double ridge)
{
  PointFit<MAX_TERMS> fit;
  double values[MAX_TERMS];
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    features(places[i], values);
    fit.add(values, positions[i] - mapPoint(homography_, places[i]), weights[i], terms_);
  }
  for (int i = 0; i < terms_; ++i)
  {
    fit.addRidge(i, i < 3 ? 0.1 * ridge : ridge);
  }
  return fit.solve(terms_, coefficients_);
}

bool LatticeModel::fit(const Lattice& lattice, Terms terms, double ridge)
{
  const cv::Rect& box = lattice.box;
  if (lattice.count() < MIN_CORNERS || box.width < 2 || box.height < 2)
  {
    return false;
  }
  terms_ = terms == robust_homography ? homography : terms;
  row_ = box.y + (box.height - 1) / 2.;
  col_ = box.x + (box.width - 1) / 2.;
  half_height_ = (box.height - 1) / 2.;
  half_width_ = (box.width - 1) / 2.;
  std::vector<cv::Point2d> places;
  std::vector<cv::Point2d> positions;
  std::vector<double> given;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      if (lattice.found(i, j))
      {
        places.push_back(place(i, j));
        positions.push_back(lattice.at(i, j).position);
        given.push_back(lattice.at(i, j).weight);
      }
    }
  }
  const double outlier = terms == quartic ? QUARTIC_OUTLIER : OUTLIER;
  std::vector<double> weights = given;
  if (!fitHomography(places, positions, weights, homography_))
  {
    return false;
  }
  std::vector<double> residuals(places.size());
  for (int round = 0; round < (terms == homography ? 1 : ROUNDS); ++round)
  {
    const bool fitted = terms_ > 0 ? fitPolynomial(places, positions, weights, ridge)
                                   : round == 0 || fitHomography(places, positions, weights, homography_);
    if (!fitted)
    {
      return false;
    }
    double sum = 0;
    double weight = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      residuals[i] = cv::norm(cv::Point2d(at(places[i])) - positions[i]);
      sum += weights[i] * residuals[i] * residuals[i];
      weight += weights[i];
    }
    rms_ = std::sqrt(sum / weight);
    median_ = omr::median(residuals);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const double excess = residuals[i] / (outlier * std::max(LEAST_MEDIAN, median_));
      weights[i] = given[i] / (1 + std::pow(excess, 4));
    }
  }
  outliers_ = static_cast<int>(
      std::count_if(residuals.begin(), residuals.end(), [this](double residual) { return isOutlier(residual); }));
  return true;
}

bool LatticeModel::fitSmooth(const Lattice& lattice, double ridge)
{
  if (!fit(lattice, cubic, ridge))
  {
    return false;
  }
  LatticeModel finer;
  if (outliers_ > 0 && lattice.count() >= MIN_QUARTIC_CORNERS && finer.fit(lattice, quartic, QUARTIC_RIDGE * ridge) &&
      finer.outliers_ < outliers_)
  {
    *this = finer;
  }
  return true;
}

bool LatticeModel::isOutlier(double residual) const
{
  return residual > std::max(MIN_OUTLIER, OUTLIER_RMS * rms_);
}

}  // namespace omr
