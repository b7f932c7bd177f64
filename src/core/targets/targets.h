#ifndef OUTDOOR_OMR_CORE_TARGETS_H
#define OUTDOOR_OMR_CORE_TARGETS_H

#include <memory>
#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/frame.h"
#include "outdoor_omr/region.h"
#include "outdoor_omr/settings.h"
#include "outdoor_omr/target.h"

namespace omr
{
/**
 * Finds all targets of concentric colour rings and reads their colours (paper, section 3.3).
 *
 * @param frame    the image.
 * @param regions  its regions.
 * @param boards   its checkerboards: what lies on them, where they show, is no target.
 * @param settings the tunables of group "target".
 */
std::vector<Target> findTargets(const Frame& frame, const RegionMap& regions, const std::vector<Checkerboard>& boards,
                                const Settings& settings);

/** The same in parts, of which all but the last may run beside other work, in a thread of their own. */
class TargetSearch
{
 public:
  /** @param bgr H x W, CV_8UC3; shared, not copied. */
  TargetSearch(const cv::Mat& bgr, const Settings& settings);
  ~TargetSearch();
  TargetSearch(const TargetSearch&) = delete;
  TargetSearch& operator=(const TargetSearch&) = delete;

  /** Finds most targets; the image suffices for that. finish() gives the same with and without it. */
  void lookAtImage();

  /**
   * Looks for small round places; likewise, and may run beside lookAtImage().
   *
   * @param grey of the image, CV_8UC1, as Frame::raw_grey.
   */
  void lookAtGrey(const cv::Mat& grey);

  /** Names the boards that there seem to be. */
  void expect(const std::vector<Checkerboard>& boards);

  /** After expect(): finds all targets; likewise. */
  void lookAtRest(const RegionMap& regions);

  /** Names the boards that there are; may be called beside lookAtRest(), which soon ends if other ones were expected.
   */
  void confirm(const std::vector<Checkerboard>& boards);

  /** What findTargets() gives. */
  std::vector<Target> finish(const RegionMap& regions, const std::vector<Checkerboard>& boards);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace omr

#endif
