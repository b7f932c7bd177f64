#ifndef OUTDOOR_OMR_TARGET_H
#define OUTDOOR_OMR_TARGET_H

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace omr
{
/** One target of concentric rings (paper, section 3.3). Positions in pixels, pixel (0, 0) has its centre at (0, 0). */
struct Target
{
  /** Colours from the inner disk outwards: W white, P black, R red, G green, B blue, ? unknown. */
  std::string colors;

  /** Image of the circles' common centre; under perspective it is not the centre of the ellipses. */
  cv::Point2d center;

  /** Outer boundary of each ring as an ellipse, on a bent sheet the nearest one, in the order of colors; size holds
   * full axes [px], angle degrees. */
  std::vector<cv::RotatedRect> rings;

  /**
   * Standard deviation that the noise of the pixels gives the centre of the outermost ellipse, each coordinate [px]:
   * the larger, the less of the rings shows. Shadows, gloss and uneven sheets come on top; errors were 0.6 to 2.4 times
   * this on rendered scenes (RMS of a set). 0: not known, as on bent sheets.
   */
  double outermost_deviation = 0;
};

}  // namespace omr

#endif
