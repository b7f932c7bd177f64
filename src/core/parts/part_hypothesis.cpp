#include "part_hypothesis.h"

#include <algorithm>

#include "board_surface.h"
#include "marker_pose.h"
#include "outdoor_omr/pose_estimate.h"

namespace omr
{
namespace
{
constexpr int QUARTERS = 4;

/** Where a section lies on a board: quarter turns from the board's x to the section's, and the board's squares that its
 * first row and column, as the board counts, cover. */
struct Placement
{
  int quarters = 0;
  int row = 0;
  int col = 0;
};

bool isTurned(int quarters)
{
  return quarters % 2 != 0;
}

/** Whether the section's own first square falls on a black one of the board. */
bool startsBlack(const Checkerboard& seen, const Placement& placement)
{
  const int height = isTurned(placement.quarters) ? seen.cols : seen.rows;
  const int width = isTurned(placement.quarters) ? seen.rows : seen.cols;
  const int row = placement.row + (placement.quarters >= 2 ? height - 1 : 0);
  const int col = placement.col + (placement.quarters == 1 || placement.quarters == 2 ? width - 1 : 0);
  return (row + col) % 2 == 0;
}

/** All placements that sizes and colours allow; one whose size is certain is the whole board. */
std::vector<Placement> placements(const Checkerboard& seen, const PartCheckerboard& board)
{
  std::vector<Placement> result;
  // All corner squares of a section with odd sides have one colour, which may be white.
  const bool color_known = seen.size_certain || seen.rows % 2 == 0 || seen.cols % 2 == 0;
  for (int quarters = 0; quarters < QUARTERS; ++quarters)
  {
    const int free_rows = board.rows - (isTurned(quarters) ? seen.cols : seen.rows);
    const int free_cols = board.cols - (isTurned(quarters) ? seen.rows : seen.cols);
    if (free_rows < 0 || free_cols < 0 || (seen.size_certain && free_rows + free_cols > 0))
    {
      continue;
    }
    for (int row = 0; row <= free_rows; ++row)
    {
      for (int col = 0; col <= free_cols; ++col)
      {
        const Placement placement{quarters, row, col};
        if (!color_known || startsBlack(seen, placement))
        {
          result.push_back(placement);
        }
      }
    }
  }
  return result;
}

/** X_board = frame * X_section. */
cv::Affine3d sectionFrame(const Checkerboard& seen, const PartCheckerboard& board, const Placement& placement)
{
  const int height = isTurned(placement.quarters) ? seen.cols : seen.rows;
  const int width = isTurned(placement.quarters) ? seen.rows : seen.cols;
  const double x = (placement.col + (width - board.cols) / 2.0) * board.square;
  const double y = (placement.row + (height - board.rows) / 2.0) * board.square;
  return touchingFrame(board, x, y) * cv::Affine3d(cv::Vec3d(0, 0, placement.quarters * CV_PI / 2));
}

/** The seen corners as those of a board of its own that has this board's squares and surface. */
std::vector<PointPair> sectionPairs(const Checkerboard& seen, const PartCheckerboard& board, bool turned)
{
  PartCheckerboard section = board;
  section.rows = seen.rows;
  section.cols = seen.cols;
  section.axis_along_x = board.axis_along_x != turned;
  section.pose = cv::Affine3d::Identity();
  const std::vector<cv::Point3d> points = innerCorners(section);
  std::vector<PointPair> pairs;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (seen.inner_corners_seen[i])
    {
      pairs.push_back({points[i], cv::Point2d(seen.inner_corners[i]), CORNER_SIGMA});
    }
  }
  return pairs;
}

/** A hypothesis of a section's pose and place: its points and pose are told in the frame of the part. */
PartHypothesis hypothesis(const Part& part, std::size_t index, const cv::Affine3d& part_section, const Pose& pose,
                          const std::vector<PointPair>& pairs)
{
  PartHypothesis result{&part, index, pose, pairs};
  const PoseEstimate of_part = movedTo({pose.camera_part, pose.covariance}, part_section.inv());
  result.pose.camera_part = of_part.pose;
  result.pose.covariance = of_part.covariance;
  for (PointPair& pair : result.pairs)
  {
    pair.point = part_section * pair.point;
  }
  return result;
}

void addHypotheses(const Checkerboard& seen, const Part& part, std::size_t index, const Camera& camera,
                   std::vector<PartHypothesis>& result)
{
  const PartCheckerboard& board = part.checkerboards[index];
  const std::vector<Placement> places = placements(seen, board);
  for (const bool turned : {false, true})
  {
    const auto fits = [&](const Placement& place) { return isTurned(place.quarters) == turned; };
    if (std::none_of(places.begin(), places.end(), fits))
    {
      continue;
    }
    const std::vector<PointPair> pairs = sectionPairs(seen, board, turned);
    for (const Pose& pose : solveMarkers(pairs, camera))
    {
      for (const Placement& place : places)
      {
        if (fits(place))
        {
          result.push_back(hypothesis(part, index, board.pose * sectionFrame(seen, board, place), pose, pairs));
        }
      }
    }
  }
}
}  // namespace

std::vector<PartHypothesis> partHypotheses(const Checkerboard& seen, const std::vector<Part>& parts,
                                           const Camera& camera)
{
  std::vector<PartHypothesis> result;
  if (std::count(seen.inner_corners_seen.begin(), seen.inner_corners_seen.end(), true) < 4)
  {
    return result;
  }
  for (const Part& part : parts)
  {
    for (std::size_t i = 0; i < part.checkerboards.size(); ++i)
    {
      addHypotheses(seen, part, i, camera, result);
    }
  }
  // The corners are the same in all: another curvature, or axis, may not explain them.
  const auto best = std::min_element(
      result.begin(), result.end(), [](const auto& a, const auto& b) { return a.pose.chi_square < b.pose.chi_square; });
  if (best != result.end())
  {
    const Pose reference = best->pose;
    const auto refuted = [&](const PartHypothesis& other) { return !isRival(reference, other.pose); };
    result.erase(std::remove_if(result.begin(), result.end(), refuted), result.end());
  }
  return result;
}

}  // namespace omr
