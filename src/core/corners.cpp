#include "outdoor_omr/corners.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "outdoor_omr/lattice_model.h"
#include "outdoor_omr/lattice_prediction.h"

namespace omr
{
namespace
{
constexpr float RADIUS_SHARE = 0.45F;  // of the square
constexpr float MIN_RADIUS = 1.2F;     // px
constexpr int MAX_RADIUS = 8;          // px; 5: RMS 0.072 instead of 0.058 under soft shadow; 14: worse under hard
constexpr int WINDOW = 2 * MAX_RADIUS + 1;

/** Gradients around a pixel. */
struct GradientWindow
{
  GradientWindow(const cv::Mat& grey, const cv::Point& center, int radius)
  {
    for (int y = -radius; y <= radius; ++y)
    {
      const uchar* above = grey.ptr<uchar>(center.y + y - 1) + center.x;
      const uchar* here = grey.ptr<uchar>(center.y + y) + center.x;
      const uchar* below = grey.ptr<uchar>(center.y + y + 1) + center.x;
      for (int x = -radius; x <= radius; ++x)
      {
        cv::Vec2s& gradient = at(x, y);
        gradient[0] = static_cast<short>(here[x + 1] - here[x - 1]);
        gradient[1] = static_cast<short>(below[x] - above[x]);
      }
    }
  }

  cv::Vec2s& at(int x, int y)
  {
    return gradients[(y + MAX_RADIUS) * WINDOW + x + MAX_RADIUS];
  }

  std::array<cv::Vec2s, WINDOW * WINDOW> gradients;
};
}  // namespace

cv::Point2f refineCorner(const cv::Mat& grey, const LocalFrame& corner)
{
  constexpr int MAX_ROUNDS = 6;
  constexpr float AT_REST = 0.005F;       // px
  constexpr float MAX_MOVE_SHARE = 0.7F;  // of the radius
  const float extent =
      std::max(MIN_RADIUS, std::min(static_cast<float>(MAX_RADIUS), RADIUS_SHARE * squareHeight(corner)));
  const int radius = std::min(MAX_RADIUS, cvCeil(extent));
  const cv::Point center(cvRound(corner.node.x), cvRound(corner.node.y));
  if (!cv::Rect(radius + 1, radius + 1, grey.cols - 2 * radius - 2, grey.rows - 2 * radius - 2).contains(center))
  {
    return corner.node;
  }
  GradientWindow window(grey, center, radius);
  const cv::Point2f start = corner.node - cv::Point2f(center);
  cv::Point2f point = start;
  for (int round = 0; round < MAX_ROUNDS; ++round)
  {
    float xx = 0;
    float xy = 0;
    float yy = 0;
    float bx = 0;
    float by = 0;
    std::array<float, WINDOW> weight_x;
    std::array<float, WINDOW> weight_y;
    for (int i = -radius; i <= radius; ++i)
    {
      const float dx = (static_cast<float>(i) - point.x) / extent;
      const float dy = (static_cast<float>(i) - point.y) / extent;
      weight_x[i + MAX_RADIUS] = std::exp(-dx * dx);
      weight_y[i + MAX_RADIUS] = std::exp(-dy * dy);
    }
    for (int y = -radius; y <= radius; ++y)
    {
      for (int x = -radius; x <= radius; ++x)
      {
        const float dx = static_cast<float>(x) - point.x;
        const float dy = static_cast<float>(y) - point.y;
        const cv::Vec2s& gradient = window.at(x, y);
        const float weight = weight_x[x + MAX_RADIUS] * weight_y[y + MAX_RADIUS];
        const float gx = gradient[0];
        const float gy = gradient[1];
        xx += weight * gx * gx;
        xy += weight * gx * gy;
        yy += weight * gy * gy;
        bx += weight * (gx * gx * dx + gx * gy * dy);
        by += weight * (gx * gy * dx + gy * gy * dy);
      }
    }
    const float determinant = xx * yy - xy * xy;
    if (determinant <= 1e-6F * (xx + yy) * (xx + yy))
    {
      return corner.node;
    }
    const cv::Point2f move((yy * bx - xy * by) / determinant, (xx * by - xy * bx) / determinant);
    point += move;
    if (length(point - start) > MAX_MOVE_SHARE * extent)
    {
      return corner.node;
    }
    if (length(move) < AT_REST)
    {
      break;
    }
  }
  return cv::Point2f(center) + point;
}

namespace
{
void refineAll(const Frame& frame, Lattice& lattice)
{
  constexpr float MAX_MOVE = 0.25F;  // squares
  const cv::Rect box = lattice.box;
  std::vector<cv::Point2f> refined(box.area());
  for (int pass = 0; pass < 2; ++pass)
  {
    for (int i = 0; i < box.height; ++i)
    {
      for (int j = 0; j < box.width; ++j)
      {
        LatticeNode& node = lattice.at(box.y + i, box.x + j);
        cv::Point2f& position = refined[i * box.width + j];
        if (!node.found)
        {
          continue;
        }
        if (pass == 1)
        {
          node.position = position;
          continue;
        }
        position = node.position;
        LocalFrame corner;
        if (predictNode(lattice, box.y + i, box.x + j, 1, corner))
        {
          corner.node = node.position;
          const cv::Point2f moved = refineCorner(frame.grey[0], corner);
          position = length(moved - node.position) < MAX_MOVE * squareHeight(corner) ? moved : node.position;
        }
      }
    }
  }
}
}  // namespace

std::vector<bool> refineCorners(const Frame& frame, Lattice& lattice)
{
  constexpr double RIDGE = 0.5;
  constexpr double MAX_RMS = 0.8;  // px; blurred and shadowed boards have 0.3 to 0.7 (with 0.35: degrade 0.17 for 0.10)
  constexpr float MODEL_SHARE = 0.8F;  // of the surface in the result
  refineAll(frame, lattice);
  const cv::Rect box = lattice.box;
  std::vector<bool> seen;
  LatticeModel model;
  if (!model.fitSmooth(lattice, RIDGE))
  {
    return {};
  }
  const bool explains = model.rms() < MAX_RMS;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      LatticeNode& node = lattice.at(i, j);
      const cv::Point2f smooth = model.at(i, j);
      const bool refuted = explains && model.isOutlier(length(node.position - smooth));
      seen.push_back(node.found && !refuted);
      if (!seen.back())
      {
        node.position = smooth;
      }
      else if (explains)
      {
        node.position += MODEL_SHARE * (smooth - node.position);
      }
    }
  }
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      lattice.at(i, j).found = true;
    }
  }
  return seen;
}

}  // namespace omr
