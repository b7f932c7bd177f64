#include "small_rings.h"

#include <opencv2/imgproc.hpp>
#include <utility>

#include "resized_part.h"
#include "targets/candidate/ring_acceptance.h"
#include "targets/candidate/ring_places.h"
#include "targets/seeds/arc_seeds.h"

namespace omr
{
namespace
{
constexpr int PIECE = 10;         // half the side of the spot's part whose edges give the family [px]
constexpr int PIECE_MARGIN = 7;   // of what is enlarged to look at them [px]
constexpr int SURROUNDINGS = 36;  // half the side of what is enlarged to grow them [px]
// From their true places, 80 of 81 targets of five sharp rings of 2 to 3 px grow at this factor, 43 in the image and
// 81 at three times; of 144 with rings below 3.6 px in blurred pictures 66, 67 in the image and 37 at three
// times, and 89 at one of them.
constexpr int FACTOR = 2;
// Distance of the edgels to their boundaries, most: sharp ones of equal width have .02 to .095, a painted rose .13.
constexpr double MAX_RMS = .1;         // [px]
constexpr double RELATIVE_RMS = .002;  // more, relative to the outer radius
// The same of four very clear rings and more, as on a pipe: four more are found in 1105 scenes and A, all of them
// right.
constexpr double MAX_CLEAR_RMS = .13;  // [px]
constexpr int MANY_RINGS = 4;
constexpr double CLEARNESS = .95;
// Of a spot's rarer kind of edges, relative to its deviation: one of 160 spots that are targets has less, of the others
// four of five on doe scenes and a third in clutter.
constexpr double LEAST_OTHER_KIND = .7;
constexpr double LEAST_VOTES = .3;  // of the edges of a spot: a quarter to a half of those in clutter have more

constexpr std::size_t MAX_LOOKS = 200000;  // at edgels of the image, for one spot, whatever was spent before

cv::Rect squareAround(const cv::Point2d& center, double half_side)
{
  const int side = cvRound(2 * half_side);
  return {cvRound(center.x - half_side), cvRound(center.y - half_side), side, side};
}

/** A square part of the image, enlarged. */
struct Enlarged
{
  Enlarged(const cv::Mat& bgr, const cv::Point2d& center, int half_side)
  {
    const cv::Rect place = squareAround(center, half_side) & cv::Rect({}, bgr.size());
    part = {FACTOR, place.tl()};
    cv::resize(bgr(place), image, {}, FACTOR, FACTOR, cv::INTER_CUBIC);
  }

  cv::Mat image;
  ResizedPart part;
};

/** The family of a spot's edges. */
bool findSeed(const cv::Mat& bgr, const RoundSpot& spot, RingSeed& seed)
{
  const Enlarged enlarged(bgr, spot.center, PIECE + PIECE_MARGIN);
  EdgelMap map(enlarged.image);
  Region piece;
  piece.box = squareAround(enlarged.part.fromImage(spot.center), PIECE * FACTOR);
  double votes = 0;
  if (!findArcSeed(map, piece, seed, votes) || votes < LEAST_VOTES)
  {
    return false;
  }
  seed.family.center = enlarged.part.toImage(seed.family.center);
  seed.radius /= FACTOR;
  return true;
}

bool growEnlarged(const cv::Mat& bgr, RingSeed seed, RingCandidate& candidate)
{
  const Enlarged enlarged(bgr, seed.family.center, SURROUNDINGS);
  EdgelMap map(enlarged.image);
  seed.family.center = enlarged.part.fromImage(seed.family.center);
  seed.radius *= FACTOR;
  if (!growCandidate(map, enlarged.image, seed, false, candidate))
  {
    return false;
  }
  candidate.image_size = bgr.size();
  candidate.profile_scale = FACTOR;
  RingFamily& family = candidate.rings.family;
  family.center = enlarged.part.toImage(family.center);
  family.hx *= FACTOR;
  family.hy *= FACTOR;
  family.hz *= FACTOR;
  family.bend *= FACTOR;
  candidate.rings.rms /= FACTOR;
  for (double& radius : candidate.rings.radii)
  {
    radius /= FACTOR;
  }
  for (Boundary& boundary : candidate.boundaries)
  {
    boundary.radius /= FACTOR;
  }
  return true;
}

bool isSmallTarget(const RingCandidate& candidate, int min_rings)
{
  const bool is_clear = candidate.ring_count >= MANY_RINGS && candidate.evidence * candidate.visible > CLEARNESS;
  return isTarget(candidate, min_rings) &&
         candidate.rings.rms < (is_clear ? MAX_CLEAR_RMS : MAX_RMS) + RELATIVE_RMS * candidate.rings.radii.back();
}
}  // namespace

bool mayBeRings(const RoundSpot& spot)
{
  return spot.other_kind > LEAST_OTHER_KIND * spot.deviation;
}

bool growSpot(const EdgelMap& map, const cv::Mat& bgr, const RoundSpot& spot, int min_rings, RingCandidate& candidate)
{
  RingSeed seed;
  // Arcs at the image's edge may belong to what lies far outside of it.
  if (!findSeed(bgr, spot, seed) || !cv::Rect2d({}, cv::Size2d(bgr.size())).contains(seed.family.center))
  {
    return false;
  }
  RingCandidate enlarged;
  const bool is_enlarged_target = growEnlarged(bgr, seed, enlarged) && isSmallTarget(enlarged, min_rings);
  EdgelMap fork = map.fork();
  fork.setMaxLooks(fork.looks() + MAX_LOOKS);
  const bool is_target = growCandidate(fork, bgr, seed, false, candidate) && isSmallTarget(candidate, min_rings);
  if (is_enlarged_target && (!is_target || score(enlarged) > score(candidate)))
  {
    candidate = std::move(enlarged);
  }
  return is_target || is_enlarged_target;
}

}  // namespace omr
