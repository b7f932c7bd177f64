#include "ring_lookahead.h"

#include <opencv2/imgproc.hpp>

#include "targets/edges/look_budget.h"
#include "targets/seeds/arc_search.h"

namespace omr
{
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

}  // namespace omr
