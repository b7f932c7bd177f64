#include "view_collector.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace omr
{
namespace
{
constexpr double ALIVE = 1;  // [s] since it was last heard; a camera below 1 Hz is not waited for

double apart(const ros::Time& stamp, const ros::Time& other)
{
  return std::abs((stamp - other).toSec());
}
}  // namespace

ViewCollector::ViewCollector(std::size_t cameras, double tolerance, double patience)
    : tolerance_(tolerance), patience_(patience), cameras_(cameras)
{
}

std::vector<ViewCollector::Views> ViewCollector::add(std::size_t camera, const outdoor_omr::PartArray& view, double now)
{
  const ros::Time& stamp = view.header.stamp;
  std::vector<Views> given;
  Camera& own = cameras_[camera];
  if (own.heard >= 0 && stamp <= own.newest)
  {
    given = takeFirst(open_.size());
    given_.reset();
    for (Camera& other : cameras_)
    {
      other.newest = ros::Time();
    }
  }
  own.heard = now;
  own.newest = stamp;
  own.is_too_late = given_ && stamp <= *given_;
  if (own.is_too_late)
  {
    return given;
  }
  Collection& collection = collectionFor(camera, stamp, now);
  collection.answered[camera] = true;
  collection.views.push_back(view);
  // Of one that is done earlier ones are, too: a camera's views come in order.
  const auto last_done =
      std::find_if(open_.rbegin(), open_.rend(), [&](const Collection& open) { return isDone(open, now); });
  std::vector<Views> done = takeFirst(static_cast<std::size_t>(open_.rend() - last_done));
  std::move(done.begin(), done.end(), std::back_inserter(given));
  return given;
}

std::vector<ViewCollector::Views> ViewCollector::takeLate(double now)
{
  const auto last_late =
      std::find_if(open_.rbegin(), open_.rend(), [&](const Collection& open) { return now - open.since > patience_; });
  return takeFirst(static_cast<std::size_t>(open_.rend() - last_late));
}

double ViewCollector::silence(std::size_t camera, double now) const
{
  return now - std::max(cameras_[camera].heard, 0.);
}

bool ViewCollector::isTooLate(std::size_t camera) const
{
  return cameras_[camera].is_too_late;
}

/** The nearest in time that the camera is not in; a new one where none is within the tolerance. */
ViewCollector::Collection& ViewCollector::collectionFor(std::size_t camera, const ros::Time& stamp, double now)
{
  auto nearest = open_.end();
  for (auto open = open_.begin(); open != open_.end(); ++open)
  {
    if (!open->answered[camera] && apart(open->stamp, stamp) <= tolerance_ &&
        (nearest == open_.end() || apart(open->stamp, stamp) < apart(nearest->stamp, stamp)))
    {
      nearest = open;
    }
  }
  if (nearest != open_.end())
  {
    return *nearest;
  }
  const auto later =
      std::find_if(open_.begin(), open_.end(), [&](const Collection& open) { return open.stamp > stamp; });
  return *open_.insert(later, Collection{stamp, now, std::vector<bool>(cameras_.size(), false), {}});
}

bool ViewCollector::isDone(const Collection& collection, double now) const
{
  for (std::size_t camera = 0; camera < cameras_.size(); ++camera)
  {
    const bool lives = cameras_[camera].heard >= 0 && now - cameras_[camera].heard < ALIVE;
    if (lives && !collection.answered[camera] && cameras_[camera].newest <= collection.stamp)
    {
      return false;
    }
  }
  return true;
}

std::vector<ViewCollector::Views> ViewCollector::takeFirst(std::size_t count)
{
  std::vector<Views> taken;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (const outdoor_omr::PartArray& view : open_[i].views)
    {
      given_ = std::max(given_.value_or(view.header.stamp), view.header.stamp);
    }
    taken.push_back(std::move(open_[i].views));
  }
  open_.erase(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(count));
  return taken;
}

}  // namespace omr
