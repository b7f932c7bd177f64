#ifndef OUTDOOR_OMR_TEST_RENDER_H
#define OUTDOOR_OMR_TEST_RENDER_H

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
namespace test
{
/**
 * A picture drawn with known geometry, for tests: everything is painted at four times the size and averaged. Pixel
 * (0, 0) has its centre at (0, 0).
 */
class Render
{
 public:
  explicit Render(const cv::Size& size, const cv::Scalar& background = cv::Scalar::all(120));

  /** Fills a polygon, convex or not. @param outline [px]. */
  void addPolygon(const std::vector<cv::Point2d>& outline, const cv::Scalar& color);

  /** Fills a circle of the plane. @param to_pixels plane -> px. */
  void addCircle(const cv::Point2d& center, double radius, const cv::Matx33d& to_pixels, const cv::Scalar& color);

  /**
   * Paints a checkerboard with its white margin.
   *
   * @param to_pixels   homography, board -> px; the board spans (0, 0) to (cols, rows), its unit is one square.
   * @param first_black the square at (0, 0) is black.
   * @param margin      [squares].
   */
  void addBoard(int rows, int cols, const cv::Matx33d& to_pixels, bool first_black = true, double margin = 1);

  /** Multiplies the light within a polygon. */
  void addShadow(const std::vector<cv::Point2d>& outline, double light);

  /** Light that changes evenly from the left to the right edge. */
  void addLightGradient(double left, double right);

  /**
   * The picture as a camera gives it, CV_8UC3.
   *
   * @param blur  sigma of a Gaussian [px]; 0: none but the pixel's own.
   * @param noise sigma [grey levels]. @param seed of the noise.
   */
  cv::Mat picture(double blur = 0.6, double noise = 1.5, std::uint64_t seed = 1) const;

 private:
  cv::Size size_;
  cv::Mat canvas_;  // CV_32FC3
};

/** Homography that puts a board of the given size around a centre, turned and seen from a side. */
cv::Matx33d boardHomography(int rows, int cols, const cv::Point2d& center, double square_px, double turn_degrees,
                            double tilt_degrees = 0);

/** Image of a point of the plane. */
cv::Point2d project(const cv::Matx33d& homography, double x, double y);

}  // namespace test
}  // namespace omr

#endif
