#ifndef OUTDOOR_OMR_CORE_RING_REFINEMENT_H
#define OUTDOOR_OMR_CORE_RING_REFINEMENT_H

#include <vector>

#include "ring_family.h"

namespace omr
{
/** A point of an edge on the outer boundary of a ring. */
struct BoundaryPoint
{
  cv::Point2d position;  ///< [px]
  int ring = 0;          ///< index into the radii
  double certainty = 1;  ///< factor of its distance to the circle
};

/** Keeps at most max_points, evenly taken. */
void thin(std::vector<BoundaryPoint>& points, std::size_t max_points);

/** Perspective moves a circle's rim by h R of its radius. A sheet filling a third of a wide-angle picture gives this.
 */
constexpr double USUAL_PERSPECTIVE = 0.05;
constexpr double LARGEST_PERSPECTIVE = 0.35;  ///< beyond it no marker can be read

/** Of a fit: holds det A at 1, which the radii would else share. */
constexpr double GAUGE_WEIGHT = 1e4;

/** Largest number of boundaries that refineFamily() takes. */
constexpr int MAX_BOUNDARIES = 16;

/**
 * Least squares fit of the family and of the radii to edgels, robust (Tukey) and damped (Levenberg-Marquardt). The
 * radii are free: gamma and sharpening shift the boundaries to either side.
 *
 * @param perspective also estimate h, which needs two boundaries at least.
 * @param usual_perspective that of the outermost circle, which h is drawn to.
 * @param family, radii the start; receive the result.
 * @return            RMS distance of the points that count [px], times their certainty; infinity, with nothing
 *                    changed, if there is no plausible solution.
 */
double refineFamily(const std::vector<BoundaryPoint>& points, bool perspective, RingFamily& family,
                    std::vector<double>& radii, double usual_perspective = USUAL_PERSPECTIVE);

/**
 * Standard deviation of the centre of the outermost circle's ellipse, each coordinate [px], where refineFamily() fitted
 * the family to the points, with perspective: from the Jacobian and the residuals. Residuals below 1, the standard
 * deviation of a point, are taken for chance. 0: the points do not determine the family.
 */
double outermostDeviation(const std::vector<BoundaryPoint>& points, const RingFamily& family,
                          const std::vector<double>& radii, double usual_perspective);

}  // namespace omr

#endif
