#include "ring_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>

#include "median.h"
#include "targets/family/bent_sheet.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr double FINEST_STEP = .5;  // [px]
constexpr int MAX_SAMPLES = 400;    // a ray
constexpr int LEVELS_PER_GREY = 4;
// The margins of a ring that count as edge.
constexpr double EDGE_SHARE = .3;      // of the ring's width
constexpr double EDGE_WIDTH = 1.5;     // [px]
constexpr double MIN_SURROUNDING = 3;  // width of what counts as around the rings [px]
constexpr double MIN_RIM = 4;          // of a ring's plateau, that its rim takes [px]
constexpr double RIM_SHARE = 1 / 3.;

const std::array<float, 255 * LEVELS_PER_GREY + 2>& logarithms()
{
  static const auto LOGARITHM_OF_LEVEL = [] {
    std::array<float, 255 * LEVELS_PER_GREY + 2> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
    {
      table[i] = std::log(static_cast<float>(i) / LEVELS_PER_GREY + DARK_LEVEL);
    }
    return table;
  }();
  return LOGARITHM_OF_LEVEL;
}

/** Unit vectors of the rays. */
const std::array<cv::Point2d, RingProfile::ANGLES>& directions()
{
  static const auto DIRECTION_OF_ANGLE = [] {
    std::array<cv::Point2d, RingProfile::ANGLES> table;
    for (int angle = 0; angle < RingProfile::ANGLES; ++angle)
    {
      const double phi = 2 * CV_PI * (angle + .5) / RingProfile::ANGLES;
      table[angle] = cv::Point2d(std::cos(phi), std::sin(phi));
    }
    return table;
  }();
  return DIRECTION_OF_ANGLE;
}

/** Where a ray's samples lie. */
struct Places
{
  static constexpr int SIZE = MAX_SAMPLES + 2;

  std::array<float, SIZE> x, y;     // [px]
  std::array<int, SIZE> is_inside;  // the image, with a pixel to the right and below
};

OMR_VECTORIZED void placeSamples(const RingFamily& source, const cv::Point2d& direction, double step, int count,
                                 const cv::Size& image, Places& places)
{
  const RingFamily family = source;
  const cv::Point2d towards = direction;
  const double right = image.width - 1;
  const double bottom = image.height - 1;
  for (int i = 0; i < count; ++i)
  {
    // RingFamily::toImage()
    const double qx = towards.x * (i * step);
    const double qy = towards.y * (i * step);
    const double k = 1 / (1 + family.hx * qx + family.hy * qy);
    const double x = family.center.x + (family.a * qx + family.b * qy) * k;
    const double y = family.center.y + (family.b * qx + family.d * qy) * k;
    places.x[i] = static_cast<float>(x);
    places.y[i] = static_cast<float>(y);
    places.is_inside[i] = (x >= 0) & (y >= 0) & (x < right) & (y < bottom) ? 1 : 0;
  }
}

/** The same on a bent sheet. */
void placeBentSamples(const RingFamily& family, const cv::Point2d& direction, double step, int count,
                      const cv::Size& image, Places& places)
{
  const BentSheet sheet(family);
  constexpr auto CHUNK = static_cast<int>(BentSheet::CHUNK);
  BentSheet::Points q;
  BentSheet::Points p;
  for (int first = 0; first < count; first += CHUNK)
  {
    const int size = std::min(CHUNK, count - first);
    for (int i = 0; i < size; ++i)
    {
      q.x[i] = (first + i) * step * direction.x;
      q.y[i] = (first + i) * step * direction.y;
    }
    sheet.toImage(q, static_cast<std::size_t>(size), p);
    for (int i = 0; i < size; ++i)
    {
      places.x[first + i] = static_cast<float>(p.x[i]);
      places.y[first + i] = static_cast<float>(p.y[i]);
      places.is_inside[first + i] =
          p.x[i] >= 0 && p.y[i] >= 0 && p.x[i] < image.width - 1 && p.y[i] < image.height - 1 ? 1 : 0;
    }
  }
}

/** The four bytes from an address on. */
cv::v_float32x4 loadBytes(const uchar* bytes)
{
  return cv::v_cvt_f32(cv::v_reinterpret_as_s32(cv::v_load_expand_q(bytes)));
}

cv::v_float32x4 interpolate(const uchar* upper, const uchar* lower, const cv::v_float32x4& fx,
                            const cv::v_float32x4& fy)
{
  const cv::v_float32x4 upper_left = loadBytes(upper);
  const cv::v_float32x4 lower_left = loadBytes(lower);
  const cv::v_float32x4 above = upper_left + fx * (loadBytes(upper + 3) - upper_left);
  const cv::v_float32x4 below = lower_left + fx * (loadBytes(lower + 3) - lower_left);
  return above + fy * (below - above);
}

/** Bilinear sample at a place inside the image: its three channels, and a fourth value without meaning. */
cv::v_float32x4 sample(const cv::Mat& bgr, float x, float y)
{
  // A place just before the last pixel may be rounded onto it.
  const int left = std::min(static_cast<int>(x), bgr.cols - 2);
  const int top = std::min(static_cast<int>(y), bgr.rows - 2);
  const cv::v_float32x4 fx = cv::v_setall_f32(x - left);
  const cv::v_float32x4 fy = cv::v_setall_f32(y - top);
  const auto* upper = bgr.ptr<uchar>(top) + 3 * left;
  const auto* lower = upper + bgr.step[0];
  if (left + 2 == bgr.cols)  // no byte may be read behind the last row's end
  {
    std::array<uchar, 16> ends{};
    std::copy_n(upper, 6, ends.begin());
    std::copy_n(lower, 6, ends.begin() + 8);
    return interpolate(ends.data(), ends.data() + 8, fx, fy);
  }
  return interpolate(upper, lower, fx, fy);
}

/** Of the channels' levels: std::lround() of what is not negative, and its logarithm. */
LogColor logarithm(const cv::v_float32x4& grey)
{
  const auto& table = logarithms();
  const cv::v_float32x4 levels = grey * cv::v_setall_f32(LEVELS_PER_GREY);
  const cv::v_int32x4 whole = cv::v_trunc(levels);
  const cv::v_float32x4 rest = levels - cv::v_cvt_f32(whole);
  std::array<int, 4> nearest;
  cv::v_store(nearest.data(), whole - cv::v_reinterpret_as_s32(rest >= cv::v_setall_f32(.5F)));
  return {table[nearest[0]], table[nearest[1]], table[nearest[2]]};
}

/** The part of a ring that its edges do not blur. */
std::pair<double, double> plateau(const std::vector<double>& radii, std::size_t ring, double limit)
{
  const double inner = ring > 0 ? radii[ring - 1] : 0;
  const double last_width = radii.back() - (radii.size() > 1 ? radii[radii.size() - 2] : 0);
  const double outer =
      ring < radii.size() ? radii[ring] : std::min(limit, radii.back() + std::max(MIN_SURROUNDING, .7 * last_width));
  const double width = outer - inner;
  const double margin = std::max(EDGE_SHARE * width, std::min(EDGE_WIDTH, .45 * width));
  return {inner + margin, outer - margin};
}
}  // namespace

void sampleProfile(const cv::Mat& bgr, const RingFamily& family, double max_radius, RingProfile& profile,
                   AngleBins open)
{
  profile.step = std::max(FINEST_STEP, max_radius / MAX_SAMPLES);
  profile.count = static_cast<int>(max_radius / profile.step) + 1;
  profile.grey.create(RingProfile::ANGLES, profile.count);
  profile.color.create(RingProfile::ANGLES, profile.count);
  profile.inside.assign(RingProfile::ANGLES, profile.count);
  profile.open = open;
  Places places;
  for (int angle = 0; angle < RingProfile::ANGLES; ++angle)
  {
    if ((open >> angle & 1) == 0)
    {
      profile.inside[angle] = 0;
      continue;
    }
    const auto place = family.isBent() ? placeBentSamples : placeSamples;
    place(family, directions()[angle], profile.step, profile.count, bgr.size(), places);
    cv::Vec3f* grey = profile.grey[angle];
    LogColor* color = profile.color[angle];
    for (int i = 0; i < profile.count; ++i)
    {
      if (places.is_inside[i] == 0)
      {
        profile.inside[angle] = i;
        break;
      }
      const cv::v_float32x4 channels = sample(bgr, places.x[i], places.y[i]);
      std::array<float, 4> values;
      cv::v_store(values.data(), channels);
      grey[i] = cv::Vec3f(values.data());
      color[i] = logarithm(channels);
    }
  }
}

int leastDirections(const RingProfile& profile)
{
  return countOf(profile.open) / 2;
}

bool ringColor(const RingProfile& profile, const std::vector<double>& radii, std::size_t ring, int angle,
               LogColor& color, RingPart part)
{
  auto [from, to] = plateau(radii, ring, (profile.count - 1) * profile.step);
  const double rim = std::max(MIN_RIM, RIM_SHARE * (to - from));
  if (part == RingPart::outer_rim)
  {
    from = std::max(from, to - rim);
  }
  else if (part == RingPart::inner_rim)
  {
    to = std::min(to, from + rim);
  }
  const int first = static_cast<int>(std::lround(from / profile.step));
  const int last = std::max(first, static_cast<int>(std::lround(to / profile.step)));
  if (last >= profile.inside[angle])
  {
    return false;
  }
  color = LogColor();
  for (int i = first; i <= last; ++i)
  {
    color += profile.ray(angle)[i];
  }
  color *= 1.F / (last - first + 1);
  return true;
}

double narrowestRing(const std::vector<double>& radii)
{
  double narrowest = radii[0];
  for (std::size_t k = 1; k < radii.size(); ++k)
  {
    narrowest = std::min(narrowest, radii[k] - radii[k - 1]);
  }
  return narrowest;
}

double widestRing(const std::vector<double>& radii)
{
  double widest = radii[0];
  for (std::size_t k = 1; k < radii.size(); ++k)
  {
    widest = std::max(widest, radii[k] - radii[k - 1]);
  }
  return widest;
}

std::vector<double> scaledBy(double factor, std::vector<double> values)
{
  std::transform(values.begin(), values.end(), values.begin(), [=](double value) { return factor * value; });
  return values;
}

LogColor medianOf(const std::array<LogColor, RingProfile::ANGLES>& colors, AngleBins directions)
{
  std::array<std::array<float, RingProfile::ANGLES>, 3> values;
  int count = 0;
  for (int angle = 0; angle < RingProfile::ANGLES; ++angle)
  {
    if ((directions >> angle & 1) != 0)
    {
      for (int c = 0; c < 3; ++c)
      {
        values[c][count] = colors[angle][c];
      }
      ++count;
    }
  }
  return {median(values[0], count), median(values[1], count), median(values[2], count)};
}

double greyLevel(float log_color)
{
  return std::exp(log_color) - DARK_LEVEL;
}

}  // namespace omr
