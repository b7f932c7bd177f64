#ifndef OUTDOOR_OMR_CORE_ARC_SEARCH_H
#define OUTDOOR_OMR_CORE_ARC_SEARCH_H

#include <opencv2/core.hpp>
#include <vector>

#include "arc_families.h"

namespace omr
{
/** By how much images of a size are reduced before their arcs are traced, each side. */
int arcReduction(const cv::Size& image_size);

/**
 * Families of concentric circles in an image by the arcs of their edges, at a resolution at which half a million pixels
 * are left: arcs of circles of some 15 px and more show there, noise does not.
 *
 * @param bgr H x W, CV_8UC3.
 * @return    the one with most arcs first.
 */
std::vector<ArcFamily> searchArcFamilies(const cv::Mat& bgr);

}  // namespace omr

#endif
