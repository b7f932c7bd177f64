#ifndef OUTDOOR_OMR_EDGE_PATTERNS_H
#define OUTDOOR_OMR_EDGE_PATTERNS_H

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace omr
{
/** An edge mask (CV_8UC1, 255 = edge) that is hard for a labelling algorithm. */
struct EdgePattern
{
  std::string name;
  cv::Mat edges;
};

/** One corridor, one pixel wide, that runs to and fro through the image: the sweeps need a round for each turn. */
inline cv::Mat serpentine(const cv::Size& size)
{
  cv::Mat edges(size, CV_8UC1, cv::Scalar(0));
  for (int y = 1; y < size.height; y += 2)
  {
    edges.row(y) = 255;
    edges.at<uchar>(y, (y / 2) % 2 ? 0 : size.width - 1) = 0;
  }
  return edges;
}

/** One corridor, one pixel wide, that winds inwards. */
inline cv::Mat spiral(const cv::Size& size)
{
  cv::Mat edges(size, CV_8UC1, cv::Scalar(255));
  const cv::Point steps[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const cv::Rect image(cv::Point(0, 0), size);
  const auto blocked = [&](const cv::Point& at) { return !image.contains(at) || edges.at<uchar>(at) == 0; };
  cv::Point at(0, 0);
  edges.at<uchar>(at) = 0;
  for (int direction = 0, turns = 0; turns < 2;)
  {
    const cv::Point next = at + steps[direction];
    const cv::Point after = next + steps[direction];
    if (blocked(next) || (image.contains(after) && blocked(after)))
    {
      direction = (direction + 1) % 4;
      ++turns;
    }
    else
    {
      at = next;
      edges.at<uchar>(at) = 0;
      turns = 0;
    }
  }
  return edges;
}

inline cv::Mat noiseEdges(const cv::Size& size, double edge_share)
{
  cv::Mat values(size, CV_32FC1);
  cv::RNG random(3);
  random.fill(values, cv::RNG::UNIFORM, 0, 1);
  return values < edge_share;
}

inline std::vector<EdgePattern> edgePatterns(const cv::Size& size)
{
  const auto pattern = [&size](const auto& is_edge) {
    cv::Mat edges(size, CV_8UC1);
    for (int y = 0; y < size.height; ++y)
    {
      for (int x = 0; x < size.width; ++x)
      {
        edges.at<uchar>(y, x) = is_edge(x, y) ? 255 : 0;
      }
    }
    return edges;
  };
  return {{"no edge", cv::Mat(size, CV_8UC1, cv::Scalar(0))},
          {"all edge", cv::Mat(size, CV_8UC1, cv::Scalar(255))},
          {"noise 50 %", noiseEdges(size, 0.5)},
          {"noise 40 %", noiseEdges(size, 0.4)},
          {"serpentine", serpentine(size)},
          {"spiral", spiral(size)},
          {"checkerboard", pattern([](int x, int y) { return (x + y) % 2 != 0; })},
          {"vertical stripes", pattern([](int x, int /*y*/) { return x % 2 != 0; })},
          {"horizontal stripes", pattern([](int /*x*/, int y) { return y % 2 != 0; })},
          {"comb open at the bottom", pattern([&size](int x, int y) { return x % 2 != 0 && y + 1 < size.height; })}};
}

}  // namespace omr

#endif
