#include "round_spots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include "round_windows.h"
#include "targets/edges/pixel_gradients.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr double MIN_DETERMINANT = .02;  // over trace^2: else the lines along the gradients meet nowhere
// Mean squares of sines. Texture has .5; of small targets nine of ten have less than .06 (sharp, tilted up to 50
// degrees) and .18 (blurred, tilted up to 60, on pipes).
constexpr double FIRST_DEVIATION = .35;
constexpr double MAX_DEVIATION = .2;
constexpr int RING_REACH = 17;  // from the centre, of the edges of both kinds [px]
constexpr std::size_t MAX_SPOTS = 40;
constexpr double APART = 6;  // centres of two spots [px]

/** Size of a window in which spots are looked for. */
struct Scale
{
  int cells;         // of the window, to either side of the middle one
  int reach;         // of the look at a spot [px]
  int row_step;      // of the rows whose gradients are taken there
  double max_shift;  // of the spot from the window's middle [px]
};
constexpr std::array<Scale, 2> SCALES = {Scale{1, 11, 2, 9}, Scale{2, 17, 3, 12}};

/**
 * Sums over a spot's gradients g at places p from its middle; across: g x p, along: g p. Whole numbers; but squares of
 * the last two only row by row.
 */
struct SpotSums
{
  void add(const PixelGradients& gradients, const cv::v_int16x8& x, int y, int reach)
  {
    const cv::v_int16x8 is_near =
        cv::v_setall_s16(static_cast<short>(reach * reach - y * y + 1)) > cv::v_mul_wrap(x, x);
    const cv::v_int16x8 gx = gradients.x & is_near;
    const cv::v_int16x8 gy = gradients.y & is_near;
    const cv::v_int16x8 height = cv::v_setall_s16(static_cast<short>(y));
    const cv::v_int16x8 across = cv::v_mul_wrap(gy, x) - cv::v_mul_wrap(gx, height);
    const cv::v_int16x8 along = cv::v_mul_wrap(gx, x) + cv::v_mul_wrap(gy, height);
    xx += cv::v_dotprod(gx, gx);
    xy += cv::v_dotprod(gx, gy);
    yy += cv::v_dotprod(gy, gy);
    x_across += cv::v_dotprod(gx, across);
    y_across += cv::v_dotprod(gy, across);
    x_along += cv::v_dotprod(gx, along);
    y_along += cv::v_dotprod(gy, along);
    row_across += cv::v_dotprod(across, across);
    row_along += cv::v_dotprod(along, along);
  }

  void endRow()
  {
    across2 += cv::v_cvt_f32(row_across);
    along2 += cv::v_cvt_f32(row_along);
    row_across = row_along = cv::v_setzero_s32();
  }

  cv::v_int32x4 xx = cv::v_setzero_s32(), xy = xx, yy = xx, x_across = xx, y_across = xx, x_along = xx, y_along = xx;
  cv::v_int32x4 row_across = xx, row_along = xx;
  cv::v_float32x4 across2 = cv::v_setzero_f32(), along2 = across2;
};

/** The point that the gradients around a place point to best. @return nothing at the image's edge or if there is none
 */
std::optional<RoundSpot> meetingPoint(const cv::Mat& grey, const cv::Point& middle, const Scale& scale)
{
  constexpr int LANES = PixelGradients::COUNT;
  const int count = (2 * scale.reach + LANES) / LANES * LANES;
  const int margin = count / 2 + 1;
  if (!cv::Rect(margin, margin, grey.cols - 2 * margin, grey.rows - 2 * margin).contains(middle))
  {
    return {};
  }
  SpotSums sums;
  const cv::v_int16x8 lanes(0, 1, 2, 3, 4, 5, 6, 7);
  for (int y = -scale.reach + scale.reach % scale.row_step; y <= scale.reach; y += scale.row_step)
  {
    const std::uint8_t* row = grey.ptr(middle.y + y) + middle.x;
    for (int x = -count / 2; x < count / 2; x += LANES)
    {
      sums.add({row + x, grey.step}, lanes + cv::v_setall_s16(static_cast<short>(x)), y, scale.reach);
    }
    sums.endRow();
  }
  // A gradient g at p gives the line g x (c - p) = 0, weighted by |g|: normal equations for the point c.
  const double n11 = cv::v_reduce_sum(sums.yy);
  const double n12 = -cv::v_reduce_sum(sums.xy);
  const double n22 = cv::v_reduce_sum(sums.xx);
  const double b1 = cv::v_reduce_sum(sums.y_across);
  const double b2 = -cv::v_reduce_sum(sums.x_across);
  const double determinant = n11 * n22 - n12 * n12;
  if (determinant <= MIN_DETERMINANT * (n11 + n22) * (n11 + n22))
  {
    return {};
  }
  const cv::Point2d shift((b1 * n22 - b2 * n12) / determinant, (b2 * n11 - b1 * n12) / determinant);
  const double across = cv::v_reduce_sum(sums.across2);
  const double rest = across - shift.x * b1 - shift.y * b2;
  // Of |g|^2 |p - c|^2.
  const cv::Point2d moment(b1 + cv::v_reduce_sum(sums.x_along), b2 + cv::v_reduce_sum(sums.y_along));
  const double all = across + cv::v_reduce_sum(sums.along2) - 2 * shift.dot(moment) + shift.dot(shift) * (n11 + n22);
  return RoundSpot{cv::Point2d(middle) + shift, rest / all};
}

std::optional<RoundSpot> lookAt(const cv::Mat& grey, const cv::Point2d& middle, const Scale& scale)
{
  std::optional<RoundSpot> spot = meetingPoint(grey, middle, scale);
  for (const double most : {FIRST_DEVIATION, MAX_DEVIATION})
  {
    if (!spot || spot->deviation > most || cv::norm(spot->center - middle) > scale.max_shift)
    {
      return {};
    }
    spot = meetingPoint(grey, spot->center, scale);
  }
  return spot && spot->deviation < MAX_DEVIATION ? spot : std::nullopt;
}

/** Squares of slope times radius, of grey values that rise and that fall away from a point, of each column. */
struct SlopeSums
{
  std::array<float, 2 * RING_REACH + 1> rising{}, falling{};
};

/** @param radius of the row's first pixel from the point. */
OMR_VECTORIZED void addSlopes(const std::uint8_t* __restrict above, const std::uint8_t* __restrict row,
                              const std::uint8_t* __restrict below, int count, float radius_x, float radius_y,
                              SlopeSums& __restrict sums)
{
  for (int i = 0; i < count; ++i)
  {
    const float x = radius_x + static_cast<float>(i);
    const float weight = x * x + radius_y * radius_y < RING_REACH * RING_REACH ? 1.F : 0.F;
    const float slope =
        weight * (static_cast<float>(row[i + 1] - row[i - 1]) * x + static_cast<float>(below[i] - above[i]) * radius_y);
    const float rising = std::max(slope, 0.F);
    const float falling = std::min(slope, 0.F);
    sums.rising[i] += rising * rising;
    sums.falling[i] += falling * falling;
  }
}

/** RoundSpot::other_kind: disks and squares have one kind of edges. */
double otherKind(const cv::Mat& grey, const cv::Point2d& center)
{
  const cv::Point middle = center;
  const cv::Rect around =
      cv::Rect(middle.x - RING_REACH, middle.y - RING_REACH, 2 * RING_REACH + 1, 2 * RING_REACH + 1) &
      cv::Rect(1, 1, grey.cols - 2, grey.rows - 2);
  SlopeSums sums;
  for (int y = around.y; y < around.br().y; ++y)
  {
    const std::uint8_t* row = grey.ptr(y) + around.x;
    addSlopes(row - grey.step, row, row + grey.step, around.width, static_cast<float>(around.x - center.x),
              static_cast<float>(y - center.y), sums);
  }
  const double rising = std::accumulate(sums.rising.begin(), sums.rising.end(), 0.);
  const double falling = std::accumulate(sums.falling.begin(), sums.falling.end(), 0.);
  return std::min(rising, falling) / std::max(1., rising + falling);
}
}  // namespace

std::vector<RoundSpot> findRoundSpots(const cv::Mat& grey)
{
  const RoundWindows windows(grey);
  std::vector<RoundSpot> spots;
  for (const Scale& scale : SCALES)
  {
    for (const cv::Point2d& middle : windows.strongest(scale.cells))
    {
      if (const std::optional<RoundSpot> spot = lookAt(grey, middle, scale))
      {
        spots.push_back(*spot);
      }
    }
  }
  std::stable_sort(spots.begin(), spots.end(),
                   [](const RoundSpot& left, const RoundSpot& right) { return left.deviation < right.deviation; });
  std::vector<RoundSpot> apart;
  for (const RoundSpot& spot : spots)
  {
    if (apart.size() < MAX_SPOTS && std::none_of(apart.begin(), apart.end(), [&](const RoundSpot& other) {
          return cv::norm(other.center - spot.center) < APART;
        }))
    {
      apart.push_back(spot);
      apart.back().other_kind = otherKind(grey, spot.center);
    }
  }
  return apart;
}

}  // namespace omr
