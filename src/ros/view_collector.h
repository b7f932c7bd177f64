#ifndef OUTDOOR_OMR_ROS_VIEW_COLLECTOR_H
#define OUTDOOR_OMR_ROS_VIEW_COLLECTOR_H

#include <outdoor_omr/PartArray.h>

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
  struct Collection
  {
    ros::Time stamp;  ///< of the view that came first
    std::vector<outdoor_omr::PartArray> views;
  };

  /**
   * @param cameras   number of them.
   * @param tolerance within which stamps are of one time [s].
   * @param patience  longest wait for the others after the first of a time came [s].
   */
  ViewCollector(std::size_t cameras, double tolerance, double patience);

  /**
   * A view that is not newer than what was given within the last second comes too late and is left out. Stamps that go
   * back by more than a second, as those of a bag that begins anew, begin everything anew.
   *
   * @param camera index. @param now of a steady clock that starts at 0 [s].
   * @return collections that are done, the older first.
   */
  std::vector<Collection> add(std::size_t camera, const outdoor_omr::PartArray& view, double now);

  /** @return collections that waited longer than the patience, and those of earlier times; the older first. */
  std::vector<Collection> takeLate(double now);

  /** Seconds since a camera was last heard; since the zero of the clock if it never was. */
  double silence(std::size_t camera, double now) const;

  /** Whether the camera's last view came too late. */
  bool isTooLate(std::size_t camera) const;

 private:
  struct Camera
  {
    double heard = -1;       // negative: never
    double interval = 0;     // between its last two views
    double newest = 0;       // stamp of its last view
    bool is_behind = false;  // of those before the last beginning, whose last views may come still
    bool is_too_late = false;
  };

  struct Open : Collection
  {
    double since;  // when the first view came
    std::vector<bool> answered;
  };

  void beginAnew(double now);
  Open& collectionFor(std::size_t camera, const ros::Time& stamp, double now);
  bool lives(const Camera& camera, double now) const;
  bool isDone(const Open& open, double now) const;
  std::vector<Collection> takeFirst(std::size_t count, double now);

  double tolerance_;
  double patience_;
  std::vector<Camera> cameras_;
  std::vector<Open> open_;  // the older first
  double given_ = 0;        // newest stamp that was given
  double given_at_ = -1;    // when; negative: never
  double begun_at_ = 0;
};

}  // namespace omr

#endif
