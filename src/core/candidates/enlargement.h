#ifndef OUTDOOR_OMR_CORE_ENLARGEMENT_H
#define OUTDOOR_OMR_CORE_ENLARGEMENT_H

#include <functional>
#include <opencv2/core.hpp>

#include "outdoor_omr/markers.h"

namespace omr
{
/**
 * Looks at the candidates that were not read in enlargements of 2 and 3 times, the best candidates first. What is read
 * is added to the markers, and the candidate becomes read.
 *
 * @param bgr     the image, CV_8UC3.
 * @param looks   largest number of candidates looked at.
 * @param detect  finds the checkerboards and targets of an image.
 * @param markers of the image, with its candidates.
 */
void readEnlarged(const cv::Mat& bgr, int looks, const std::function<Markers(const cv::Mat&)>& detect,
                  Markers& markers);

}  // namespace omr

#endif
