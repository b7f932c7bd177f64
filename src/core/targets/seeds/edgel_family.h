#ifndef OUTDOOR_OMR_CORE_EDGEL_FAMILY_H
#define OUTDOOR_OMR_CORE_EDGEL_FAMILY_H

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "targets/edges/edgels.h"
#include "targets/family/ring_family.h"

namespace omr
{
constexpr double MAX_SINE = .1;  ///< between an edgel's gradient and the radius: the edgel fits the family

/**
 * The family without perspective whose circles have the edgels' directions where the edgels are.
 *
 * @param origin, scale place and size of the edgels, for the sake of rounding [px].
 * @return              false if there is none, or a far too oblique one.
 */
bool familyOf(const std::array<Edgel, 4>& edgels, const cv::Point2d& origin, double scale, RingFamily& family);

/** Weighted least squares over the edgels that fit the family already; parameters and result of familyOf(). */
bool refineFamilyShape(const std::vector<Edgel>& edgels, const cv::Point2d& origin, double scale, RingFamily& family);

}  // namespace omr

#endif
