#include "search_map.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace omr
{
namespace
{
constexpr int MAX_FAILURES = 2;
constexpr float RADIUS = 0.15F;  // cells per pixel of the square's height: 0.3 squares, as cells are 2 px wide
}  // namespace

SearchMap::SearchMap(const cv::Size& image)
    : failures_(cv::Mat::zeros(image.height / CELL + 1, image.width / CELL + 1, CV_8UC1))
{
}

bool SearchMap::isOpen(const cv::Point2f& point) const
{
  const cv::Point cell(static_cast<int>(point.x) / CELL, static_cast<int>(point.y) / CELL);
  return cv::Rect(cv::Point(), failures_.size()).contains(cell) && failures_.at<uchar>(cell) < MAX_FAILURES;
}

void SearchMap::addFailure(const cv::Point2f& point, float square_height, int failures)
{
  const float radius = std::max(0.5F, RADIUS * square_height);  // cells
  const cv::Point2f center = point * (1.F / CELL);
  const cv::Rect around(cv::Point(cvFloor(center.x - radius), cvFloor(center.y - radius)),
                        cv::Point(cvFloor(center.x + radius) + 1, cvFloor(center.y + radius) + 1));
  const cv::Rect inside = around & cv::Rect(cv::Point(), failures_.size());
  if (!inside.empty())  // a corner near the border may be fitted outside the image
  {
    for (int y = inside.y; y < inside.br().y; ++y)
    {
      auto* row = failures_.ptr<uchar>(y);
      std::transform(row + inside.x, row + inside.br().x, row + inside.x,
                     [failures](uchar before) { return cv::saturate_cast<uchar>(before + failures); });
    }
  }
}

void SearchMap::close(const std::vector<cv::Point2f>& outline)
{
  std::vector<cv::Point> polygon;
  polygon.reserve(outline.size());
  for (const cv::Point2f& point : outline)
  {
    polygon.emplace_back(cvRound(point.x / CELL), cvRound(point.y / CELL));
  }
  cv::fillPoly(failures_, std::vector<std::vector<cv::Point>>{polygon}, cv::Scalar(255));
}

}  // namespace omr
