#include "outdoor_omr/window_scores.h"

#include <array>
#include <opencv2/imgproc.hpp>

namespace omr
{
int windowCount(const cv::Size& size)
{
  int count = 0;
  for (int level = 0; level < HAAR_LEVELS; ++level)
  {
    count += windowGrid(size, level).area();
  }
  return count;
}

std::vector<MarkerScores> windowScores(const cv::Mat& bgr, const MarkerNetwork& network)
{
  std::vector<MarkerScores> scores;
  scores.reserve(windowCount(bgr.size()));
  cv::Mat integral;
  cv::integral(bgr, integral, CV_32S);
  std::array<float, HAAR_FEATURES> features = {};
  for (int level = 0; level < HAAR_LEVELS; ++level)
  {
    const cv::Mat cells = haarCells(integral, level);
    const cv::Size grid = windowGrid(bgr.size(), level);
    for (int i = 0; i < grid.area(); ++i)
    {
      const cv::Point first = WINDOW_STRIDE * cv::Point(i % grid.width, i / grid.width);
      const bool contrast = haarFeatures(cells, first, features.data());
      scores.push_back(contrast ? markerScores(network, features.data()) : MarkerScores{-1, -1});
    }
  }
  return scores;
}

}  // namespace omr
