#include "box_training.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outdoor_omr/window_scores.h"

namespace omr
{
namespace
{
/** Share of the smaller one of box and marker from which on the box shows the marker, and of the box up to which it
 * shows none. */
constexpr double SHOWN = .4;
constexpr double TOUCHED = .1;

/** Keeps weights finite where boxes can be told apart without a mistake. */
constexpr double RIDGE = 1e-2;

void addBoxes(const MarkerScene& scene, const MarkerNetwork& network, std::vector<LabelledBox>& boxes)
{
  const std::vector<MarkerScores> scores = windowScores(scene.image, network);
  for (const Candidate& candidate : findCandidates(scene.image.size(), scores, network))
  {
    bool touched = false;
    bool shown = false;
    for (const PlacedMarker& marker : scene.markers)
    {
      const cv::Rect box = boxOf(marker);
      const double shared = (box & candidate.box).area();
      touched = touched || shared > TOUCHED * candidate.box.area();
      shown = shown || (marker.kind == candidate.kind && shared > SHOWN * std::min(box.area(), candidate.box.area()));
    }
    if (shown == touched)
    {
      boxes.push_back({boxFeatures(candidate), candidate.kind, shown, !scene.markers.empty()});
    }
  }
}

/** The features, and a one before them for the bias. */
cv::Matx<double, BOX_FEATURES + 1, 1> withBias(const LabelledBox& box)
{
  cv::Matx<double, BOX_FEATURES + 1, 1> values;
  values(0) = 1;
  std::copy(box.features.begin(), box.features.end(), values.val + 1);
  return values;
}

}  // namespace

std::vector<LabelledBox> labelledBoxes(const TrainingPictures& pictures, unsigned seed, const MarkerNetwork& network)
{
  std::vector<LabelledBox> all;
  for (const bool with_markers : {true, false})
  {
    std::vector<std::vector<LabelledBox>> parts(with_markers ? pictures.withMarkers() : pictures.withoutMarkers());
    pictures.forEach(with_markers, seed + (with_markers ? 0 : 1),
                     [&](int i, cv::RNG& /*random*/, const MarkerScene& scene) { addBoxes(scene, network, parts[i]); });
    for (const std::vector<LabelledBox>& part : parts)
    {
      all.insert(all.end(), part.begin(), part.end());
    }
  }
  return all;
}

std::array<float, BOX_FEATURES + 1> learnEvidence(const std::vector<LabelledBox>& boxes, MarkerKind kind)
{
  using Vector = cv::Matx<double, BOX_FEATURES + 1, 1>;
  using Matrix = cv::Matx<double, BOX_FEATURES + 1, BOX_FEATURES + 1>;
  constexpr int STEPS = 30;  // of Newton's method
  Vector weights = Vector::zeros();
  for (int step = 0; step < STEPS; ++step)
  {
    Vector gradient = -RIDGE * weights;
    Matrix curvature = RIDGE * Matrix::eye();
    for (const LabelledBox& box : boxes)
    {
      if (box.kind == kind)
      {
        const Vector values = withBias(box);
        const double odds = std::clamp(weights.dot(values), -30., 30.);
        const double probability = 1 / (1 + std::exp(-odds));
        gradient += values * ((box.marker ? 1. : 0.) - probability);
        curvature += values * values.t() * (probability * (1 - probability));
      }
    }
    weights += curvature.solve(gradient, cv::DECOMP_CHOLESKY);
  }
  std::array<float, BOX_FEATURES + 1> result;
  std::transform(weights.val, weights.val + BOX_FEATURES + 1, result.begin(),
                 [](double weight) { return static_cast<float>(weight); });
  return result;
}

float evidenceOfFalse(const std::vector<LabelledBox>& boxes, const MarkerNetwork& network, int pictures, double rate)
{
  std::vector<float> wrong;
  for (const LabelledBox& box : boxes)
  {
    if (!box.among_markers)
    {
      wrong.push_back(evidenceOf(box.features, network.boxes[static_cast<int>(box.kind)]));
    }
  }
  const auto allowed = static_cast<std::size_t>(rate * pictures);
  if (wrong.size() <= allowed)
  {
    return wrong.empty() ? 0 : *std::min_element(wrong.begin(), wrong.end());
  }
  std::nth_element(wrong.begin(), wrong.begin() + allowed, wrong.end(), std::greater<>());
  return std::nextafter(wrong[allowed], std::numeric_limits<float>::max());
}

double shareOfMarkers(const std::vector<LabelledBox>& boxes, const MarkerNetwork& network, MarkerKind kind,
                      float evidence)
{
  double markers = 0;
  double found = 0;
  for (const LabelledBox& box : boxes)
  {
    if (box.kind == kind && box.marker)
    {
      markers += 1;
      found += evidenceOf(box.features, network.boxes[static_cast<int>(kind)]) >= evidence ? 1 : 0;
    }
  }
  return markers > 0 ? found / markers : 0;
}

}  // namespace omr
