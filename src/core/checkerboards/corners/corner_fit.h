#ifndef OUTDOOR_OMR_CORE_CORNER_FIT_H
#define OUTDOOR_OMR_CORE_CORNER_FIT_H

#include <opencv2/core.hpp>

#include "local_frame.h"

namespace omr
{
/** Where a corner is, and how well its picture was explained. */
struct CornerFit
{
  cv::Point2f position;
  /** RMS of what the picture lacks over its contrast. Among the corners of one board that of one which something covers
   * in part is larger: the limit of the better ones is narrow. Negative: not fitted, the position is the given one. */
  float misfit = -1;
  /** Difference between opposite quadrants and the others, in the larger step across an edge: of the outer corner of a
   * square 1, of an edge 0, of four squares much more but where a shadow's edge runs along theirs. */
  float squareness = 0;
  /** The squares towards +u+v and -u-v minus the others [grey levels]. */
  float contrast = 0;
};

/**
 * Fits the picture of a corner to the pixels around it: four quadrants, each with a grey value of its own, that two
 * edges as soft as lens and pixels make them divide. All pixels along the edges count, linearly, so noise neither draws
 * the corner anywhere nor counts as an edge.
 *
 * RMS of the corners beside that of the point through which the gradients run (Foerstner & Guelch 1987), each drawn
 * towards a smooth surface: 0.039 instead of 0.088 px on 72 rendered scenes (hard shadow 0.058, 0.171), 0.049 instead
 * of 0.103 px on blurred and noisy ones.
 *
 * @param grey   CV_8UC1, not filtered.
 * @param corner position, to a pixel, and the lattice around it [px].
 * @return       the fitted position; the given one where the fit leaves the corner or the picture.
 */
CornerFit fitCorner(const cv::Mat& grey, const LocalFrame& corner);

}  // namespace omr

#endif
