#include "ring_lookahead.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "targets/candidate/ring_own_boundary.h"
#include "targets/candidate/ring_places.h"
#include "targets/edges/look_budget.h"
#include "targets/seeds/arc_search.h"

namespace omr
{
void growSeed(const cv::Mat& bgr, const RingSeed& seed, bool is_boundary, int min_rings, GrownSeed& grown)
{
  grown.settle(growCandidate(grown.map, bgr, seed, is_boundary, grown.candidate), min_rings);
}

void addRoundSeeds(const RegionMap& regions, RoundSeeds& seeds)
{
  if (!seeds.has_seeds)
  {
    seeds.seeds = findRoundSeeds(regions.regions);
    seeds.grown.resize(seeds.seeds.size());
    seeds.has_seeds = true;
  }
}

void growFamilies(const EdgelMap& map, const cv::Mat& bgr, int min_rings, RoundSeeds& seeds)
{
  if (seeds.has_families)
  {
    return;
  }
  if (!seeds.has_arcs)
  {
    seeds.arcs = searchArcFamilies(bgr);
    seeds.has_arcs = true;
  }
  const std::vector<ArcFamily>& families = seeds.arcs;
  EdgelMap start = map;
  start.setMaxLooks(sharedLooks(bgr.size(), FAMILIES_SHARE));
  for (std::size_t i = 0; i < families.size(); ++i)
  {
    seeds.families.emplace_back(start.fork());
  }
  cv::parallel_for_(cv::Range(0, static_cast<int>(families.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
    {
      GrownSeed& grown = seeds.families[i];
      grown.settle(growCandidate(grown.map, bgr, families[i].family, families[i].radii, grown.candidate), min_rings);
    }
  });
  seeds.has_families = true;
}

void addRoundSpots(const cv::Mat& image, RoundSeeds& seeds)
{
  if (!seeds.has_spots)
  {
    cv::Mat grey = image;
    if (image.channels() == 3)
    {
      cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    }
    seeds.spots = findRoundSpots(grey);
    seeds.has_spots = true;
  }
}

void growConcentric(const EdgelMap& map, const cv::Mat& bgr, int min_rings, RoundSeeds& seeds)
{
  EdgelMap own = map;
  own.setMaxLooks(sharedLooks(bgr.size(), CONCENTRIC_SHARE));
  std::vector<RingCandidate> candidates;
  for (const GrownSeed& family : seeds.families)
  {
    own.join(family.map);
    if (family.is_target)
    {
      candidates.push_back(family.candidate);
    }
  }
  for (std::size_t i = 0; i < seeds.seeds.size() && !own.isSpent(); ++i)
  {
    const RingSeed& seed = seeds.seeds[i];
    if (seed.companions > 0 && !isInUndisputed(candidates, seed.family.center))
    {
      GrownSeed grown(own.fork());
      if (hasOwnBoundary(grown.map, bgr, seed))
      {
        growSeed(bgr, seed, true, min_rings, grown);
      }
      own.join(grown.map);
      if (grown.is_target)
      {
        candidates.push_back(grown.candidate);
      }
      if (grown.is_target || !grown.map.isSpent())  // else it may have been cut off: it is grown anew
      {
        seeds.grown[i].emplace(std::move(grown));
      }
    }
  }
}

}  // namespace omr
