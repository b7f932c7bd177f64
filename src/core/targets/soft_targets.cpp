#include "soft_targets.h"

#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "resized_part.h"
#include "ring_lookahead.h"
#include "target_reading.h"
#include "targets/candidate/ring_candidate.h"
#include "targets/candidate/ring_places.h"
#include "targets/edges/edgels.h"

namespace omr
{
namespace
{
// Of 20 drawn targets with rings of 20 to 100 px and a blur of a tenth to three tenths of that the image shows 8, this
// reduction 11 more.
constexpr int REDUCTION = 4;
}  // namespace

std::vector<Target> findSoftTargets(const cv::Mat& bgr, const std::vector<Checkerboard>& boards, int min_rings,
                                    const std::atomic<bool>* is_vain)
{
  const cv::Size size(bgr.cols / REDUCTION, bgr.rows / REDUCTION);
  if (size.empty() || (is_vain != nullptr && *is_vain))
  {
    return {};
  }
  cv::Mat reduced;  // the middle of each block of pixels: a mean of all would take longer than the search
  cv::resize(bgr(cv::Rect(cv::Point(), size * REDUCTION)), reduced, size, 0, 0, cv::INTER_LINEAR);
  RoundSeeds seeds;
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
    if (is_read && !isOnBoard(target.center, boards))
    {
      targets.push_back(std::move(target));
    }
  }
  return targets;
}

}  // namespace omr
