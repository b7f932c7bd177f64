#ifndef OUTDOOR_OMR_TOOLS_SCENE_H
#define OUTDOOR_OMR_TOOLS_SCENE_H

#include <opencv2/core.hpp>

namespace omr
{
/**
 * Draws checkerboards, targets of concentric rings and lines in colour with sensor noise, scaled to the size: a scene
 * for benchmarks and for tests that compare implementations. Equal arguments give equal images.
 *
 * @param noise standard deviation of the sensor noise [grey levels].
 */
cv::Mat drawScene(const cv::Size& size, double noise = 4);

/**
 * Draws checkerboards on white sheets in a grid that fills the image, blurred and with sensor noise as a camera would.
 *
 * @param boards  columns and rows of boards.
 * @param squares columns and rows of squares of each.
 */
cv::Mat drawBoards(const cv::Size& size, const cv::Size& boards, const cv::Size& squares);

/** The shapes of the paper's Fig. 17, 1200 x 1000: circles of radius 100 px, squares of 100 px and random patterns. */
cv::Mat drawPaperShapes();

}  // namespace omr

#endif
