#ifndef OUTDOOR_OMR_CORE_LANE_EQUATIONS_H
#define OUTDOOR_OMR_CORE_LANE_EQUATIONS_H

#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>

namespace omr
{
/** Values that are computed side by side, in functions that are OMR_VECTORIZED. */
constexpr int LANES = 8;
using Lanes = std::array<float, LANES>;

inline float total(const Lanes& lanes)
{
  return std::accumulate(lanes.begin(), lanes.end(), 0.F);
}

/** To [-1, 1] without a branch, which would keep the compiler from vectors. */
inline float clampToOne(float x)
{
  return 0.5F * (std::abs(x + 1) - std::abs(x - 1));
}

/** An edge as lens and pixels make it: from -1 to 1 by the integral of 15 / 8 (1 - x^2)^2, a bell much like the normal
 * one, but without an exponential. @param x in [-1, 1]. */
inline float softEdge(float x)
{
  const float xx = x * x;
  return x * (1.875F - xx * (1.25F - 0.375F * xx));
}

/** Normal equations of least squares, each sum in LANES parts. */
template <int UNKNOWNS>
struct LaneEquations
{
  std::array<std::array<Lanes, UNKNOWNS>, UNKNOWNS> normal = {};  ///< the lower half
  std::array<Lanes, UNKNOWNS> right = {};

  /** @param by derivatives by each unknown. @param rest what is lacking. Of LANES samples. */
  void add(const std::array<Lanes, UNKNOWNS>& by, const Lanes& rest)
  {
    for (int row = 0; row < UNKNOWNS; ++row)
    {
      for (int column = 0; column <= row; ++column)
      {
        for (int i = 0; i < LANES; ++i)
        {
          normal[row][column][i] += by[row][i] * by[column][i];
        }
      }
      for (int i = 0; i < LANES; ++i)
      {
        right[row][i] += by[row][i] * rest[i];
      }
    }
  }

  /** @param ridge added to the diagonal, so that what no sample tells stays 0. */
  cv::Matx<double, UNKNOWNS, UNKNOWNS> normalMatrix(double ridge) const
  {
    cv::Matx<double, UNKNOWNS, UNKNOWNS> matrix;
    for (int row = 0; row < UNKNOWNS; ++row)
    {
      for (int column = 0; column <= row; ++column)
      {
        matrix(row, column) = matrix(column, row) = total(normal[row][column]);
      }
      matrix(row, row) += ridge;
    }
    return matrix;
  }

  cv::Vec<double, UNKNOWNS> rightSide() const
  {
    cv::Vec<double, UNKNOWNS> side;
    for (int row = 0; row < UNKNOWNS; ++row)
    {
      side[row] = total(right[row]);
    }
    return side;
  }
};

}  // namespace omr

#endif
