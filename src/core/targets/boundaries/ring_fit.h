#ifndef OUTDOOR_OMR_CORE_RING_FIT_H
#define OUTDOOR_OMR_CORE_RING_FIT_H

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/**
 * Fits rings of uniform colour, seen through the blur of lens and camera, to samples along a ray. How wide the blur is
 * the first radii tell; of a row of fits that differ in one radius, only that one's blur is computed again.
 */
class RingFit
{
 public:
  static constexpr double SURROUNDING = 4;  ///< of the outermost ring, that takes part [px]

  struct Result
  {
    std::vector<cv::Vec3d> colors;  ///< of the rings and around them: brightness and hue
    double rms = 0;                 ///< of what is left [grey levels]
  };

  /**
   * @param samples brightness and hue, from the centre outwards; must outlive this.
   * @param step    between them [px].
   * @param radii   of the boundaries, ascending [px].
   */
  RingFit(const std::vector<cv::Vec3d>& samples, double step, const std::vector<double>& radii);

  /** Adds a boundary at a place of the radii. */
  void insert(std::size_t k, double radius);

  void erase(std::size_t k);

  /** The rings whose blurred image fits best. */
  Result fit();

 private:
  using Blurred = std::array<std::vector<double>, 2>;  // of a disk, at each sample: by the blur of brightness, of hue

  void findBlur(bool is_hue);
  std::vector<double> blur(double radius, double deviation) const;
  cv::Vec2d value(std::size_t sample, bool is_hue) const;
  double fitPart(bool is_hue, std::vector<cv::Vec3d>& colors);
  void addPrior(bool is_hue, std::size_t stride);
  double squaredRest(bool is_hue, std::size_t stride, const cv::Mat& solution) const;

  const std::vector<cv::Vec3d>& samples_;
  double step_;
  std::vector<double> radii_;
  std::array<double, 2> deviations_{};  // of the blur of brightness, of hue [px]
  std::vector<Blurred> disks_;
  std::vector<double> shares_;  // of each ring in each sample's light
  std::vector<double> normal_;
  std::vector<cv::Vec2d> right_;
};

}  // namespace omr

#endif
