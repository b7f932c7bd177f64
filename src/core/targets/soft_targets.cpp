#include "soft_targets.h"

#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "resized_part.h"
#include "ring_lookahead.h"
#include "target_reading.h"
#include "targets/candidate/ring_places.h"
#include "targets/edges/edgels.h"
#include "targets/seeds/arc_search.h"

namespace omr
{
namespace
{
// Of 20 drawn targets with rings of 20 to 100 px and a blur of a tenth to three tenths of that the image shows 8, this
// reduction 11 more.
constexpr int REDUCTION = 4;

/** The families of an image as they lie in the reduced one. */
std::vector<ArcFamily> reducedFamilies(std::vector<ArcFamily> families)
{
  constexpr double SHIFT = (REDUCTION - 1) / 2.;  // of the centre of a block
  for (ArcFamily& family : families)
  {
    family.family.center = (family.family.center - cv::Point2d(SHIFT, SHIFT)) * (1. / REDUCTION);
    for (double& radius : family.radii)
    {
      radius /= REDUCTION;
    }
  }
  return families;
}
}  // namespace

std::vector<Target> findSoftTargets(const cv::Mat& bgr, const std::vector<ArcFamily>& arcs,
                                    const std::vector<Checkerboard>& boards, const std::vector<RingCandidate>& refused,
                                    int min_rings, const std::atomic<bool>* is_vain)
{
  const cv::Size size(bgr.cols / REDUCTION, bgr.rows / REDUCTION);
  if (size.empty() || (is_vain != nullptr && *is_vain))
  {
    return {};
  }
  cv::Mat reduced;  // the middle of each block of pixels: a mean of all would take longer than the search
  cv::resize(bgr(cv::Rect(cv::Point(), size * REDUCTION)), reduced, size, 0, 0, cv::INTER_LINEAR);
  RoundSeeds seeds;
  if (arcReduction(bgr.size()) >= REDUCTION)  // the reduced image has no others: a tenth of the time of 8 megapixels
  {
    seeds.arcs = reducedFamilies(arcs);
    seeds.has_arcs = true;
  }
  growFamilies(EdgelMap(reduced), reduced, min_rings, seeds);
  std::vector<RingCandidate> candidates;
  for (GrownSeed& family : seeds.families)
  {
    if (family.is_target)
    {
      candidates.push_back(std::move(family.candidate));
    }
  }
  std::vector<Target> targets;
  for (Target& target : readTargets({}, bestOfEachPlace(std::move(candidates)), min_rings))
  {
    moveToImage({1. / REDUCTION, {}}, target);
    // Wheels have soft rings, too, but no letters: the picture of one among 647 that are not of the evaluation.
    const bool is_read = target.colors.find('?') == std::string::npos;
    if (is_read && !isOnBoard(target.center, boards) && !isInAny(refused, target.center))
    {
      targets.push_back(std::move(target));
    }
  }
  return targets;
}

}  // namespace omr
