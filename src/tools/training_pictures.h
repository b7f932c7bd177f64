#ifndef OUTDOOR_OMR_TOOLS_TRAINING_PICTURES_H
#define OUTDOOR_OMR_TOOLS_TRAINING_PICTURES_H

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "marker_scene.h"
#include "training_windows.h"

namespace omr
{
/** What windows and boxes are taken from: rendered scenes with markers; and without, the photographs and rendered
 * patterns that resemble markers. Equal seeds give equal pictures, on any number of threads. */
class TrainingPictures
{
 public:
  using Drawn = std::function<bool(cv::RNG&, WindowLabel)>;
  using Wanted = std::function<bool(const float*, WindowLabel)>;

  static bool all(cv::RNG& random, WindowLabel label);
  static bool any(const float* features, WindowLabel label);

  /** @param scenes with markers; there are half as many with patterns. */
  TrainingPictures(const std::vector<cv::Mat>& photographs, int scenes);

  int withMarkers() const;
  int withoutMarkers() const;

  /** The windows that are wanted, of all pictures with markers or of all without. @param gate, drawn, wanted of
   * addWindows(). */
  WindowSet windows(bool with_markers, unsigned seed, const FeedForward& gate, const Drawn& drawn,
                    const Wanted& wanted) const;

  /** Calls with (i, random, scene) of all pictures with markers or of all without; in parallel. */
  void forEach(bool with_markers, unsigned seed,
               const std::function<void(int, cv::RNG&, const MarkerScene&)>& call) const;

 private:
  const cv::Mat& anyPhotograph(cv::RNG& random) const;
  MarkerScene picture(bool with_markers, int i, cv::RNG& random) const;

  const std::vector<cv::Mat>& photographs_;
  int scenes_;
};

}  // namespace omr

#endif
