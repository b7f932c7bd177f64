#include "ring_places.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace omr
{
namespace
{
constexpr double UNDISPUTED = .85;  // evidence x visible share of a candidate that no other seed will better
constexpr double NEAR = 1.1;        // squares: on a board that shows there is a corner

bool contains(const RingCandidate& candidate, const cv::Point2d& point)
{
  return cv::norm(candidate.rings.family.toPlane(point)) < candidate.rings.radii.back();
}

bool isUndisputed(const RingCandidate& candidate)
{
  return !candidate.is_merged && candidate.evidence * candidate.visible > UNDISPUTED;
}

/** Whether a corner of the board is seen beside a point. @param square side of a square [px] */
bool showsNear(const Checkerboard& board, const cv::Point2d& point, double square)
{
  for (std::size_t i = 0; i < board.inner_corners.size(); ++i)
  {
    if (board.inner_corners_seen[i] && cv::norm(cv::Point2d(board.inner_corners[i]) - point) < NEAR * square)
    {
      return true;
    }
  }
  return false;
}
}  // namespace

double score(const RingCandidate& candidate)
{
  return candidate.is_merged
             ? 0
             : candidate.evidence * candidate.visible * static_cast<double>(candidate.boundaries.size());
}

bool isOnBoard(const cv::Point2d& point, const std::vector<Checkerboard>& boards)
{
  return std::any_of(boards.begin(), boards.end(), [&](const Checkerboard& board) {
    const std::vector<cv::Point2f> outline(board.corners.begin(), board.corners.end());
    return cv::pointPolygonTest(outline, point, false) > 0 &&
           showsNear(board, point, std::sqrt(cv::contourArea(outline) / (board.rows * board.cols)));
  });
}

bool isInUndisputed(const std::vector<RingCandidate>& candidates, const cv::Point2d& point)
{
  return std::any_of(candidates.begin(), candidates.end(), [&](const RingCandidate& candidate) {
    return isUndisputed(candidate) && contains(candidate, point);
  });
}

bool isInAny(const std::vector<RingCandidate>& candidates, const cv::Point2d& point)
{
  return std::any_of(candidates.begin(), candidates.end(),
                     [&](const RingCandidate& candidate) { return contains(candidate, point); });
}

bool isInAny(const std::vector<RingCandidate>& candidates, const RingCandidate& other)
{
  return std::any_of(candidates.begin(), candidates.end(), [&](const RingCandidate& candidate) {
    return contains(other, candidate.rings.family.center) || contains(candidate, other.rings.family.center);
  });
}

std::vector<RingCandidate> bestOfEachPlace(std::vector<RingCandidate> candidates)
{
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const RingCandidate& left, const RingCandidate& right) { return score(left) > score(right); });
  std::vector<RingCandidate> best;
  for (RingCandidate& candidate : candidates)
  {
    if (!isInAny(best, candidate))
    {
      best.push_back(std::move(candidate));
    }
  }
  return best;
}

}  // namespace omr
