#ifndef OUTDOOR_OMR_CORE_INK_REST_H
#define OUTDOOR_OMR_CORE_INK_REST_H

#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** What the rings lie on. */
enum class Ground
{
  white,
  any,  ///< also darker than a ring, which is white then
};

/** Samples along a ray, from the centre outwards. */
struct RaySamples
{
  const std::vector<cv::Vec3d>& samples;  ///< brightness and hue, the last one of what is around
  double step;                            ///< between them [px]
  double scale;                           ///< pixels of these a pixel of the camera, which tells how wide its blur is
  cv::Vec3d white;                        ///< brightness and hue of the place's white
};

/** What brightness (part 0) or hue (part 1) adds to the rest, as a function of the rings' inks c: c Q c - 2 l c + r. */
struct InkRestPart
{
  /** @param deviation of the blur [px of the camera]. @param radii of the boundaries, ascending, not empty [px]. */
  InkRestPart(const RaySamples& source, int part, double deviation, const std::vector<double>& radii);

  cv::Mat_<double> squares;
  cv::Mat_<double> linear;
  double rest = 0;
};

/** The squared deviations of samples and inks that rings of given inks leave, as a function of these. */
class InkRest
{
 public:
  /** @param brightness, hue must outlive this. */
  InkRest(const InkRestPart& brightness, const InkRestPart& hue);

  /** Half of the slope, of each ring. @param inks of the rings and of what is around: brightness and hue. */
  std::vector<cv::Vec3d> slopes(const std::vector<cv::Vec3d>& inks) const;

  double of(const std::vector<cv::Vec3d>& inks) const;

  /** The factor of the product of two rings' inks. */
  cv::Vec3d square(int k, int j) const;

 private:
  cv::Vec3d linear(int k) const;

  const InkRestPart& brightness_;
  const InkRestPart& hue_;
};

}  // namespace omr

#endif
