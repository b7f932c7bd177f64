#include "outdoor_omr/lattice_model.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "outdoor_omr/least_squares.h"

namespace omr
{
namespace
{
constexpr int ROUNDS = 4;              // of re-weighting; the set of outliers does not change any more
constexpr double OUTLIER = 2.5;        // medians of the residuals at which a corner's weight is half
constexpr double QUARTIC_OUTLIER = 5;  // its outermost corners decide much of it and must not lose their weight at once
constexpr double LEAST_MEDIAN = 0.04;  // px; nothing is measured better
constexpr double MIN_OUTLIER = 0.4;    // px
constexpr double OUTLIER_RMS = 4;
constexpr int MIN_QUARTIC_CORNERS = 30;  // twice its terms
constexpr double QUARTIC_RIDGE = 0.1;    // a stiffer one keeps the quartic from the outermost corners
}  // namespace

void LatticeModel::features(double row, double col, double (&values)[MAX_TERMS]) const
{
  const double x = (col - col_) / half_width_;
  const double y = (row - row_) / half_height_;
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
  const cv::Vec3d mapped = homography_ * cv::Vec3d(col, row, 1);
  cv::Point2d point(mapped[0] / mapped[2], mapped[1] / mapped[2]);
  if (terms_ > 0)
  {
    double values[MAX_TERMS];
    features(row, col, values);
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

bool LatticeModel::fitPolynomial(const std::vector<cv::Point2f>& nodes, const std::vector<cv::Point2f>& positions,
                                 const std::vector<double>& weights, double ridge)
{
  PointFit<MAX_TERMS> fit;
  double values[MAX_TERMS];
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    features(nodes[i].y, nodes[i].x, values);
    const cv::Vec3d mapped = homography_ * cv::Vec3d(nodes[i].x, nodes[i].y, 1);
    fit.add(values, cv::Point2d(positions[i].x - mapped[0] / mapped[2], positions[i].y - mapped[1] / mapped[2]),
            weights[i]);
  }
  for (int i = 0; i < terms_; ++i)
  {
    fit.addRidge(i, i < 3 ? 0.1 * ridge : ridge);
  }
  return fit.solve(terms_, coefficients_);
}

bool LatticeModel::fit(const Lattice& lattice, Terms terms, double ridge)
{
  std::vector<cv::Point2f> nodes;
  std::vector<cv::Point2f> positions;
  const cv::Rect& box = lattice.box;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      if (lattice.found(i, j))
      {
        nodes.emplace_back(static_cast<float>(j), static_cast<float>(i));
        positions.push_back(lattice.at(i, j).position);
      }
    }
  }
  if (nodes.size() < 6 || box.width < 2 || box.height < 2)
  {
    return false;
  }
  const cv::Mat found = cv::findHomography(nodes, positions, 0);
  if (found.empty())
  {
    return false;
  }
  homography_ = found;
  terms_ = terms;
  row_ = box.y + (box.height - 1) / 2.;
  col_ = box.x + (box.width - 1) / 2.;
  half_height_ = (box.height - 1) / 2.;
  half_width_ = (box.width - 1) / 2.;
  const double outlier = terms == quartic ? QUARTIC_OUTLIER : OUTLIER;
  std::vector<double> weights(nodes.size(), 1);
  std::vector<double> residuals(nodes.size());
  for (int round = 0; round < (terms_ > 0 ? ROUNDS : 1); ++round)
  {
    if (terms_ > 0 && !fitPolynomial(nodes, positions, weights, ridge))
    {
      return false;
    }
    double sum = 0;
    double weight = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      residuals[i] = length(at(nodes[i].y, nodes[i].x) - positions[i]);
      sum += weights[i] * residuals[i] * residuals[i];
      weight += weights[i];
    }
    rms_ = std::sqrt(sum / weight);
    std::vector<double> sorted = residuals;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    median_ = sorted[sorted.size() / 2];
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const double excess = residuals[i] / (outlier * std::max(LEAST_MEDIAN, median_));
      weights[i] = 1 / (1 + std::pow(excess, 4));
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
