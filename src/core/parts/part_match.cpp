#include "part_match.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>

#include "marker_pose.h"
#include "reprojection.h"
#include "target_pair.h"

namespace omr
{
namespace
{
// How far from its place a marker is looked for, in target radii and squares: half way to where it would be another.
constexpr double TARGET_REACH = 0.5;
constexpr double BOARD_REACH = 0.5;
// How near it must lie to the pose that it helped to find, to be the part's and not another's that stands there: a
// target in radii, a board's corners, on average, in squares.
constexpr double TARGET_FIT = 0.1;
constexpr double BOARD_FIT = 0.1;
constexpr double MIN_FIT = 1;  // [px]; markers far away or blurred are no better

/** A marker that may be the part's: its pairs, and how far the pose may leave them. */
struct Found
{
  bool is_board = false;
  int index = 0;
  std::vector<PointPair> pairs;
  double tolerance = 0;  // [px]
};

/** Pixel of a point in the camera's frame; none if it lies behind the camera. */
std::optional<cv::Point2d> predict(const cv::Point3d& seen, const Camera& camera)
{
  if (!(seen.z > 0))
  {
    return std::nullopt;
  }
  return camera.project({seen}).front();
}

/** The length in pixels that `length` metres have at a point of the part. */
double pixels(double length, const cv::Affine3d& camera_part, const cv::Point3d& point, const Camera& camera)
{
  return camera.focalLength() * length / (camera_part * point).z;
}

/** What the colours of a target say of the one that the part has in its place. */
enum class Colors
{
  agree,    ///< unknown letters agree with all
  unclear,  ///< a ring lost or found at the middle or the rim: PRPG for PGRPG at 4 px a ring, ?PGRPG or GRGP half
            ///< hidden
  contradict
};

bool agree(std::string_view seen, std::string_view expected)
{
  return std::equal(seen.begin(), seen.end(), expected.begin(), expected.end(),
                    [](char a, char b) { return a == b || a == '?'; });
}

Colors compare(std::string_view seen, std::string_view expected)
{
  if (agree(seen, expected))
  {
    return Colors::agree;
  }
  if (seen.size() > expected.size())
  {
    const bool is_inner = agree(seen.substr(0, expected.size()), expected);
    const bool is_outer = agree(seen.substr(seen.size() - expected.size()), expected);
    return is_inner || is_outer ? Colors::unclear : Colors::contradict;
  }
  // An outermost ring that is hidden.
  if (seen.size() > 2 && agree(seen, expected.substr(0, seen.size())))
  {
    return Colors::unclear;
  }
  // Of rings that run together the innermost letter is a mixture.
  const bool outer_agree = seen.size() > 2 && seen.size() < expected.size() &&
                           agree(seen.substr(1), expected.substr(expected.size() - seen.size() + 1));
  return outer_agree ? Colors::unclear : Colors::contradict;
}

/** The free target nearest to a pixel; -1 if none lies within reach. */
int nearestTarget(const cv::Point2d& pixel, double reach, const SeenMarkers& seen)
{
  int nearest = -1;
  for (std::size_t i = 0; i < seen.targets.size(); ++i)
  {
    const double distance = cv::norm(seen.targets[i].center - pixel);
    if (seen.target_free[i] && distance < reach)
    {
      nearest = static_cast<int>(i);
      reach = distance;
    }
  }
  return nearest;
}

void findTargets(const Part& part, const cv::Affine3d& camera_part, const SeenMarkers& seen, const Camera& camera,
                 std::vector<Found>& found, int& contradictions)
{
  for (const PartTarget& target : part.targets)
  {
    const std::optional<cv::Point2d> pixel = predict(camera_part * target.center, camera);
    if (!pixel)
    {
      continue;
    }
    const double radius =
        pixels(target.ring * static_cast<double>(target.colors.size()), camera_part, target.center, camera);
    const int index = nearestTarget(*pixel, TARGET_REACH * radius, seen);
    if (index < 0)
    {
      continue;
    }
    const Colors colors = compare(seen.targets[index].colors, target.colors);
    contradictions += colors == Colors::contradict ? 1 : 0;
    if (colors == Colors::agree)
    {
      found.push_back({false,
                       index,
                       {targetPair(part, target, seen.targets[index], camera)},
                       std::max(MIN_FIT, TARGET_FIT * radius)});
    }
  }
}

/** The seen corners of a board as those of the part that they are nearest to; empty if it does not lie there. */
std::vector<PointPair> boardPairs(const Checkerboard& seen, const std::vector<cv::Point3d>& points,
                                  const std::vector<cv::Point2d>& predicted, double reach)
{
  std::vector<PointPair> pairs;
  std::vector<bool> taken(points.size());
  for (std::size_t i = 0; i < seen.inner_corners.size(); ++i)
  {
    const cv::Point2d pixel(seen.inner_corners[i]);
    const auto nearest = std::min_element(
        predicted.begin(), predicted.end(),
        [&](const cv::Point2d& a, const cv::Point2d& b) { return cv::norm(a - pixel) < cv::norm(b - pixel); });
    const std::size_t index = nearest - predicted.begin();
    if (cv::norm(*nearest - pixel) > reach || taken[index])
    {
      return {};
    }
    taken[index] = true;
    if (seen.inner_corners_seen[i])
    {
      pairs.push_back({points[index], pixel, CORNER_SIGMA});
    }
  }
  return pairs;
}

/** Whether the camera sees the printed side. */
bool faces(const cv::Affine3d& camera_board)
{
  const cv::Vec3d into(camera_board.rotation() * cv::Vec3d(0, 0, 1));
  return into.dot(camera_board.translation()) > 0;
}

void findBoards(const PartHypothesis& hypothesis, int seed, const SeenMarkers& seen, const Camera& camera,
                std::vector<Found>& found)
{
  const cv::Affine3d& camera_part = hypothesis.pose.camera_part;
  for (std::size_t b = 0; b < hypothesis.part->checkerboards.size(); ++b)
  {
    const PartCheckerboard& board = hypothesis.part->checkerboards[b];
    if (b == hypothesis.board || !faces(camera_part * board.pose))
    {
      continue;
    }
    const std::vector<cv::Point3d> points = innerCorners(board);
    std::vector<cv::Point3d> in_camera;
    std::transform(points.begin(), points.end(), std::back_inserter(in_camera),
                   [&](const cv::Point3d& point) { return camera_part * point; });
    if (std::any_of(in_camera.begin(), in_camera.end(), [](const cv::Point3d& point) { return !(point.z > 0); }))
    {
      continue;
    }
    const std::vector<cv::Point2d> predicted = camera.project(in_camera);
    const double square = pixels(board.square, camera_part, cv::Point3d(board.pose.translation()), camera);
    for (std::size_t i = 0; i < seen.checkerboards.size(); ++i)
    {
      const int index = static_cast<int>(i);
      if (!seen.checkerboard_free[i] || index == seed)
      {
        continue;
      }
      std::vector<PointPair> pairs = boardPairs(seen.checkerboards[i], points, predicted, BOARD_REACH * square);
      if (!pairs.empty())
      {
        found.push_back({true, index, std::move(pairs), std::max(MIN_FIT, BOARD_FIT * square)});
        break;
      }
    }
  }
}

std::vector<PointPair> allPairs(const PartHypothesis& hypothesis, const std::vector<Found>& found)
{
  std::vector<PointPair> pairs = hypothesis.pairs;
  for (const Found& marker : found)
  {
    pairs.insert(pairs.end(), marker.pairs.begin(), marker.pairs.end());
  }
  return pairs;
}

/** Whether a marker lies where a pose says. */
bool fits(const Found& marker, const cv::Affine3d& camera_part, const Camera& camera)
{
  double sum = 0;
  for (const PointPair& pair : marker.pairs)
  {
    const std::optional<cv::Point2d> pixel = predict(seenPoint(camera_part, pair), camera);
    sum += pixel ? cv::norm(*pixel - pair.pixel) : std::numeric_limits<double>::infinity();
  }
  return sum / static_cast<double>(marker.pairs.size()) < marker.tolerance;
}
}  // namespace

int PartMatch::score() const
{
  return static_cast<int>(checkerboards.size() + targets.size()) - 1 - contradictions;
}

PartMatch matchPart(const PartHypothesis& hypothesis, int seed, const SeenMarkers& seen, const Camera& camera)
{
  PartMatch match;
  match.part = hypothesis.part;
  std::vector<Found> found;
  findBoards(hypothesis, seed, seen, camera, found);
  findTargets(*hypothesis.part, hypothesis.pose.camera_part, seen, camera, found, match.contradictions);
  match.poses = {hypothesis.pose};
  // A marker that does not fit is left out: it may be another part's, or badly seen.
  for (bool settled = found.empty(); !settled;)
  {
    match.poses = solveMarkers(allPairs(hypothesis, found), camera);
    if (match.poses.empty())
    {
      return match;
    }
    const cv::Affine3d& camera_part = match.poses.front().camera_part;
    const auto misfit = std::stable_partition(found.begin(), found.end(),
                                              [&](const Found& marker) { return fits(marker, camera_part, camera); });
    settled = misfit == found.end();
    found.erase(misfit, found.end());
  }
  match.checkerboards = {seed};
  for (const Found& marker : found)
  {
    (marker.is_board ? match.checkerboards : match.targets).push_back(marker.index);
  }
  std::sort(match.checkerboards.begin(), match.checkerboards.end());
  std::sort(match.targets.begin(), match.targets.end());
  return match;
}

}  // namespace omr
