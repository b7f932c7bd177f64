#ifndef OUTDOOR_OMR_CORE_BENT_SHEET_H
#define OUTDOOR_OMR_CORE_BENT_SHEET_H

#include <array>
#include <cstddef>

#include "ring_family.h"

namespace omr
{
/** The unknowns of a bent family: centre x, y, shape a, b, d, perspective hx, hy, bend x, y, normal x, y, hz. */
constexpr int BENT_UNKNOWNS = 12;

/** What RingFamily says of a bent sheet, of many points at once: loops over their values take several together. */
class BentSheet
{
 public:
  static constexpr std::size_t CHUNK = 64;
  using Values = std::array<double, CHUNK>;

  struct Points
  {
    Values x, y;
  };

  /** Derivatives of distances by the unknowns and by the radius of the circle. */
  using Derivatives = std::array<Values, BENT_UNKNOWNS + 1>;

  struct Numbers
  {
    double a, b, d, hx, hy, hz, nx, ny;  // of the family
    double curvature, ex, ey;            // of the pipe, and the direction across its axis
  };

  /** @param family a bent one. */
  explicit BentSheet(const RingFamily& family);

  void toImage(const Points& places, std::size_t size, Points& image) const;

  /** @param places near the result, which they receive. */
  void toPlane(const Points& image, std::size_t size, Points& places) const;

  /** Gradients of the radius over the image, at the images of places. */
  void gradients(const Points& places, std::size_t size, Points& gradients) const;

  /** How the distances of the places' images to their circles change. */
  void differentiate(const Points& places, std::size_t size, Derivatives& derivatives) const;

 private:
  cv::Point2d center_;
  Numbers numbers_;
};

}  // namespace omr

#endif
