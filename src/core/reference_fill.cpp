#include "outdoor_omr/reference_fill.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace omr
{
namespace
{
// A region of interest ends at its own border: without BORDER_ISOLATED OpenCV reads the pixels around it.
constexpr int BORDER = cv::BORDER_REPLICATE | cv::BORDER_ISOLATED;

void checkBgr(const cv::Mat& bgr)
{
  if (bgr.empty() || bgr.type() != CV_8UC3)
  {
    throw std::invalid_argument("expected an image of type CV_8UC3 that is not empty");
  }
}

/** Calls visit(tile, i, j) for the tile of row i and column j, all tiles. */
template <typename Visit>
void forEachTile(const cv::Size& size, const Visit& visit)
{
  const cv::Rect image({0, 0}, size);
  for (int i = 0; i * EDGE_TILE_HEIGHT < size.height; ++i)
  {
    for (int j = 0; j * EDGE_TILE_WIDTH < size.width; ++j)
    {
      visit(cv::Rect(j * EDGE_TILE_WIDTH, i * EDGE_TILE_HEIGHT, EDGE_TILE_WIDTH, EDGE_TILE_HEIGHT) & image, i, j);
    }
  }
}

/** Of each tile the adaptive threshold, CV_32SC1. */
cv::Mat tileThresholds(const cv::Mat_<short>& response, const EdgeThreshold& threshold)
{
  constexpr int ADAPTIVE_PERCENT = 45;  // regions alone: distance 87 -> 96 of 120 boards, size 73 -> 74 of 75
  cv::Mat_<int> strength((response.rows + EDGE_TILE_HEIGHT - 1) / EDGE_TILE_HEIGHT,
                         (response.cols + EDGE_TILE_WIDTH - 1) / EDGE_TILE_WIDTH);
  forEachTile(response.size(), [&](const cv::Rect& tile, int i, int j) {
    double strongest = 0;
    cv::minMaxLoc(response(tile), nullptr, &strongest);
    strength(i, j) = static_cast<int>(strongest);
  });
  cv::Mat_<int> thresholds(strength.size());
  const cv::Rect all({0, 0}, strength.size());
  thresholds.forEach([&](int& limit, const int* at) {
    double strongest = 0;
    cv::minMaxLoc(strength(cv::Rect(at[1] - 1, at[0] - 1, 3, 3) & all), nullptr, &strongest);
    limit = std::clamp(static_cast<int>(strongest) * ADAPTIVE_PERCENT / 100, threshold.floor, threshold.fixed);
  });
  return thresholds;
}

/** Root of the union-find tree, halving the path on the way. */
int findRoot(std::vector<int>& parent, int index)
{
  while (parent[index] != index)
  {
    parent[index] = parent[parent[index]];
    index = parent[index];
  }
  return index;
}

/** The smaller index becomes the root, so that a root is always the smallest index of its set. */
void unite(std::vector<int>& parent, int a, int b)
{
  a = findRoot(parent, a);
  b = findRoot(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}
}  // namespace

cv::Mat filterImage(const cv::Mat& bgr, Filter filter, int size)
{
  checkBgr(bgr);
  if (filter == Filter::none)
  {
    return bgr;
  }
  if (size != 3 && size != 5)
  {
    throw std::invalid_argument("the filter's size is 3 or 5, not " + std::to_string(size));
  }
  cv::Mat filtered;
  if (filter == Filter::gaussian)
  {
    cv::GaussianBlur(bgr, filtered, cv::Size(size, size), 0, 0, BORDER);
  }
  else
  {
    cv::medianBlur(bgr, filtered, size);
  }
  return filtered;
}

EdgeThreshold edgeThreshold(const Settings& settings)
{
  EdgeThreshold threshold;
  threshold.fixed = settings.sobel_threshold;
  threshold.floor = settings.edge_threshold == EdgeThresholdMethod::adaptive ? settings.sobel_floor : threshold.fixed;
  return threshold;
}

cv::Mat edgeMask(const cv::Mat& bgr, const EdgeThreshold& threshold)
{
  checkBgr(bgr);
  cv::Mat gx;
  cv::Mat gy;
  cv::Sobel(bgr, gx, CV_16S, 1, 0, 3, 1, 0, BORDER);
  cv::Sobel(bgr, gy, CV_16S, 0, 1, 3, 1, 0, BORDER);
  cv::Mat_<short> response(bgr.size());
  response.forEach([&](short& strongest, const int* at) {
    const auto& x = gx.at<cv::Vec3s>(at[0], at[1]);
    const auto& y = gy.at<cv::Vec3s>(at[0], at[1]);
    strongest = 0;
    for (int c = 0; c < 3; ++c)
    {
      strongest = std::max(strongest, static_cast<short>(std::abs(x[c]) + std::abs(y[c])));
    }
  });
  if (threshold.floor >= threshold.fixed)
  {
    return response > threshold.fixed;
  }
  const cv::Mat limits = tileThresholds(response, threshold);
  cv::Mat edges(bgr.size(), CV_8UC1);
  forEachTile(bgr.size(), [&](const cv::Rect& tile, int i, int j) {
    edges(tile).setTo(0);
    edges(tile).setTo(255, response(tile) > limits.at<int>(i, j));
  });
  return edges;
}

cv::Mat labelRegions(const cv::Mat& edges)
{
  if (edges.empty() || edges.type() != CV_8UC1)
  {
    throw std::invalid_argument("expected an edge mask of type CV_8UC1 that is not empty");
  }
  if (edges.total() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
  {
    throw std::invalid_argument("the edge mask has more than 2^31 - 1 pixels");
  }
  std::vector<int> parent(edges.total());
  std::iota(parent.begin(), parent.end(), 0);
  const int width = edges.cols;
  for (int y = 0; y < edges.rows; ++y)
  {
    const auto* row = edges.ptr<uchar>(y);
    const auto* above = y > 0 ? edges.ptr<uchar>(y - 1) : nullptr;
    for (int x = 0; x < width; ++x)
    {
      if (row[x])
      {
        continue;
      }
      if (x > 0 && !row[x - 1])
      {
        unite(parent, y * width + x, y * width + x - 1);
      }
      if (above && !above[x])
      {
        unite(parent, y * width + x, (y - 1) * width + x);
      }
    }
  }
  cv::Mat labels(edges.size(), CV_32SC1);
  int index = 0;
  for (int y = 0; y < edges.rows; ++y)
  {
    int* row = labels.ptr<int>(y);
    for (int x = 0; x < width; ++x)
    {
      row[x] = findRoot(parent, index++);
    }
  }
  return labels;
}

std::vector<RegionSums> sumRegions(const cv::Mat& bgr, const cv::Mat& edges, const cv::Mat& labels)
{
  checkBgr(bgr);
  if (edges.size() != bgr.size() || edges.type() != CV_8UC1 || labels.size() != bgr.size() || labels.type() != CV_32SC1)
  {
    throw std::invalid_argument("image, edge mask (CV_8UC1) and labels (CV_32SC1) must have one size");
  }
  std::vector<RegionSums> all;
  std::vector<int> slot_of(bgr.total(), -1);  // label -> place in all
  const auto is_edge = [&](int y, int x) {
    return y >= 0 && x >= 0 && y < edges.rows && x < edges.cols && edges.at<uchar>(y, x) != 0;
  };
  for (int y = 0; y < bgr.rows; ++y)
  {
    for (int x = 0; x < bgr.cols; ++x)
    {
      if (edges.at<uchar>(y, x))
      {
        continue;
      }
      const int label = labels.at<int>(y, x);
      int& slot = slot_of[label];
      if (slot < 0)
      {
        slot = static_cast<int>(all.size());
        RegionSums first;
        first.label = label;
        first.min_x = first.max_x = x;
        first.min_y = first.max_y = y;
        all.push_back(first);
      }
      RegionSums& sums = all[slot];
      const std::uint64_t px = x;
      const std::uint64_t py = y;
      const auto& color = bgr.at<cv::Vec3b>(y, x);
      ++sums.area;
      sums.perimeter += is_edge(y - 1, x) || is_edge(y + 1, x) || is_edge(y, x - 1) || is_edge(y, x + 1) ? 1 : 0;
      sums.blue += color[0];
      sums.green += color[1];
      sums.red += color[2];
      sums.x += px;
      sums.y += py;
      sums.xx += px * px;
      sums.xy += px * py;
      sums.yy += py * py;
      sums.min_x = std::min(sums.min_x, x);
      sums.max_x = std::max(sums.max_x, x);
      sums.max_y = y;
    }
  }
  std::vector<double> distance(all.size(), 0.);
  for (int y = 0; y < bgr.rows; ++y)
  {
    for (int x = 0; x < bgr.cols; ++x)
    {
      if (!edges.at<uchar>(y, x))
      {
        const int slot = slot_of[labels.at<int>(y, x)];
        const RegionSums& sums = all[slot];
        const double n = sums.area;
        distance[slot] += std::hypot(x - sums.x / n, y - sums.y / n);
      }
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i].distance = static_cast<std::uint64_t>(std::llround(distance[i] * 4096));
  }
  return all;
}

}  // namespace omr
