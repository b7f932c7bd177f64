#ifndef OUTDOOR_OMR_CORE_SADDLE_POINTS_H
#define OUTDOOR_OMR_CORE_SADDLE_POINTS_H

#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/**
 * Saddle points of the grey values that look the same after a half turn, as the corner of four squares does.
 *
 * @param grey      CV_8UC1, a level of the pyramid: its smoothing is enough (a Gaussian of 1 px more finds 94 instead
 * of 95 of 96 degraded boards, and the same elsewhere).
 * @param faint     whether points of a few grey levels count too.
 * @param max_count the strongest are kept; bounds the time on noise.
 * @return          pixels; none in an image under 16 px.
 */
std::vector<cv::Point> findSaddlePoints(const cv::Mat& grey, bool faint, int max_count);

}  // namespace omr

#endif
