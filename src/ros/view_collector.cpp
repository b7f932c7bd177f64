#include "view_collector.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace omr
{
namespace
{
constexpr double ALIVE = 1;            // [s] since it was last heard, or
constexpr double ALIVE_INTERVALS = 3;  // so many times that between its last views: cameras may be triggered by hand
constexpr double BACK = 1;             // [s] by which stamps go back where they begin anew
constexpr double HOLD = 1;             // [s] for which a wrong stamp, or what is on its way still, can do harm
}  // namespace

ViewCollector::ViewCollector(std::size_t cameras, double tolerance, double patience)
    : tolerance_(tolerance), patience_(patience), cameras_(cameras)
{
}

std::vector<ViewCollector::Collection> ViewCollector::add(std::size_t camera, const outdoor_omr::PartArray& view,
                                                          double now)
{
  const double stamp = view.header.stamp.toSec();
  std::vector<Collection> given;
  Camera& own = cameras_[camera];
  const bool goes_back = own.heard >= 0 && stamp < own.newest - BACK;
  if (goes_back && !own.is_behind)
  {
    given = takeFirst(open_.size(), now);
    beginAnew(now);
  }
  own.is_behind = own.is_behind && !goes_back && now - begun_at_ < HOLD;
  own.interval = own.heard >= 0 ? now - own.heard : 0;
  own.heard = now;
  const bool is_repeated = !goes_back && own.newest > 0 && stamp <= own.newest;
  const bool is_old = given_at_ >= 0 && now - given_at_ < HOLD && stamp <= given_ && stamp > 0;
  own.is_too_late = is_repeated || is_old;
  if (own.is_too_late || own.is_behind)
  {
    return given;
  }
  own.newest = stamp;
  Open& open = collectionFor(camera, view.header.stamp, now);
  open.answered[camera] = true;
  open.views.push_back(view);
  // Of one that is done earlier ones are, too: a camera's views come in order.
  const auto last_done = std::find_if(open_.rbegin(), open_.rend(), [&](const Open& any) { return isDone(any, now); });
  std::vector<Collection> done = takeFirst(static_cast<std::size_t>(open_.rend() - last_done), now);
  std::move(done.begin(), done.end(), std::back_inserter(given));
  return given;
}

std::vector<ViewCollector::Collection> ViewCollector::takeLate(double now)
{
  const auto last_late =
      std::find_if(open_.rbegin(), open_.rend(), [&](const Open& open) { return now - open.since > patience_; });
  return takeFirst(static_cast<std::size_t>(open_.rend() - last_late), now);
}

double ViewCollector::silence(std::size_t camera, double now) const
{
  return now - std::max(cameras_[camera].heard, 0.);
}

bool ViewCollector::isTooLate(std::size_t camera) const
{
  return cameras_[camera].is_too_late;
}

void ViewCollector::beginAnew(double now)
{
  begun_at_ = now;
  given_at_ = -1;
  for (Camera& camera : cameras_)
  {
    camera.is_behind = camera.heard >= 0;
  }
}

/** The nearest in time that the camera is not in; a new one where none is within the tolerance. */
ViewCollector::Open& ViewCollector::collectionFor(std::size_t camera, const ros::Time& stamp, double now)
{
  const auto apart = [&](const Open& open) { return std::abs(open.stamp.toSec() - stamp.toSec()); };
  auto nearest = open_.end();
  for (auto open = open_.begin(); open != open_.end(); ++open)
  {
    if (!open->answered[camera] && apart(*open) <= tolerance_ &&
        (nearest == open_.end() || apart(*open) < apart(*nearest)))
    {
      nearest = open;
    }
  }
  if (nearest != open_.end())
  {
    return *nearest;
  }
  const auto later = std::find_if(open_.begin(), open_.end(), [&](const Open& open) { return open.stamp > stamp; });
  return *open_.insert(later, Open{{stamp, {}}, now, std::vector<bool>(cameras_.size(), false)});
}

bool ViewCollector::lives(const Camera& camera, double now) const
{
  return camera.heard >= 0 && now - camera.heard < std::max(ALIVE, ALIVE_INTERVALS * camera.interval);
}

bool ViewCollector::isDone(const Open& open, double now) const
{
  for (std::size_t camera = 0; camera < cameras_.size(); ++camera)
  {
    const bool has_passed = !cameras_[camera].is_behind && cameras_[camera].newest > open.stamp.toSec();
    if (!open.answered[camera] && !has_passed && lives(cameras_[camera], now))
    {
      return false;
    }
  }
  return true;
}

std::vector<ViewCollector::Collection> ViewCollector::takeFirst(std::size_t count, double now)
{
  std::vector<Collection> taken;
  for (std::size_t i = 0; i < count; ++i)
  {
    given_ = open_[i].stamp.toSec();
    given_at_ = now;
    taken.push_back(std::move(open_[i]));
  }
  open_.erase(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(count));
  return taken;
}

}  // namespace omr
