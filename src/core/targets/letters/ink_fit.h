#ifndef OUTDOOR_OMR_CORE_INK_FIT_H
#define OUTDOOR_OMR_CORE_INK_FIT_H

#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "ink_rest.h"

namespace omr
{
/**
 * Explains samples along a ray by rings of the key's inks, seen through the blur of lens and camera. What is around
 * them is taken for white, or a ring that is brighter; an ink may be a little off. So of rings that the blur merges
 * those are taken whose mixture is seen.
 */
class InkFit
{
 public:
  struct Result
  {
    double rest = std::numeric_limits<double>::infinity();  ///< squared deviations of samples and inks
    std::vector<int> letters;                               ///< of the rings, indices into LETTER
    double haze = 0;                                        ///< share of white in each ink
    cv::Vec2d deviations;                                   ///< of the blur of brightness, of hue [px]
  };

  /**
   * @param samples brightness and hue, from the centre outwards, the last one of what is around; must outlive this.
   * @param step    between them [px].
   * @param scale   pixels of these a pixel of the camera, which tells how wide its blur is.
   * @param ground  on which the rings lie.
   */
  InkFit(const std::vector<cv::Vec3d>& samples, double step, double scale, Ground ground);

  /** Whether what is around is taken for white. */
  bool isOnWhite() const;

  /** Takes the blur with which one of these is explained best; before it, the usual one counts. */
  void chooseBlur(const std::vector<std::vector<double>>& sets_of_radii);

  /** @param radii of the boundaries, ascending, not empty [px]. */
  Result explain(const std::vector<double>& radii) const;

  /** The same behind haze, which mixes each ink with white: of several hazes and blurs those that explain most. */
  Result explainInHaze(const std::vector<double>& radii) const;

  /** How sure the letters are, of each ring. */
  struct Doubts
  {
    std::vector<double> margins;   ///< further rest if the ring had another letter
    std::vector<double> excesses;  ///< what its ink leaves that any colour in its place would not
  };

  /** @param result of the same radii. */
  Doubts doubts(const std::vector<double>& radii, const Result& result) const;

 private:
  class Sequence;

  Result explain(const InkRest& rest, const std::vector<double>& radii, double haze) const;
  template <typename Call>
  void forEachBlur(const std::vector<double>& radii, const Call& call) const;

  RaySamples source_;
  cv::Vec2d deviations_;  // of the blur of brightness, of hue [px]
};

}  // namespace omr

#endif
