#include "saddle_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "local_frame.h"
#include "outdoor_omr/frame.h"

namespace omr
{
namespace
{
/** Sums over one row of a window: of the grey values, and of these times x and x^2. */
struct RowSums
{
  float sum, x, xx;
};

RowSums interpolate(const RowSums& a, const RowSums& b, float share)
{
  return {a.sum + share * (b.sum - a.sum), a.x + share * (b.x - a.x), a.xx + share * (b.xx - a.xx)};
}

/**
 * Sums over a square window that lies anywhere between the pixels. They are linear in the grey values, so the sums
 * over whole pixels are interpolated instead of the pixels, and taken only when the window leaves its pixel.
 */
class MomentWindow
{
 public:
  static constexpr int MAX_RADIUS = 6;

  MomentWindow(const cv::Mat& grey, int radius) : grey_(grey), radius_(radius)
  {
  }

  struct Moments
  {
    float z = 0, zx = 0, zy = 0, zxx = 0, zxy = 0, zyy = 0;
  };

  /** @param center at least radius + 1 from the image's border. */
  Moments at(const cv::Point2f& center)
  {
    const cv::Point pixel(static_cast<int>(center.x), static_cast<int>(center.y));
    if (pixel != pixel_)
    {
      gather(pixel);
    }
    const float a = center.x - static_cast<float>(pixel.x);
    const float b = center.y - static_cast<float>(pixel.y);
    Moments moments;
    RowSums above = interpolate(left_[0], right_[0], a);
    for (int i = 0; i <= 2 * radius_; ++i)
    {
      const RowSums below = interpolate(left_[i + 1], right_[i + 1], a);
      const RowSums row = interpolate(above, below, b);
      const auto y = static_cast<float>(i - radius_);
      moments.z += row.sum;
      moments.zx += row.x;
      moments.zxx += row.xx;
      moments.zy += y * row.sum;
      moments.zxy += y * row.x;
      moments.zyy += y * y * row.sum;
      above = below;
    }
    return moments;
  }

 private:
  /** Sums of the rows around the pixel, and the same one pixel further right. */
  void gather(const cv::Point& pixel)
  {
    pixel_ = pixel;
    const int r = radius_;
    for (int i = 0; i <= 2 * r + 1; ++i)
    {
      const uchar* row = grey_.ptr<uchar>(pixel.y + i - r) + pixel.x;
      int sum = 0;
      int x1 = 0;
      int x2 = 0;
      for (int x = -r; x <= r; ++x)
      {
        const int value = row[x];
        sum += value;
        x1 += x * value;
        x2 += x * x * value;
      }
      left_[i] = {static_cast<float>(sum), static_cast<float>(x1), static_cast<float>(x2)};
      const int first = row[-r];
      const int last = row[r + 1];
      sum += last - first;
      x1 += (r + 1) * last + r * first;
      x2 += (r + 1) * (r + 1) * last - r * r * first;
      right_[i] = {static_cast<float>(sum), static_cast<float>(x1 - sum), static_cast<float>(x2 - 2 * x1 + sum)};
    }
  }

  const cv::Mat& grey_;
  int radius_;
  cv::Point pixel_ = {-1, -1};
  std::array<RowSums, 2 * MAX_RADIUS + 2> left_;
  std::array<RowSums, 2 * MAX_RADIUS + 2> right_;
};
}  // namespace

bool fitSaddle(const cv::Mat& grey, cv::Point2f& point, int radius, float reach)
{
  constexpr int MAX_ROUNDS = 6;
  constexpr float AT_REST = 0.03F;  // px; the final refinement starts from 0.1 px as well
  const cv::Point2f start = point;
  const auto r = static_cast<float>(radius);
  // Sums of x^2, x^4 and x^2 y^2 over the window.
  const float n = (2 * r + 1) * (2 * r + 1);
  const float s2_line = r * (r + 1) * (2 * r + 1) / 3;
  const float s4_line = s2_line * (3 * r * r + 3 * r - 1) / 5;
  const float s2 = s2_line * (2 * r + 1);
  const float s4 = s4_line * (2 * r + 1);
  const float s22 = s2_line * s2_line;
  MomentWindow window(grey, radius);
  for (int round = 0; round < MAX_ROUNDS; ++round)
  {
    if (!isInside(grey, point, r + 1))
    {
      return false;
    }
    const MomentWindow::Moments m = window.at(point);
    // z = f + d x + e y + qxx x^2 + qxy x y + qyy y^2
    const float d = m.zx / s2;
    const float e = m.zy / s2;
    const float qxy = m.zxy / s22;
    const float difference = (m.zxx - m.zyy) / (s4 - s22);
    const float sum = (m.zxx + m.zyy - 2 * s2 * m.z / n) / (s4 + s22 - 2 * s2 * s2 / n);
    const float qxx = (sum + difference) / 2;
    const float qyy = (sum - difference) / 2;
    const float determinant = 4 * qxx * qyy - qxy * qxy;
    if (determinant >= -1e-9F)
    {
      return false;
    }
    cv::Point2f move(-(2 * qyy * d - qxy * e) / determinant, -(2 * qxx * e - qxy * d) / determinant);
    const float distance = length(move);
    if (distance > r)
    {
      move *= r / distance;
    }
    point += move;
    if (length(point - start) > reach)
    {
      return false;
    }
    if (distance < AT_REST)
    {
      break;
    }
  }
  return true;
}

int fitRadius(float square_height)
{
  return std::max(1, std::min(MomentWindow::MAX_RADIUS, static_cast<int>(std::lround(0.32F * square_height))));
}

}  // namespace omr
