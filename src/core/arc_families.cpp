#include "arc_families.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "arc_circles.h"

namespace omr
{
namespace
{
constexpr double MAX_SINE = .13;               // root mean square of an arc's, that lies on a family
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
  ArcSums sums;
  std::size_t first = 0, last = 0;
  double turning = 0;
};

bool liesOn(const ArcSums& sums, const ShapeVector& shape, const RingFamily& family)
{
  if (sums.squaredSine(shape) > MAX_SINE * MAX_SINE)
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
  explicit Search(const std::vector<EdgeArc>& arcs) : arcs_(arcs), used_(arcs.size(), 0)
  {
    for (std::size_t i = 0; i < arcs.size(); ++i)
    {
      if (!runs_.empty() && arcs[i].chain == arcs[runs_.back().last].chain)
      {
        Run& run = runs_.back();
        run.sums = joined(run.sums, arcs[i].sums);
        run.last = i;
        run.turning += arcs[i].turning;
      }
      else
      {
        runs_.push_back({arcs[i].sums, i, i, arcs[i].turning});
      }
    }
    std::stable_sort(runs_.begin(), runs_.end(),
                     [](const Run& left, const Run& right) { return left.turning > right.turning; });
  }

  std::vector<ArcFamily> run()
  {
    std::vector<Hypothesis> hypotheses;
    const std::size_t paired = std::min(MAX_PAIRED, runs_.size());
    for (std::size_t i = 0; i < runs_.size() && runs_[i].turning > MIN_PAIRED; ++i)
    {
      if (runs_[i].turning > MIN_ALONE)
      {
        propose(runs_[i], nullptr, hypotheses);
      }
      for (std::size_t j = i + 1; i < paired && j < paired && runs_[j].turning > MIN_PAIRED; ++j)
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

  bool belongs(std::size_t arc, const Hypothesis& hypothesis) const
  {
    // At its middle first: few arcs have the direction.
    const ShapeVector& shape = hypothesis.shape;
    const EdgeArc& candidate = arcs_[arc];
    const cv::Point2d& p = candidate.middle;
    const double gx = shape[0] * p.x + shape[1] * p.y - shape[3];
    const double gy = shape[1] * p.x + shape[2] * p.y - shape[4];
    const double cross = candidate.inwards.x * gy - candidate.inwards.y * gx;
    return cross * cross < MAX_MIDDLE_SINE * MAX_MIDDLE_SINE * (gx * gx + gy * gy) &&
           candidate.inwards.x * gx + candidate.inwards.y * gy < 0 && used_[arc] == 0 &&
           liesOn(candidate.sums, shape, hypothesis.family);
  }

  double turningOf(const Hypothesis& hypothesis) const
  {
    double turning = 0;
    for (std::size_t i = 0; i < arcs_.size(); ++i)
    {
      turning += belongs(i, hypothesis) ? arcs_[i].turning : 0;
    }
    return turning;
  }

  void refine(Hypothesis& hypothesis) const
  {
    for (int round = 0; round < 2; ++round)
    {
      ArcSums sums;
      double largest = 1;
      for (std::size_t i = 0; i < arcs_.size(); ++i)
      {
        if (belongs(i, hypothesis))
        {
          sums = sumOf(sums, arcs_[i].sums);
          largest = std::max(largest, radiusOf(arcs_[i].sums, hypothesis.shape, hypothesis.family));
        }
      }
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
    for (std::size_t i = 0; i < arcs_.size(); ++i)
    {
      if (belongs(i, hypothesis))
      {
        circles.emplace_back(radiusOf(arcs_[i].sums, hypothesis.shape, hypothesis.family), arcs_[i].turning);
        result.turning += arcs_[i].turning;
        used_[i] = 1;
      }
    }
    result.radii = circlesOf(std::move(circles));
    return result;
  }

  const std::vector<EdgeArc>& arcs_;
  std::vector<Run> runs_;
  std::vector<char> used_;
};
}  // namespace

std::vector<ArcFamily> findArcFamilies(const std::vector<EdgeArc>& arcs)
{
  return Search(arcs).run();
}

}  // namespace omr
