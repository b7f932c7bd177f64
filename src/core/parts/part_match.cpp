#include "part_match.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "marker_pose.h"
#include "reprojection.h"
#include "target_colors.h"
#include "target_pair.h"

namespace omr
{
namespace
{
// How far from its place a marker is looked for, in target radii and squares: half way to where it would be another.
constexpr double TARGET_REACH = 0.5;
constexpr double BOARD_REACH = 0.5;
// How near it must lie to the pose that it helped to find, to be the part's and not another's that stands there.
constexpr double TARGET_FIT = 0.1;    // radii
constexpr double MIN_TARGET_FIT = 1;  // [px]; those far away or blurred are no better
// A board's corners on average, and those of the board it was predicted from: the pose of two boards that disagree is
// between both and right for neither. One that is 4 mm off its place in the file moved it by 13 mm at 1 m, and left
// 0.6 px.
constexpr double BOARD_FIT = 0.5;        // [px]
constexpr double BLURRED_BOARD_FIT = 3;  // and of the error that the first board leaves by itself
constexpr double SAME_RAY = 1e-3;        // on the plane z = 1

/** A marker that may be the part's: its pairs, and how far the pose may leave them. */
struct Found
{
  bool is_board = false;
  int index = 0;
  std::vector<PointPair> pairs;
  double tolerance = 0;  // [px]
};

/** Pixel of a point in the camera's frame; none if it lies behind the camera. */
std::optional<cv::Point2d> pixelOf(const cv::Point3d& seen, const Camera& camera)
{
  if (!(seen.z > 0))
  {
    return std::nullopt;
  }
  return camera.project({seen}).front();
}

/** The same; none if it lies so far aside that the distortion, which is measured inside the image, folds it back. */
std::optional<cv::Point2d> predict(const cv::Point3d& seen, const Camera& camera)
{
  const std::optional<cv::Point2d> pixel = pixelOf(seen, camera);
  if (!pixel)
  {
    return std::nullopt;
  }
  const cv::Point2d ray(seen.x / seen.z, seen.y / seen.z);
  const bool is_same = cv::norm(camera.normalize({*pixel}).front() - ray) < SAME_RAY * (1 + cv::norm(ray));
  return is_same ? pixel : std::nullopt;
}

/** The length in pixels that `length` metres across the camera's axis have at a point of the part, on average. */
double pixels(double length, const cv::Affine3d& camera_part, const cv::Point3d& point, const Camera& camera)
{
  std::vector<cv::Matx23d> derivatives;
  camera.project({camera_part * point}, &derivatives);
  const cv::Matx23d& d = derivatives.front();
  return length * std::sqrt(std::abs(d(0, 0) * d(1, 1) - d(0, 1) * d(1, 0)));
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
    const ColorMatch colors = compareColors(seen.targets[index].colors, target.colors);
    contradictions += colors == ColorMatch::contradict ? 1 : 0;
    if (colors == ColorMatch::agree)
    {
      found.push_back({false,
                       index,
                       {targetPair(part, target, seen.targets[index], camera)},
                       std::max(MIN_TARGET_FIT, TARGET_FIT * radius)});
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

double boardFit(const PartHypothesis& hypothesis)
{
  return std::max(BOARD_FIT, BLURRED_BOARD_FIT * hypothesis.pose.rms_error);
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
        found.push_back({true, index, std::move(pairs), boardFit(hypothesis)});
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

/** How far a marker lies from where a pose says, over its tolerance. */
double misfit(const Found& marker, const cv::Affine3d& camera_part, const Camera& camera)
{
  double sum = 0;
  for (const PointPair& pair : marker.pairs)
  {
    const std::optional<cv::Point2d> pixel = pixelOf(seenPoint(camera_part, pair), camera);
    sum += pixel ? cv::norm(*pixel - pair.pixel) : std::numeric_limits<double>::infinity();
  }
  return sum / (static_cast<double>(marker.pairs.size()) * marker.tolerance);
}

/** Those that do not fit to the end; where the first board does not fit, or nothing does, the one that fits worst. */
std::vector<Found>::iterator separateMisfits(const Found& first, const std::vector<Pose>& poses,
                                             const cv::Affine3d& predicted, const Camera& camera,
                                             std::vector<Found>& found)
{
  const cv::Affine3d& camera_part = poses.empty() ? predicted : poses.front().camera_part;
  if (!poses.empty() && misfit(first, camera_part, camera) < 1)
  {
    return std::stable_partition(found.begin(), found.end(),
                                 [&](const Found& marker) { return misfit(marker, camera_part, camera) < 1; });
  }
  const auto worst = std::max_element(found.begin(), found.end(), [&](const Found& a, const Found& b) {
    return misfit(a, camera_part, camera) < misfit(b, camera_part, camera);
  });
  return std::rotate(worst, worst + 1, found.end());
}
}  // namespace

int PartMatch::supports() const
{
  return static_cast<int>(checkerboards.size() + targets.size()) - 1;
}

int PartMatch::score() const
{
  return supports() - contradictions;
}

PartMatch matchPart(const PartHypothesis& hypothesis, int seed, const SeenMarkers& seen, const Camera& camera)
{
  PartMatch match;
  match.part = hypothesis.part;
  const cv::Affine3d& predicted = hypothesis.pose.camera_part;
  const Found first{true, seed, hypothesis.pairs, boardFit(hypothesis)};
  std::vector<Found> found;
  findBoards(hypothesis, seed, seen, camera, found);
  findTargets(*hypothesis.part, predicted, seen, camera, found, match.contradictions);
  match.poses = {hypothesis.pose};
  // A marker that does not fit is left out. A target may be another part's or badly seen; a board whose corners all lie
  // near their places is the part's, so something is not as the file says.
  for (bool settled = found.empty(); !settled;)
  {
    match.poses = solveMarkers(allPairs(hypothesis, found), camera, {predicted});
    const auto misfits = separateMisfits(first, match.poses, predicted, camera, found);
    match.contradictions +=
        static_cast<int>(std::count_if(misfits, found.end(), [](const Found& marker) { return marker.is_board; }));
    settled = misfits == found.end();
    found.erase(misfits, found.end());
    if (found.empty())
    {
      match.poses = {hypothesis.pose};
      settled = true;
    }
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
