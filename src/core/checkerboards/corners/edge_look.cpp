#include "edge_look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "grey_samples.h"
#include "median.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int ARMS = 4;
constexpr std::array<float, 4> RADII = {0.22F, 0.36F, 0.5F, 0.64F};  // squares from the corner
constexpr int PLACES = ARMS * static_cast<int>(RADII.size());
constexpr float STEP = 0.04F;  // squares across the edge
constexpr int REACH = 5;       // steps to either side where an edge is looked for
constexpr int HALF = 3;        // steps from an edge to where its sides are judged
constexpr int PROFILE = 2 * (REACH + HALF) + 1;

/** An edge that runs from a corner. */
struct Arm
{
  explicit constexpr Arm(int index) : along_u(index % 2 == 0), direction(index < 2 ? 1.F : -1.F)
  {
  }
  bool along_u;
  float direction;
};

using Edges = std::array<Edge, PLACES>;

// Of the profiles across all edges around a corner: the first of each place, then the second of each.
constexpr int SAMPLES = PROFILE * PLACES;

/** Where the profiles are sampled, from the corner [squares]. */
struct Offsets
{
  std::array<float, SAMPLES> u{}, v{};
};

constexpr Offsets offsetsAround()
{
  Offsets offsets;
  for (int i = 0; i < SAMPLES; ++i)
  {
    const int place = i % PLACES;
    const Arm arm(place % ARMS);
    const float along = arm.direction * RADII[place / ARMS];
    const int step = i / PLACES - REACH - HALF;
    const float across = static_cast<float>(step) * STEP;
    offsets.u[i] = arm.along_u ? along : across;
    offsets.v[i] = arm.along_u ? across : along;
  }
  return offsets;
}
constexpr Offsets AROUND = offsetsAround();

/** strongestEdge() of the places, each value side by side. */
struct StrongestEdges
{
  std::array<float, PLACES> offset, ratio, contrast;
};

/** The strongest edges at all places around a corner, taken side by side. */
OMR_VECTORIZED void findStrongest(const PyramidView& view, const LocalFrame& local_frame, int sign,
                                  StrongestEdges& strongest)
{
  const LocalFrame frame = local_frame;
  const float scale = view.scale;
  SamplePlaces<SAMPLES> places;
  for (int i = 0; i < SAMPLES; ++i)
  {
    // LocalFrame::at()
    places.x[i] = (frame.node.x + AROUND.u[i] * frame.u.x + AROUND.v[i] * frame.v.x) * scale;
    places.y[i] = (frame.node.y + AROUND.u[i] * frame.u.y + AROUND.v[i] * frame.v.y) * scale;
  }
  std::array<float, SAMPLES> grey;
  std::array<float, SAMPLES> logarithm;
  sampleGreys(*view.grey, places, grey);
  greyLogarithms(greyLogarithmTable(), grey, logarithm);
  std::array<float, PLACES> signs;
  for (int i = 0; i < PLACES; ++i)
  {
    signs[i] = Arm(i % ARMS).direction * static_cast<float>(sign);
  }
  StrongestEdges best{};
  best.ratio.fill(-1e9F);
  for (int step = HALF; step < PROFILE - HALF; ++step)
  {
    const float offset = static_cast<float>(step - HALF - REACH) * STEP;
    const int ahead = (step + HALF) * PLACES;
    const int behind = (step - HALF) * PLACES;
    for (int i = 0; i < PLACES; ++i)
    {
      const float ratio = signs[i] * (logarithm[ahead + i] - logarithm[behind + i]);
      const float contrast = signs[i] * (grey[ahead + i] - grey[behind + i]);
      const bool is_stronger = ratio > best.ratio[i];
      best.offset[i] = is_stronger ? offset : best.offset[i];
      best.contrast[i] = is_stronger ? contrast : best.contrast[i];
      best.ratio[i] = is_stronger ? ratio : best.ratio[i];
    }
  }
  strongest = best;
}

Edges edgesAround(const PyramidView& view, const LocalFrame& frame, int sign)
{
  StrongestEdges strongest;
  findStrongest(view, frame, sign, strongest);
  Edges edges;
  for (int i = 0; i < PLACES; ++i)
  {
    edges[i] = {strongest.offset[i], strongest.ratio[i], strongest.contrast[i]};
  }
  return edges;
}

float medianContrast(const Edges& edges)
{
  std::array<float, PLACES> contrasts;
  std::transform(edges.begin(), edges.end(), contrasts.begin(), [](const Edge& edge) { return edge.contrast; });
  return median(contrasts);
}

struct Agreement
{
  int places = 0;
  int arms = 0;  // with two such places at least
};

/** The edges that run straight through a corner [squares] with the ratio. */
Agreement agreementOf(const Edges& edges, const cv::Point2f& corner, float ratio)
{
  constexpr int MIN_ON_ARM = 2;
  std::array<int, ARMS> on_arm = {};
  for (int i = 0; i < PLACES; ++i)
  {
    on_arm[i % ARMS] += edges[i].isLike(Arm(i % ARMS).along_u ? corner.y : corner.x, ratio) ? 1 : 0;
  }
  Agreement agreement;
  for (const int places : on_arm)
  {
    agreement.places += places;
    agreement.arms += places >= MIN_ON_ARM ? 1 : 0;
  }
  return agreement;
}

using Profile = std::array<float, PROFILE>;

/** Grey values and their logarithms in steps around a place. */
OMR_VECTORIZED void sampleAcross(const PyramidView& view, const LocalFrame& local_frame, const cv::Point2f& middle,
                                 const cv::Point2f& across, Profile& grey, Profile& logarithm)
{
  const LocalFrame frame = local_frame;
  const cv::Point2f place = middle;
  const cv::Point2f step = across;
  const float scale = view.scale;
  SamplePlaces<PROFILE> places;
  for (int i = 0; i < PROFILE; ++i)
  {
    // LocalFrame::at()
    const auto steps = static_cast<float>(i - REACH - HALF);
    const float u = place.x + steps * step.x;
    const float v = place.y + steps * step.y;
    places.x[i] = (frame.node.x + u * frame.u.x + v * frame.v.x) * scale;
    places.y[i] = (frame.node.y + u * frame.u.y + v * frame.v.y) * scale;
  }
  sampleGreys(*view.grey, places, grey);
  greyLogarithms(greyLogarithmTable(), grey, logarithm);
}
}  // namespace

bool showsEdges(const Frame& frame, const LocalFrame& predicted)
{
  constexpr float MIN_SQUARE = 5;  // px; below it the places along an edge are not apart
  return squareHeight(predicted) >= MIN_SQUARE && isInside(frame.raw_grey, predicted.node, 2);
}

Edge strongestEdge(const PyramidView& view, const LocalFrame& frame, const cv::Point2f& place, bool along_u, int sign)
{
  Profile grey;
  Profile logarithm;
  sampleAcross(view, frame, place, along_u ? cv::Point2f(0, STEP) : cv::Point2f(STEP, 0), grey, logarithm);
  const auto s = static_cast<float>(sign);
  Edge edge;
  edge.ratio = -1e9F;
  for (int i = HALF; i < PROFILE - HALF; ++i)
  {
    const float ratio = s * (logarithm[i + HALF] - logarithm[i - HALF]);
    if (ratio > edge.ratio)
    {
      edge = {static_cast<float>(i - HALF - REACH) * STEP, ratio, s * (grey[i + HALF] - grey[i - HALF])};
    }
  }
  return edge;
}

bool Edge::isLike(float line, float board_ratio) const
{
  constexpr float MAX_DIFFERENCE = 0.35F;    // of the ratio
  constexpr float MAX_OFFSET = 2.5F * STEP;  // from the line
  return std::abs(ratio - board_ratio) <= MAX_DIFFERENCE * board_ratio && std::abs(offset - line) <= MAX_OFFSET;
}

CornerEdges lookAtEdges(const PyramidView& view, const LocalFrame& predicted, int sign)
{
  constexpr float MIN_RATIO = 0.2F;
  constexpr int MIN_AGREEING = 11;  // of 16 places
  const Edges edges = edgesAround(view, predicted, sign);
  std::array<float, PLACES / 2> offsets_u;
  std::array<float, PLACES / 2> offsets_v;
  std::array<float, PLACES> ratios;
  for (int i = 0; i < PLACES; ++i)
  {
    ratios[i] = edges[i].ratio;
    (Arm(i % ARMS).along_u ? offsets_v : offsets_u)[i / 2] = edges[i].offset;
  }
  CornerEdges result;
  result.ratio = median(ratios);
  if (result.ratio < MIN_RATIO)
  {
    return result;
  }
  const cv::Point2f corner(median(offsets_u), median(offsets_v));
  const Agreement agreement = agreementOf(edges, corner, result.ratio);
  result.position = predicted.at(corner.x, corner.y);
  result.agreeing = static_cast<float>(agreement.places) / PLACES;
  result.alike = agreement.places >= MIN_AGREEING && agreement.arms == ARMS;
  result.contrast = result.alike ? medianContrast(edges) : 0;
  return result;
}

CornerEdges lookAtKnownEdges(const PyramidView& view, const LocalFrame& known, int sign, float ratio)
{
  constexpr int MIN_AGREEING = 8;  // of 16 places
  constexpr int MIN_ARMS = 3;
  const Edges edges = edgesAround(view, known, sign);
  const Agreement agreement = agreementOf(edges, {0, 0}, ratio);
  CornerEdges result;
  result.position = known.node;
  result.ratio = ratio;
  result.contrast = medianContrast(edges);
  result.agreeing = static_cast<float>(agreement.places) / PLACES;
  result.alike = agreement.places >= MIN_AGREEING && agreement.arms >= MIN_ARMS;
  return result;
}

}  // namespace omr
