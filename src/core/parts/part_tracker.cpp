#include "outdoor_omr/part_tracker.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
constexpr double CHI_SQUARE_999 = 22.458;  // of six coordinates
constexpr double JITTER = 0.01;            // [m] that a pose may jump at rest: far parts, along the ray

double distance(const TrackedPart& a, const TrackedPart& b)
{
  return cv::norm(a.estimate.pose.translation() - b.estimate.pose.translation());
}
}  // namespace

PartTracker::PartTracker(const TrackerSettings& settings) : settings_(settings)
{
}

void PartTracker::track(std::vector<TrackedPart>& parts, double time)
{
  forget(time);
  struct Pair
  {
    double distance = 0;
    TrackedPart* part = nullptr;
    Track* track = nullptr;
  };
  std::vector<Pair> pairs;
  for (TrackedPart& part : parts)
  {
    part.id = 0;
    for (Track& track : tracks_)
    {
      const double apart = distance(part, track.part);
      if (part.name == track.part.name && apart <= reach(track, time))
      {
        pairs.push_back({apart, &part, &track});
      }
    }
  }
  // Nearest first: a copy takes the number of the one that it can hardly not be.
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
  for (const Pair& pair : pairs)
  {
    if (pair.part->id == 0 && !pair.track->taken)
    {
      pair.part->id = pair.track->part.id;
      pair.part->copy = pair.track->part.copy;
      smooth(*pair.track, *pair.part, time);
      *pair.track = {*pair.part, time, true};
    }
  }
  for (TrackedPart& part : parts)
  {
    if (part.id == 0)
    {
      part.id = ++last_id_;
      part.copy = freeCopy(part.name);
      tracks_.push_back({part, time, true});
    }
  }
}

std::uint32_t PartTracker::freeCopy(const std::string& name) const
{
  const auto is_taken = [&](std::uint32_t copy) {
    return std::any_of(tracks_.begin(), tracks_.end(),
                       [&](const Track& track) { return track.part.name == name && track.part.copy == copy; });
  };
  std::uint32_t copy = 1;
  while (is_taken(copy))
  {
    ++copy;
  }
  return copy;
}

double PartTracker::reach(const Track& track, double time) const
{
  return JITTER + settings_.max_speed * (time - track.time);
}

void PartTracker::forget(double time)
{
  if (time < time_)
  {
    tracks_.clear();
  }
  time_ = time;
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(),
                               [&](const Track& track) { return time - track.time > settings_.memory; }),
                tracks_.end());
  for (Track& track : tracks_)
  {
    track.taken = false;
  }
}

void PartTracker::smooth(const Track& track, TrackedPart& part, double time) const
{
  if (settings_.smoothing <= 0)
  {
    return;
  }
  const cv::Vec6d step = stepBetween(track.part.estimate.pose, part.estimate.pose);
  bool invertible = false;
  const cv::Matx66d information =
      (track.part.estimate.covariance + part.estimate.covariance).inv(cv::DECOMP_CHOLESKY, &invertible);
  if (!invertible || step.dot(information * step) > CHI_SQUARE_999)
  {
    return;
  }
  const double weight = 1 - std::exp(-(time - track.time) / settings_.smoothing);
  part.estimate.pose = stepped(track.part.estimate.pose, step * weight);
}

}  // namespace omr
