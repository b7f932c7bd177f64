#include "outdoor_omr/window_scores.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

namespace omr
{
namespace
{
MarkerScores scoresOf(const cv::Mat& cells, const cv::Point& index, const MarkerNetwork& network)
{
  std::array<float, HAAR_FEATURES> features;
  return haarFeatures(cells, WINDOW_STRIDE * index, features.data()) ? markerScores(network, features.data())
                                                                     : MarkerScores{-1, -1};
}

/** @param scores of the windows of the level, which are -1 yet. */
void scoreLevel(const cv::Mat& cells, const cv::Size& grid, const MarkerNetwork& network, MarkerScores* scores)
{
  std::vector<cv::Point> followed;
  for (int y = 0; y < grid.height; y += 2)
  {
    for (int x = 0; x < grid.width; x += 2)
    {
      if (passesGate(cells, WINDOW_STRIDE * cv::Point(x, y), network.gate))
      {
        const MarkerScores own = scoresOf(cells, {x, y}, network);
        scores[y * grid.width + x] = own;
        if (std::max(own[0], own[1]) > FOLLOWED_SCORE)
        {
          followed.emplace_back(x, y);
        }
      }
    }
  }
  cv::Mat beside = cv::Mat::zeros(grid, CV_8UC1);
  for (const cv::Point& at : followed)
  {
    beside(cv::Rect(at.x - 1, at.y - 1, 3, 3) & cv::Rect({}, grid)) = 1;
  }
  for (int i = 0; i < grid.area(); ++i)
  {
    const cv::Point index(i % grid.width, i / grid.width);
    if (beside.at<uchar>(index) != 0 && (index.x % 2 != 0 || index.y % 2 != 0))
    {
      scores[i] = scoresOf(cells, index, network);
    }
  }
}
}  // namespace

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
  std::vector<MarkerScores> scores(windowCount(bgr.size()), MarkerScores{-1, -1});
  cv::Mat integral;
  cv::integral(bgr, integral, CV_32S);
  MarkerScores* of_level = scores.data();
  for (int level = 0; level < HAAR_LEVELS; ++level)
  {
    const cv::Size grid = windowGrid(bgr.size(), level);
    scoreLevel(haarCells(integral, level), grid, network, of_level);
    of_level += grid.area();
  }
  return scores;
}

bool passesGate(const cv::Mat& cells, const cv::Point& first, const FeedForward& gate)
{
  if (gate.hidden == 0)
  {
    return true;
  }
  std::array<float, GATE_INPUTS> inputs;
  return gateInputs(cells, first, inputs.data()) && gate.passes(markerScores(gate, GATE_INPUTS, inputs.data()));
}

}  // namespace omr
