#include "view_collector.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
constexpr double ALIVE = 1;  // [s] since it was last heard; a camera below 1 Hz is not waited for
}

ViewCollector::ViewCollector(std::size_t cameras, double tolerance, double patience)
    : tolerance_(tolerance), patience_(patience), heard_(cameras, -1), answered_(cameras, false)
{
}

std::vector<ViewCollector::Views> ViewCollector::add(std::size_t camera, const outdoor_omr::PartArray& view, double now)
{
  std::vector<Views> done;
  heard_[camera] = now;
  const auto is_other_time = [&](const outdoor_omr::PartArray& other) {
    return std::abs((other.header.stamp - view.header.stamp).toSec()) > tolerance_;
  };
  if (answered_[camera] || std::any_of(views_.begin(), views_.end(), is_other_time))
  {
    done.push_back(take());
  }
  if (views_.empty())
  {
    first_ = now;
  }
  views_.push_back(view);
  answered_[camera] = true;
  if (complete(now))
  {
    done.push_back(take());
  }
  return done;
}

ViewCollector::Views ViewCollector::takeLate(double now)
{
  return !views_.empty() && now - first_ > patience_ ? take() : Views();
}

double ViewCollector::silence(std::size_t camera, double now) const
{
  return now - std::max(heard_[camera], 0.);
}

ViewCollector::Views ViewCollector::take()
{
  answered_.assign(answered_.size(), false);
  Views views;
  views.swap(views_);
  return views;
}

bool ViewCollector::complete(double now) const
{
  for (std::size_t camera = 0; camera < answered_.size(); ++camera)
  {
    const bool lives = heard_[camera] >= 0 && now - heard_[camera] < ALIVE;
    if (lives && !answered_[camera])
    {
      return false;
    }
  }
  return true;
}

}  // namespace omr
