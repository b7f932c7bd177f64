#include "outdoor_omr/corner_look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "outdoor_omr/corner_ring.h"

namespace omr
{
namespace
{
constexpr float MIN_SQUARE_HEIGHT = 1.5F;    // px; the pixel grid resolves no less
constexpr float MIN_GAP = 3;                 // grey levels between the darkest light and the lightest dark quadrant
constexpr float MIN_GAP_SHARE = 0.15F;       // of the contrast
constexpr float MIN_CONTRAST_SHARE = 0.25F;  // of the neighbours' contrast; half of it is a shadow's edge
/** The ring's verdict on a corner of four alternating squares. */
struct Verdict
{
  int sign = 0;
  float gap = 0;  // darkest light quadrant minus lightest dark one
  float contrast = 0;
  float correlation = 0;
};

constexpr float INNER_RADIUS = 0.3F;  // squares
constexpr float OUTER_RADIUS = 0.5F;  // squares

/** Whether all but the correlation speaks for the corner. */
bool mayAccept(const CornerQuery& query, const Verdict& verdict)
{
  return (query.sign == 0 || verdict.sign == query.sign) &&
         verdict.gap > std::max(MIN_GAP, MIN_GAP_SHARE * verdict.contrast) &&
         verdict.contrast > MIN_CONTRAST_SHARE * query.contrast;
}

bool accepts(const CornerQuery& query, const Verdict& verdict)
{
  return mayAccept(query, verdict) && verdict.correlation > query.correlation;
}

/** Sign, contrast and gap of the ring. */
Verdict judgeQuadrants(const Ring& ring)
{
  float median[QUADRANTS];
  for (int q = 0; q < QUADRANTS; ++q)
  {
    median[q] = quadrantMedian(ring, q);
  }
  Verdict verdict;
  const float difference = (median[0] + median[2] - median[1] - median[3]) / 2;
  verdict.sign = difference > 0 ? 1 : -1;
  verdict.contrast = std::abs(difference);
  const float first = std::min(median[0], median[2]) - std::max(median[1], median[3]);
  const float second = std::min(median[1], median[3]) - std::max(median[0], median[2]);
  verdict.gap = verdict.sign > 0 ? first : second;
  return verdict;
}

Verdict judgeRing(const PyramidView& view, const LocalFrame& frame, const CornerQuery& query)
{
  const Ring ring = sampleRing(view, frame, INNER_RADIUS, OUTER_RADIUS);
  Verdict verdict = judgeQuadrants(ring);
  if (mayAccept(query, verdict))
  {
    const auto s = static_cast<float>(verdict.sign);
    verdict.correlation = ringCorrelation(ring, {s, -s, s, -s});
  }
  return verdict;
}

/** Sums over one row of a window: of the grey values, and of these times x and x^2. */
struct RowSums
{
  float sum, x, xx;
};

RowSums interpolate(const RowSums& a, const RowSums& b, float share)
{
  return {a.sum + share * (b.sum - a.sum), a.x + share * (b.x - a.x), a.xx + share * (b.xx - a.xx)};
}

/**
 * Sums over a square window that lies anywhere between the pixels. They are linear in the grey values, so the sums
 * over whole pixels are interpolated instead of the pixels, and taken only when the window leaves its pixel.
 */
class MomentWindow
{
 public:
  static constexpr int MAX_RADIUS = 6;

  MomentWindow(const cv::Mat& grey, int radius) : grey_(grey), radius_(radius)
  {
  }

  struct Moments
  {
    float z = 0, zx = 0, zy = 0, zxx = 0, zxy = 0, zyy = 0;
  };

  /** @param center at least radius + 1 from the image's border. */
  Moments at(const cv::Point2f& center)
  {
    const cv::Point pixel(static_cast<int>(center.x), static_cast<int>(center.y));
    if (pixel != pixel_)
    {
      gather(pixel);
    }
    const float a = center.x - static_cast<float>(pixel.x);
    const float b = center.y - static_cast<float>(pixel.y);
    Moments moments;
    RowSums above = interpolate(left_[0], right_[0], a);
    for (int i = 0; i <= 2 * radius_; ++i)
    {
      const RowSums below = interpolate(left_[i + 1], right_[i + 1], a);
      const RowSums row = interpolate(above, below, b);
      const auto y = static_cast<float>(i - radius_);
      moments.z += row.sum;
      moments.zx += row.x;
      moments.zxx += row.xx;
      moments.zy += y * row.sum;
      moments.zxy += y * row.x;
      moments.zyy += y * y * row.sum;
      above = below;
    }
    return moments;
  }

 private:
  /** Sums of the rows around the pixel, and the same one pixel further right. */
  void gather(const cv::Point& pixel)
  {
    pixel_ = pixel;
    const int r = radius_;
    for (int i = 0; i <= 2 * r + 1; ++i)
    {
      const uchar* row = grey_.ptr<uchar>(pixel.y + i - r) + pixel.x;
      int sum = 0;
      int x1 = 0;
      int x2 = 0;
      for (int x = -r; x <= r; ++x)
      {
        const int value = row[x];
        sum += value;
        x1 += x * value;
        x2 += x * x * value;
      }
      left_[i] = {static_cast<float>(sum), static_cast<float>(x1), static_cast<float>(x2)};
      const int first = row[-r];
      const int last = row[r + 1];
      sum += last - first;
      x1 += (r + 1) * last + r * first;
      x2 += (r + 1) * (r + 1) * last - r * r * first;
      right_[i] = {static_cast<float>(sum), static_cast<float>(x1 - sum), static_cast<float>(x2 - 2 * x1 + sum)};
    }
  }

  const cv::Mat& grey_;
  int radius_;
  cv::Point pixel_ = {-1, -1};
  std::array<RowSums, 2 * MAX_RADIUS + 2> left_;
  std::array<RowSums, 2 * MAX_RADIUS + 2> right_;
};

/**
 * Saddle point of the quadratic fitted to a square window, re-centred until it rests.
 *
 * @param point  start and result, pixels of this image.
 * @param radius of the window [px].
 * @param reach  largest distance from the start [px].
 * @return false if there is no saddle point within reach.
 */
bool fitSaddle(const cv::Mat& grey, cv::Point2f& point, int radius, float reach)
{
  constexpr int MAX_ROUNDS = 6;
  constexpr float AT_REST = 0.03F;  // px; the final refinement starts from 0.1 px as well
  const cv::Point2f start = point;
  const auto r = static_cast<float>(radius);
  // Sums of x^2, x^4 and x^2 y^2 over the window.
  const float n = (2 * r + 1) * (2 * r + 1);
  const float s2_line = r * (r + 1) * (2 * r + 1) / 3;
  const float s4_line = s2_line * (3 * r * r + 3 * r - 1) / 5;
  const float s2 = s2_line * (2 * r + 1);
  const float s4 = s4_line * (2 * r + 1);
  const float s22 = s2_line * s2_line;
  MomentWindow window(grey, radius);
  for (int round = 0; round < MAX_ROUNDS; ++round)
  {
    if (!isInside(grey, point, r + 1))
    {
      return false;
    }
    const MomentWindow::Moments m = window.at(point);
    // z = f + d x + e y + qxx x^2 + qxy x y + qyy y^2
    const float d = m.zx / s2;
    const float e = m.zy / s2;
    const float qxy = m.zxy / s22;
    const float difference = (m.zxx - m.zyy) / (s4 - s22);
    const float sum = (m.zxx + m.zyy - 2 * s2 * m.z / n) / (s4 + s22 - 2 * s2 * s2 / n);
    const float qxx = (sum + difference) / 2;
    const float qyy = (sum - difference) / 2;
    const float determinant = 4 * qxx * qyy - qxy * qxy;
    if (determinant >= -1e-9F)
    {
      return false;
    }
    cv::Point2f move(-(2 * qyy * d - qxy * e) / determinant, -(2 * qxx * e - qxy * d) / determinant);
    const float distance = length(move);
    if (distance > r)
    {
      move *= r / distance;
    }
    point += move;
    if (length(point - start) > reach)
    {
      return false;
    }
    if (distance < AT_REST)
    {
      break;
    }
  }
  return true;
}

int fitRadius(float square_height)
{
  return std::max(1, std::min(MomentWindow::MAX_RADIUS, static_cast<int>(std::lround(0.32F * square_height))));
}

/** Quick look before the ring: one sample a quadrant must alternate, whatever the sign. */
bool mayAlternate(const PyramidView& view, const LocalFrame& frame)
{
  constexpr float RADIUS = 0.3F;
  const float first = view.sample(frame.at(RADIUS, RADIUS));
  const float second = view.sample(frame.at(-RADIUS, RADIUS));
  const float third = view.sample(frame.at(-RADIUS, -RADIUS));
  const float fourth = view.sample(frame.at(RADIUS, -RADIUS));
  return std::min(first, third) > std::max(second, fourth) || std::min(second, fourth) > std::max(first, third);
}

/** Where the ring alternates best around the prediction; for a prediction too far off for the saddle fit. */
bool searchRing(const PyramidView& view, const LocalFrame& predicted, const CornerQuery& query, cv::Point2f& best)
{
  float best_gap = MIN_GAP;
  bool found = false;
  for (int i = -2; i <= 2; ++i)
  {
    for (int j = -2; j <= 2; ++j)
    {
      LocalFrame moved = predicted;
      moved.node =
          predicted.at(static_cast<float>(j) * 0.5F * query.tolerance, static_cast<float>(i) * 0.5F * query.tolerance);
      if (!mayAlternate(view, moved))
      {
        continue;
      }
      const Verdict verdict = judgeQuadrants(sampleRing(view, moved, INNER_RADIUS, OUTER_RADIUS));
      if (verdict.gap > best_gap && (query.sign == 0 || verdict.sign == query.sign))
      {
        best_gap = verdict.gap;
        best = moved.node;
        found = true;
      }
    }
  }
  return found;
}

/** Follows a saddle point found on a coarse level down to the full image. */
void refineDownwards(const Frame& frame, int level, float square_height, cv::Point2f& point)
{
  while (level-- > 0)
  {
    const float scale = 1.F / static_cast<float>(1 << level);
    cv::Point2f finer = point * scale;
    if (!fitSaddle(frame.grey[level], finer, fitRadius(square_height * scale), 0.12F * square_height * scale + 1))
    {
      return;
    }
    point = finer * (1 / scale);
  }
}
}  // namespace

CornerLooker::CornerLooker(const Frame& frame, int budget) : frame_(frame), budget_(budget)
{
}

CornerLook CornerLooker::look(const LocalFrame& predicted, const CornerQuery& query)
{
  CornerLook result;
  const float height = squareHeight(predicted);
  if (budget_ <= 0 || height < MIN_SQUARE_HEIGHT || !isInside(frame_.raw_grey, predicted.node, 2))
  {
    return result;
  }
  --budget_;
  const PyramidView view(frame_, height);
  const float level_height = height * view.scale;
  const int radius = fitRadius(level_height);
  LocalFrame corner = predicted;
  Verdict verdict;
  cv::Point2f point = predicted.node * view.scale;
  bool found = fitSaddle(*view.grey, point, radius, query.tolerance * level_height + 0.5F);
  if (found)
  {
    corner.node = point * (1 / view.scale);
    verdict = judgeRing(view, corner, query);
    found = accepts(query, verdict);
  }
  const bool searched = !found;
  if (searched)
  {
    if (!query.search || !searchRing(view, predicted, query, corner.node))
    {
      return result;
    }
    point = corner.node * view.scale;
    if (fitSaddle(*view.grey, point, radius, 0.2F * level_height + 0.5F))
    {
      corner.node = point * (1 / view.scale);
    }
  }
  refineDownwards(frame_, view.level, height, corner.node);
  if (searched || view.level > 0)
  {
    verdict = judgeRing(view, corner, query);
  }
  result.position = corner.node;
  result.sign = verdict.sign;
  result.contrast = verdict.contrast;
  result.correlation = verdict.correlation;
  result.found = accepts(query, verdict) && squaresBetween(predicted, corner.node) <= query.tolerance + 0.5F / height;
  return result;
}

}  // namespace omr
