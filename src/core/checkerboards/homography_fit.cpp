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
      const cv::Vec<double, UNKNOWNS> first(x, y, 1, 0, 0, 0, -target.x * x, -target.x * y);
      const cv::Vec<double, UNKNOWNS> second(0, 0, 0, x, y, 1, -target.y * x, -target.y * y);
      for (int a = 0; a < UNKNOWNS; ++a)
      {
        for (int b = 0; b <= a; ++b)
        {
          normal(a, b) += weight * (first[a] * first[b] + second[a] * second[b]);
        }
        right[a] += weight * (first[a] * target.x + second[a] * target.y);
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
