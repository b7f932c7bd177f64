#ifndef OUTDOOR_OMR_CORE_LEAST_SQUARES_H
#define OUTDOOR_OMR_CORE_LEAST_SQUARES_H

#include <cmath>
#include <opencv2/core.hpp>

namespace omr
{
/** Weighted linear least squares for points of the plane: position = sum of coefficient * feature, by normal equations
 * on the stack, because a lattice solves thousands of them a frame. Features should be of size 1. */
template <int N>
class PointFit
{
 public:
  /** @param count of the features that solve() will be asked for, at most. */
  void add(const double (&features)[N], const cv::Point2d& position, double weight, int count = N)
  {
    for (int i = 0; i < count; ++i)
    {
      const double weighted = weight * features[i];
      for (int j = 0; j <= i; ++j)
      {
        normal_[i][j] += weighted * features[j];
      }
      right_[i] += weighted * position;
    }
  }

  /** Adds to the diagonal what pulls a coefficient towards 0. */
  void addRidge(int index, double weight)
  {
    normal_[index][index] += weight;
  }

  /** Solves for the first `count` features by Cholesky's decomposition. @return false if they are not independent. */
  bool solve(int count, cv::Point2d (&coefficients)[N])
  {
    for (int i = 0; i < count; ++i)
    {
      for (int j = 0; j <= i; ++j)
      {
        double sum = normal_[i][j];
        for (int k = 0; k < j; ++k)
        {
          sum -= normal_[i][k] * normal_[j][k];
        }
        if (i == j)
        {
          if (sum < 1e-9)
          {
            return false;
          }
          normal_[i][i] = std::sqrt(sum);
        }
        else
        {
          normal_[i][j] = sum / normal_[j][j];
        }
      }
      for (int k = 0; k < i; ++k)
      {
        right_[i] -= normal_[i][k] * right_[k];
      }
      right_[i] *= 1 / normal_[i][i];
    }
    for (int i = count - 1; i >= 0; --i)
    {
      coefficients[i] = right_[i];
      for (int k = i + 1; k < count; ++k)
      {
        coefficients[i] -= normal_[k][i] * coefficients[k];
      }
      coefficients[i] *= 1 / normal_[i][i];
    }
    return true;
  }

 private:
  double normal_[N][N] = {};  // lower triangle; the factor after solve()
  cv::Point2d right_[N] = {};
};

}  // namespace omr

#endif
