#ifndef OUTDOOR_OMR_TEST_RENDER_TARGET_H
#define OUTDOOR_OMR_TEST_RENDER_TARGET_H

#include <opencv2/core.hpp>
#include <string>
#include <vector>

/** One target in front of a camera, and what the light and the camera do to it. */
struct TargetScene
{
  cv::Size size = {480, 360};
  std::string colors = "RWPGB";                       ///< W P R G B, from the inside out
  std::vector<double> radii = {20, 40, 60, 80, 100};  ///< on the plane, of each ring's outer boundary [px]
  cv::Matx33d homography = cv::Matx33d(1, 0, 240, 0, 1, 180, 0, 0, 1);  ///< plane, origin in the centre, to image
  double bend = 0;                    ///< curvature of the sheet along x, as on a pipe [1/px]
  double bend_tilt = 0;               ///< of the pipe's axis towards the camera [rad]
  double sheet_half_side = 130;       ///< of the square white sheet on the plane; 0: none
  cv::Vec3d ground = {.3, .3, .32};   ///< reflectance around (blue, green, red)
  double texture = 0;                 ///< deviation of the ground's reflectance, relative
  double light = .9;                  ///< on a white surface, linear, 1 saturates
  double gradient = 0;                ///< relative change of the light over the image's width
  cv::Vec3d tint = {1, 1, 1};         ///< of the light (blue, green, red)
  double shadow = 1;                  ///< factor of the light right of the oblique line through the centre
  double shadow_offset = 0;           ///< moves that line to the right [px]
  double shadow_width = 1e9;          ///< of the shadow from that line to the right, along a row [px]
  double occluder = 0;                ///< a skin-coloured half-plane over this share of the outer radius
  double cover = 0;                   ///< radius of a skin-coloured disk that lies on the plane [px]
  cv::Point2d cover_offset = {0, 0};  ///< of its centre on the plane [px]
  double gloss = 0;                   ///< light added where it is strongest, linear
  double gloss_radius = 30;           ///< deviation of it [px]
  cv::Point2d gloss_offset = {0, 0};  ///< of its place from the centre [px]
  double veil = 0;                    ///< light added everywhere, linear
  double blur = .7;                   ///< deviation of the lens' point spread [px]
  double noise = 1.5;                 ///< deviation of the grey levels
  unsigned seed = 1;
};

/** A homography that looks at the plane's origin from aside. @param tilt, direction [rad]; @param focal [px] */
cv::Matx33d tiltedView(const cv::Point2d& center, double tilt, double direction, double scale, double focal);

/** The image, CV_8UC3, supersampled and rendered in linear light. */
cv::Mat renderTarget(const TargetScene& scene);

/** Where the circles' common centre appears [px]. */
cv::Point2d projectedCenter(const TargetScene& scene);

#endif
