#ifndef OUTDOOR_OMR_ROS_VIEW_COLLECTOR_H
#define OUTDOOR_OMR_ROS_VIEW_COLLECTOR_H

#include <outdoor_omr/PartArray.h>

#include <optional>
#include <vector>

namespace omr
{
/**
 * Collects what several cameras see at one time, and gives it in the order of these times. Cameras may take different
 * times to answer, more than a period: each time has a collection of its own, which is done when every camera that
 * lives has answered, or answered a later one, or when its patience ends. So a camera that is unplugged costs the
 * others a moment, and not their position.
 */
class ViewCollector
{
 public:
  using Views = std::vector<outdoor_omr::PartArray>;

  /**
   * @param cameras   number of them.
   * @param tolerance within which stamps are of one time [s].
   * @param patience  longest wait for the others after the first of a time came [s].
   */
  ViewCollector(std::size_t cameras, double tolerance, double patience);

  /**
   * A view that is not newer than what was given already comes too late and is left out; unless its camera's own stamps
   * go back, as those of a bag that begins anew: then so does all this.
   *
   * @param camera index. @param now of a steady clock that starts at 0 [s].
   * @return collections that are done, the older first.
   */
  std::vector<Views> add(std::size_t camera, const outdoor_omr::PartArray& view, double now);

  /** @return collections that waited longer than the patience, and those of earlier times; the older first. */
  std::vector<Views> takeLate(double now);

  /** Seconds since a camera was last heard; since the zero of the clock if it never was. */
  double silence(std::size_t camera, double now) const;

  /** Whether the camera's last view came too late. */
  bool isTooLate(std::size_t camera) const;

 private:
  struct Camera
  {
    double heard = -1;  // negative: never
    ros::Time newest;   // stamp of its last view
    bool is_too_late = false;
  };

  struct Collection
  {
    ros::Time stamp;  // of the first view
    double since;     // when it came
    std::vector<bool> answered;
    Views views;
  };

  Collection& collectionFor(std::size_t camera, const ros::Time& stamp, double now);
  bool isDone(const Collection& collection, double now) const;
  std::vector<Views> takeFirst(std::size_t count);

  double tolerance_;
  double patience_;
  std::vector<Camera> cameras_;
  std::vector<Collection> open_;    // the older first
  std::optional<ros::Time> given_;  // newest stamp that was given
};

}  // namespace omr

#endif
