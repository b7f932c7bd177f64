#ifndef OUTDOOR_OMR_ROS_VIEW_COLLECTOR_H
#define OUTDOOR_OMR_ROS_VIEW_COLLECTOR_H

#include <outdoor_omr/PartArray.h>

#include <vector>

namespace omr
{
/**
 * Collects what several cameras see at one time. A collection is complete when every camera that lives has answered, so
 * one that is unplugged costs the others a moment, once, and not their position.
 */
class ViewCollector
{
 public:
  using Views = std::vector<outdoor_omr::PartArray>;

  /**
   * @param cameras   number of them.
   * @param tolerance within which stamps are of one time [s].
   * @param patience  longest wait for the others after the first came [s].
   */
  ViewCollector(std::size_t cameras, double tolerance, double patience);

  /**
   * @param camera index. @param now of a steady clock that starts at 0 [s].
   * @return collections that this completes, the older first: none, one, or two.
   */
  std::vector<Views> add(std::size_t camera, const outdoor_omr::PartArray& view, double now);

  /** @return what waited longer than the patience; empty if nothing did. */
  Views takeLate(double now);

  /** Seconds since a camera was last heard; since the zero of the clock if it never was. */
  double silence(std::size_t camera, double now) const;

 private:
  Views take();
  bool complete(double now) const;

  double tolerance_;
  double patience_;
  double first_ = 0;           // when the first of the collection came
  std::vector<double> heard_;  // negative: never
  std::vector<bool> answered_;
  Views views_;
};

}  // namespace omr

#endif
