#include "bent_distances.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
constexpr double SMALLEST_GRADIENT = 1e-6;
}  // namespace

void measureBent(const std::vector<BoundaryPoint>& points, const RingFamily& family, const std::vector<double>& radii,
                 std::vector<cv::Point2d>& places, std::vector<double>& distances)
{
  const bool are_near = places.size() == points.size();
  places.resize(points.size());
  distances.resize(points.size());
  const BentSheet sheet(family);
  RingFamily plane = family;
  plane.bend = {};
  BentSheet::Points image;
  BentSheet::Points q;
  BentSheet::Points gradient;
  for (std::size_t first = 0; first < points.size(); first += BentSheet::CHUNK)
  {
    const std::size_t size = std::min(BentSheet::CHUNK, points.size() - first);
    for (std::size_t i = 0; i < size; ++i)
    {
      const cv::Point2d& position = points[first + i].position;
      const cv::Point2d start = are_near ? places[first + i] : plane.toPlane(position);
      image.x[i] = position.x;
      image.y[i] = position.y;
      q.x[i] = start.x;
      q.y[i] = start.y;
    }
    sheet.toPlane(image, size, q);
    sheet.gradients(q, size, gradient);
    for (std::size_t i = 0; i < size; ++i)
    {
      const double slope = std::sqrt(gradient.x[i] * gradient.x[i] + gradient.y[i] * gradient.y[i]);
      places[first + i] = {q.x[i], q.y[i]};
      distances[first + i] =
          (cv::norm(places[first + i]) - radii[points[first + i].ring]) / std::max(SMALLEST_GRADIENT, slope);
    }
  }
}

void differentiateBent(const std::vector<cv::Point2d>& places, const RingFamily& family, std::vector<BentRow>& rows)
{
  const BentSheet sheet(family);
  rows.resize(places.size());
  BentSheet::Points q;
  BentSheet::Derivatives derivatives;
  for (std::size_t first = 0; first < places.size(); first += BentSheet::CHUNK)
  {
    const std::size_t size = std::min(BentSheet::CHUNK, places.size() - first);
    for (std::size_t i = 0; i < size; ++i)
    {
      q.x[i] = places[first + i].x;
      q.y[i] = places[first + i].y;
    }
    sheet.differentiate(q, size, derivatives);
    for (std::size_t i = 0; i < size; ++i)
    {
      BentRow& row = rows[first + i];
      for (std::size_t k = 0; k < derivatives.size(); ++k)
      {
        row[k] = derivatives[k][i];
      }
      std::fill(row.begin() + derivatives.size(), row.end(), 0);
    }
  }
}

}  // namespace omr
