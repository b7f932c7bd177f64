#include "ring_placement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "boundary_arcs.h"
#include "median.h"
#include "targets/family/ring_refinement.h"

namespace omr
{
namespace
{
constexpr double LEAST_NOISE = 1;    // [grey levels]
constexpr double LEAST_STEP = 3;     // of most arcs of a boundary [grey levels]
constexpr double COVERED_STEP = .3;  // difference from that of most arcs, relative
constexpr double STEP_NOISE = 6;     // the same, by the noise of a pixel over the root of their number
// Deviation that sheets have from planes, and edges from even ones, beside the noise [px].
constexpr double UNEVEN = .03;
// A plane's perspective is sin(tilt) over the focal length, which is near to the longer side of the image; nearly
// straight on the tilt itself is uncertain.
constexpr double LEAST_TILT = .1;

/** The arcs that nothing covers: their steps are as of most arcs of the boundary. */
std::vector<BoundaryPoint> openPoints(const std::vector<BoundaryArc>& arcs, std::size_t rings)
{
  std::vector<std::vector<double>> steps(rings);
  std::vector<std::vector<double>> lacking(rings);
  for (const BoundaryArc& arc : arcs)
  {
    steps[arc.ring].push_back(arc.step);
    lacking[arc.ring].push_back(arc.lacking);
  }
  std::vector<double> step(rings);
  std::vector<double> noise(rings, LEAST_NOISE);
  for (std::size_t k = 0; k < rings; ++k)
  {
    if (!steps[k].empty())
    {
      step[k] = median(std::move(steps[k]));
      noise[k] = std::max(LEAST_NOISE, median(std::move(lacking[k])));
    }
  }
  std::vector<BoundaryPoint> points;
  for (const BoundaryArc& arc : arcs)
  {
    const int k = arc.ring;
    const double usual = COVERED_STEP * std::abs(step[k]) + STEP_NOISE * noise[k] / std::sqrt(arc.pixels);
    if (std::abs(step[k]) > LEAST_STEP && std::abs(arc.step - step[k]) < usual)
    {
      points.push_back({arc.position, k, 1 / std::hypot(noise[k] / arc.steepness, UNEVEN)});
    }
  }
  return points;
}
}  // namespace

std::optional<double> placeRings(const cv::Mat& bgr, const std::vector<Boundary>& boundaries, RingFamily& family,
                                 std::vector<double>& radii)
{
  std::vector<BoundaryArc> arcs = measureArcs(bgr, family, radii);
  if (boundaries.size() == radii.size())
  {
    const auto is_hidden = [&](const BoundaryArc& arc) {
      const Boundary& boundary = boundaries[arc.ring];
      return ((boundary.agreeing | boundary.supported) >> static_cast<int>(arc.turn * ANGLE_BINS) & 1) == 0;
    };
    arcs.erase(std::remove_if(arcs.begin(), arcs.end(), is_hidden), arcs.end());
  }
  const double aspect = family.aspect();
  const double tilt = std::max(LEAST_TILT, std::sqrt(1 - 1 / (aspect * aspect)));
  const double perspective = std::min(USUAL_PERSPECTIVE, tilt * radii.back() / std::max(bgr.cols, bgr.rows));
  const std::vector<BoundaryPoint> points = openPoints(arcs, radii.size());
  if (!std::isfinite(refineFamily(points, true, family, radii, perspective)))
  {
    return std::nullopt;
  }
  const double deviation = outermostDeviation(points, family, radii, perspective);
  return deviation > 0 ? std::optional<double>(deviation) : std::nullopt;
}

}  // namespace omr
