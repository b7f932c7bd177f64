#include "arc_families.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "arc_circles.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr double MAX_ARC_SINE = .13;           // root mean square of an arc's, that lies on a family
constexpr double MAX_MIDDLE_SINE = .25;        // in the middle of such an arc
constexpr double MAX_DISTANCE = .5;            // likewise [px]
constexpr double MAX_RELATIVE_DISTANCE = .02;  // more, relative to the radius
constexpr std::size_t MAX_PAIRED = 28;         // runs of arcs that are paired with each other
constexpr double MIN_PAIRED = .5;              // turning of a run that is paired [rad]
constexpr double MIN_ALONE = 1.2;              // turning of a run that gives a family alone
constexpr double MIN_TURNING = 4;              // of all arcs of a family
constexpr std::size_t MAX_FAMILIES = 12;

/** Arcs that follow each other along an edge. */
struct Run
{
  std::size_t first = 0, last = 0;
  double turning = 0;
  ArcSums sums;
};

/** Those that turn enough to be paired, the one that turns most first. Few do: only their sums are joined. */
std::vector<Run> findRuns(const std::vector<EdgeArc>& arcs)
{
  std::vector<Run> runs;
  for (std::size_t first = 0, next = 0; first < arcs.size(); first = next)
  {
    double turning = 0;
    for (next = first; next < arcs.size() && arcs[next].chain == arcs[first].chain; ++next)
    {
      turning += arcs[next].turning;
    }
    if (turning > MIN_PAIRED)
    {
      runs.push_back({first, next - 1, turning, arcs[first].sums});
      for (std::size_t i = first + 1; i < next; ++i)
      {
        runs.back().sums = joined(runs.back().sums, arcs[i].sums);
      }
    }
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run& left, const Run& right) { return left.turning > right.turning; });
  return runs;
}

/** The middles of arcs, each of their values side by side. */
struct Middles
{
  explicit Middles(const std::vector<EdgeArc>& arcs)
  {
    for (const EdgeArc& arc : arcs)
    {
      x.push_back(arc.middle.x);
      y.push_back(arc.middle.y);
      inwards_x.push_back(arc.inwards.x);
      inwards_y.push_back(arc.inwards.y);
    }
  }

  std::vector<double> x, y;
  std::vector<double> inwards_x, inwards_y;
};

/** Of each arc, whether it runs along a family's circle in its middle, concave to the centre. */
OMR_VECTORIZED void findAlong(const Middles& middles, const ShapeVector& shape, std::int64_t* is_along)
{
  const double s11 = shape[0];
  const double s12 = shape[1];
  const double s22 = shape[2];
  const double d1 = shape[3];
  const double d2 = shape[4];
  const double* x = middles.x.data();
  const double* y = middles.y.data();
  const double* inwards_x = middles.inwards_x.data();
  const double* inwards_y = middles.inwards_y.data();
  const std::size_t size = middles.x.size();
  for (std::size_t i = 0; i < size; ++i)
  {
    const double gx = s11 * x[i] + s12 * y[i] - d1;
    const double gy = s12 * x[i] + s22 * y[i] - d2;
    const double cross = inwards_x[i] * gy - inwards_y[i] * gx;
    const bool is_parallel = cross * cross < MAX_MIDDLE_SINE * MAX_MIDDLE_SINE * (gx * gx + gy * gy);
    is_along[i] = is_parallel & (inwards_x[i] * gx + inwards_y[i] * gy < 0) ? 1 : 0;
  }
}

bool liesOn(const ArcSums& sums, const ShapeVector& shape, const RingFamily& family)
{
  if (sums.squaredSine(shape) > MAX_ARC_SINE * MAX_ARC_SINE)
  {
    return false;
  }
  const double limit = MAX_DISTANCE + MAX_RELATIVE_DISTANCE * radiusOf(sums, shape, family);
  return sums.squaredDistance(shape) < limit * limit;
}

struct Hypothesis
{
  ShapeVector shape;
  RingFamily family;
  double turning = 0;
};

class Search
{
 public:
  explicit Search(const std::vector<EdgeArc>& arcs)
      : arcs_(arcs), middles_(arcs), is_along_(arcs.size()), runs_(findRuns(arcs)), used_(arcs.size(), 0)
  {
  }

  std::vector<ArcFamily> run()
  {
    std::vector<Hypothesis> hypotheses;
    const std::size_t paired = std::min(MAX_PAIRED, runs_.size());
    for (std::size_t i = 0; i < runs_.size(); ++i)
    {
      if (runs_[i].turning > MIN_ALONE)
      {
        propose(runs_[i], nullptr, hypotheses);
      }
      for (std::size_t j = i + 1; j < paired; ++j)
      {
        propose(runs_[i], &runs_[j], hypotheses);
      }
    }
    std::stable_sort(hypotheses.begin(), hypotheses.end(),
                     [](const Hypothesis& left, const Hypothesis& right) { return left.turning > right.turning; });
    std::vector<ArcFamily> families;
    for (Hypothesis& hypothesis : hypotheses)
    {
      if (families.size() == MAX_FAMILIES)
      {
        break;
      }
      if (turningOf(hypothesis) > MIN_TURNING)
      {
        refine(hypothesis);
        const ArcFamily family = take(hypothesis);
        if (!family.radii.empty())
        {
          families.push_back(family);
        }
      }
    }
    return families;
  }

 private:
  bool concave(std::size_t arc, const RingFamily& family) const
  {
    return (family.center - arcs_[arc].middle).dot(arcs_[arc].inwards) > 0;
  }

  void propose(const Run& run, const Run* other, std::vector<Hypothesis>& hypotheses)
  {
    const cv::Point2d a = arcs_[(run.first + run.last) / 2].middle;
    const cv::Point2d b = other != nullptr ? arcs_[(other->first + other->last) / 2].middle : a;
    ArcSums sums = run.sums;
    double scale = run.sums.count / std::max(.3, run.turning);
    if (other != nullptr)
    {
      sums = sumOf(run.sums, other->sums);
      scale = std::max(scale, cv::norm(a - b));
    }
    Hypothesis hypothesis;
    if (!fitShape(sums, .5 * (a + b), scale, hypothesis.shape, hypothesis.family) ||
        !concave((run.first + run.last) / 2, hypothesis.family) ||
        !liesOn(run.sums, hypothesis.shape, hypothesis.family) ||
        (other != nullptr && (!concave((other->first + other->last) / 2, hypothesis.family) ||
                              !liesOn(other->sums, hypothesis.shape, hypothesis.family))))
    {
      return;
    }
    hypothesis.turning = turningOf(hypothesis);
    if (hypothesis.turning > MIN_TURNING)
    {
      hypotheses.push_back(hypothesis);
    }
  }

  /** Calls visitor(index) for the arcs of a hypothesis. At their middles first: few have the direction there. */
  template <typename Visitor>
  void visitArcs(const Hypothesis& hypothesis, Visitor&& visitor)
  {
    findAlong(middles_, hypothesis.shape, is_along_.data());
    for (std::size_t i = 0; i < arcs_.size(); ++i)
    {
      if (is_along_[i] != 0 && used_[i] == 0 && liesOn(arcs_[i].sums, hypothesis.shape, hypothesis.family))
      {
        visitor(i);
      }
    }
  }

  double turningOf(const Hypothesis& hypothesis)
  {
    double turning = 0;
    visitArcs(hypothesis, [&](std::size_t i) { turning += arcs_[i].turning; });
    return turning;
  }

  void refine(Hypothesis& hypothesis)
  {
    for (int round = 0; round < 2; ++round)
    {
      ArcSums sums;
      double largest = 1;
      visitArcs(hypothesis, [&](std::size_t i) {
        sums = sumOf(sums, arcs_[i].sums);
        largest = std::max(largest, radiusOf(arcs_[i].sums, hypothesis.shape, hypothesis.family));
      });
      Hypothesis next = hypothesis;
      if (!fitShape(sums, hypothesis.family.center, largest, next.shape, next.family))
      {
        return;
      }
      next.turning = turningOf(next);
      if (next.turning < hypothesis.turning)
      {
        return;
      }
      hypothesis = next;
    }
  }

  /** The circles of the hypothesis' arcs, which no other family gets. */
  ArcFamily take(const Hypothesis& hypothesis)
  {
    ArcFamily result;
    result.family = hypothesis.family;
    std::vector<ArcRadius> circles;
    visitArcs(hypothesis, [&](std::size_t i) {
      circles.emplace_back(radiusOf(arcs_[i].sums, hypothesis.shape, hypothesis.family), arcs_[i].turning);
      result.turning += arcs_[i].turning;
      used_[i] = 1;
    });
    result.radii = circlesOf(std::move(circles));
    return result;
  }

  const std::vector<EdgeArc>& arcs_;
  Middles middles_;
  std::vector<std::int64_t> is_along_;  // the hypothesis that was looked at last
  std::vector<Run> runs_;
  std::vector<char> used_;
};
}  // namespace

std::vector<ArcFamily> findArcFamilies(const std::vector<EdgeArc>& arcs)
{
  return Search(arcs).run();
}

}  // namespace omr
