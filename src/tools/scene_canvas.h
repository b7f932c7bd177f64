#ifndef OUTDOOR_OMR_TOOLS_SCENE_CANVAS_H
#define OUTDOOR_OMR_TOOLS_SCENE_CANVAS_H

#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** Size of a rendered picture; it is drawn on a canvas, CV_32FC3 in linear light, that is so many times larger. */
const cv::Size SCENE_SIZE(480, 360);
constexpr int SUPERSAMPLING = 3;

// Random numbers are drawn one a statement or in braces, whose order is fixed: every compiler draws the same scenes.

double logUniform(cv::RNG& random, double min, double max);
bool chance(cv::RNG& random, double probability);

/** A canvas with a random part of the background. @param background CV_8UC3, at least 32 px wide and high. */
cv::Mat fineBackground(const cv::Mat& background, cv::RNG& random);

/** From the picture to the canvas. The centre of the top-left pixel is (0, 0) in both. */
cv::Matx33d toCanvas(const cv::Matx33d& to_pixels);

/** A view of the plane with its origin at a point of the picture; unit is the size of a square or ring there [px]. */
cv::Matx33d randomView(const cv::Point2d& place, double unit, double extent, cv::RNG& random);

void fillPolygon(cv::Mat& canvas, const std::vector<cv::Point2d>& outline, const cv::Matx33d& to_fine,
                 const cv::Scalar& color);
std::vector<cv::Point2d> rectangle(double left, double top, double right, double bottom);
std::vector<cv::Point2d> circle(double radius, const cv::Point2d& center = {});

/** What light, camera and file make of a canvas: CV_8UC3 of SCENE_SIZE. @param unit of the smallest detail [px]. */
cv::Mat photograph(const cv::Mat& canvas, double unit, cv::RNG& random);

}  // namespace omr

#endif
