#include "homography_fit.h"

namespace omr
{
bool fitHomography(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to,
                   const std::vector<double>& weights, cv::Matx33d& homography)
{
  constexpr int ROUNDS = 2;
  constexpr int UNKNOWNS = 8;
  cv::Point2d center;
  for (const cv::Point2d& point : to)
  {
    center += point / static_cast<double>(to.size());
  }
  double size = 0;
  for (const cv::Point2d& point : to)
  {
    size += cv::norm(point - center) / static_cast<double>(to.size());
  }
  cv::Matx33d fitted(1, 0, 0, 0, 1, 0, 0, 0, 1);
  for (int round = 0; round < ROUNDS; ++round)
  {
    cv::Matx<double, UNKNOWNS, UNKNOWNS> normal;
    cv::Vec<double, UNKNOWNS> right;
    for (std::size_t i = 0; i < from.size(); ++i)
    {
      const double x = from[i].x;
      const double y = from[i].y;
      const cv::Point2d target = (to[i] - center) / size;
      const double denominator = round == 0 ? 1 : fitted(2, 0) * x + fitted(2, 1) * y + 1;
      const double weight = weights[i] / (denominator * denominator);
      const cv::Vec3d place(x, y, 1);
      // Of the equations of x (place, 0, -x place) and of y (0, place, -y place) only what is not 0.
      for (int a = 0; a < 3; ++a)
      {
        for (int b = 0; b <= a; ++b)
        {
          normal(a, b) += weight * (place[a] * place[b]);
        }
        right[a] += weight * (place[a] * target.x);
        right[3 + a] += weight * (place[a] * target.y);
      }
      for (int a = 0; a < 2; ++a)
      {
        const cv::Point2d lean = -place[a] * target;
        for (int b = 0; b < 3; ++b)
        {
          normal(6 + a, b) += weight * (lean.x * place[b]);
          normal(6 + a, 3 + b) += weight * (lean.y * place[b]);
        }
        for (int b = 0; b <= a; ++b)
        {
          normal(6 + a, 6 + b) += weight * lean.dot(-place[b] * target);
        }
        right[6 + a] += weight * lean.dot(target);
      }
    }
    for (int a = 0; a < 3; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        normal(3 + a, 3 + b) = normal(a, b);
      }
    }
    for (int a = 0; a < UNKNOWNS; ++a)
    {
      for (int b = a + 1; b < UNKNOWNS; ++b)
      {
        normal(a, b) = normal(b, a);
      }
    }
    cv::Vec<double, UNKNOWNS> h;
    if (!cv::solve(normal, right, h, cv::DECOMP_CHOLESKY))
    {
      return false;
    }
    fitted = {h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1};
  }
  homography = cv::Matx33d(size, 0, center.x, 0, size, center.y, 0, 0, 1) * fitted;
  return true;
}

}  // namespace omr
