#ifndef OUTDOOR_OMR_PART_TRACKER_H
#define OUTDOOR_OMR_PART_TRACKER_H

#include <cstdint>
#include <string>
#include <vector>

#include "outdoor_omr/pose_estimate.h"

namespace omr
{
/** A part as one image shows it. */
struct TrackedPart
{
  std::string name;
  PoseEstimate estimate;
  std::uint32_t id = 0;    ///< given by the tracker
  std::uint32_t copy = 0;  ///< likewise: the smallest number, from 1, that no other of its name has that it remembers
};

struct TrackerSettings
{
  double max_speed = 1;  ///< of a part [m/s]: what is farther off than it can have moved is another one
  double memory = 2;     ///< longest time out of view after which a part is still taken for the same [s]
  double smoothing = 0;  ///< time constant [s] of an exponential mean of a part at rest; 0: none
};

/**
 * Follows parts from image to image: the same part keeps its number, which no other ever gets. Nothing is predicted:
 * a part is where it was last seen, within what it can have moved since.
 *
 * Smoothing does not lag behind a move that one image shows: a pose that the noise of two measurements does not
 * explain, at odds of 1000 to 1, starts anew. Behind a creep it does, by its speed times the time constant.
 */
class PartTracker
{
 public:
  explicit PartTracker(const TrackerSettings& settings);

  /**
   * Gives every part its number, and its smoothed pose if that is asked for.
   *
   * @param parts in one frame. Several of a name are copies, told apart by place.
   * @param time  of the image [s]; earlier than the last one's: a replay begins anew, and all is forgotten.
   */
  void track(std::vector<TrackedPart>& parts, double time);

 private:
  struct Track
  {
    TrackedPart part;
    double time = 0;     // when it was last seen
    bool taken = false;  // by a part of this image
  };

  std::uint32_t freeCopy(const std::string& name) const;
  double reach(const Track& track, double time) const;
  void forget(double time);
  void smooth(const Track& track, TrackedPart& part, double time) const;

  TrackerSettings settings_;
  std::vector<Track> tracks_;
  double time_ = 0;
  std::uint32_t last_id_ = 0;
};

}  // namespace omr

#endif
