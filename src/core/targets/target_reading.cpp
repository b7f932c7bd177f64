#include "target_reading.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "targets/boundaries/ring_placement.h"
#include "targets/candidate/ring_amendment.h"
#include "targets/letters/hidden_rings.h"
#include "targets/letters/ring_letters.h"

namespace omr
{
namespace
{
// Distance of the edgels to their boundaries, most, of a target of which half is unknown; and of one without letters,
// unless it is very clear: a helicopter's landing place comes near to one.
constexpr double HALF_READ_RMS = .13;  // [px]
constexpr double UNREAD_RMS = .085;    // [px]
constexpr double RELATIVE_RMS = .001;  // more, relative to the outer radius
// Of three rings below this all are to be read, or all but one of very clear ones: the eyes of ultrasonic sensors are
// 42 px wide. Small ones must be very clear, unless all are read and one has a hue: at 15 to 17 px these eyes have .89
// to .94, targets below 30 px .956 and more. An eye of 19 px has .97, but no colour in its middle: the disk of small
// ones must be read. In 1040 drawn and 65 path-traced scenes 10 of them are clear enough so, all of them right, and
// nothing more in 2138 drawings and photographs.
constexpr double MEDIUM_DIAMETER = 50;  // [px]
constexpr double SMALL_DIAMETER = 30;   // [px]
constexpr double EYE_DIAMETER = 20;     // below it they pass for rings with a hue [px]
// Clearness: evidence x visible share. With unknown rings the least: lenses, eyes and signs have rings too, and no
// letters.
constexpr double CLEAR = .85;
constexpr double VERY_CLEAR = .95;
// The pixels place a target to a tenth of a pixel, the less exactly the larger it is: of 1600 in rendered scenes, two
// of three partly hidden or of narrow rings, the least surely one has .15 px, of 2300 in these scenes turned, reduced,
// noisy, soft or hazy .16. The wheel of a bus has .20: its rings are not concentric. What has no hue and of which more
// than a sixth cannot be read is a wheel more often than a target: a toothed one has .046, that of an aircraft .074. Of
// CCTag's and archers' targets no more than a sixth is not read.
constexpr double UNSURE = .15;             // deviation of the centre of the outermost ellipse [px]
constexpr double DOUBTFUL_UNSURE = .03;    // [px]
constexpr int DOUBTFUL_SHARE = 6;          // one of so many
constexpr double RELATIVE_UNSURE = .0005;  // more, relative to the outer radius
// Of rings that inks do not explain. Of 1691 targets in drawn scenes 62 are so narrow and so little read, of which 37
// have another number of rings.
constexpr double NARROW_WIDTH = 3;       // with half of the rings unknown [px]
constexpr double NARROWEST_WIDTH = 2.5;  // with any [px]
// A ring far narrower than the others is none, or the others hide some: of 3270 targets in 1160 drawn and 87
// path-traced scenes, A and the evaluation 5 of 60 with another number of rings have one, and no other; below .4 one
// other.
constexpr double FAR_NARROWER = .35;  // times the mean width of the others
// What is left without a hole in the disk has so many, each with its letter: in these scenes and B six targets more are
// found, all of them with the right number of rings, and nothing more in 2138 drawings and photographs.
constexpr std::size_t LEFT_RINGS = 3;

bool isFarNarrower(const std::vector<double>& radii, std::size_t k)
{
  const double width = radii[k] - (k > 0 ? radii[k - 1] : 0);
  return width < FAR_NARROWER * (radii.back() - width) / static_cast<double>(radii.size() - 1);
}

bool hasFarNarrowerRing(const std::vector<double>& radii)
{
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    if (isFarNarrower(radii, k))
    {
      return true;
    }
  }
  return false;
}

bool isRead(const std::string& letters)
{
  return letters.find('?') == std::string::npos;
}

/**
 * Whether so much of narrow rings is unknown that the blur probably hides some of them: those that inks explain have
 * their right number, whatever is unknown.
 */
bool isBlurred(const RingCandidate& candidate, int count, int unknown)
{
  const double width = narrowestRing(candidate.rings.radii);
  return !candidate.is_explained &&
         ((width < NARROW_WIDTH && 2 * unknown >= count) || (width < NARROWEST_WIDTH && unknown > 0));
}

bool hasHue(const std::string& letters)
{
  return letters.find_first_of("RGB") != std::string::npos;
}

/** Whether small rings, each with its letter, fit closely enough: eyes and lenses have no hue. */
bool isKnownSmall(const Target& target, const RingCandidate& candidate)
{
  return hasHue(target.colors) && fitsClosely(candidate.rings) && 2 * candidate.rings.radii.back() > EYE_DIAMETER &&
         (candidate.is_explained || narrowestRing(candidate.rings.radii) > NARROWEST_WIDTH);
}

/**
 * Whether something hides the disk, and the other rings are certain: of 240 drawn targets with a bar across their disk
 * 102 instead of 82 are found, as many wrong, and nothing more in 2138 drawings and photographs.
 */
bool isCoveredInPart(const Target& target, const RingCandidate& candidate)
{
  return candidate.is_certain && !candidate.boundaries.front().shown && hasHue(target.colors) &&
         fitsClosely(candidate.rings);
}

/**
 * Three narrow rings and fewer, which lenses and letters have too, are a target only if nearly all can be read; a
 * target of which half cannot be read must fit well.
 */
bool isReadable(const Target& target, const RingCandidate& candidate, int min_rings)
{
  const auto count = static_cast<int>(target.colors.size());
  const auto unknown = static_cast<int>(std::count(target.colors.begin(), target.colors.end(), '?'));
  const double clearness = candidate.evidence * candidate.visible;
  const double most = (unknown < count || clearness > VERY_CLEAR ? HALF_READ_RMS : UNREAD_RMS) +
                      RELATIVE_RMS * candidate.rings.radii.back();
  if (count < min_rings || isBlurred(candidate, count, unknown) || (2 * unknown >= count && candidate.rings.rms > most))
  {
    return false;
  }
  const cv::Size2f size = target.rings.back().size;
  const float diameter = std::min(size.width, size.height);
  if (count <= 3 && diameter < MEDIUM_DIAMETER)
  {
    const bool is_small = diameter < SMALL_DIAMETER;
    const bool is_all_needed = is_small && target.colors[0] == '?';
    const bool is_known = unknown == 0 && (!is_small || isKnownSmall(target, candidate));
    return unknown <= (is_all_needed ? 0 : 1) &&
           (clearness > VERY_CLEAR || is_known || (!is_small && isCoveredInPart(target, candidate)));
  }
  return unknown == 0 || diameter > MEDIUM_DIAMETER || clearness > CLEAR;
}

/** Whether the pixels place it as one does that is a target. */
bool isSure(const Target& target, double radius)
{
  const auto count = static_cast<int>(target.colors.size());
  const auto unknown = static_cast<int>(std::count(target.colors.begin(), target.colors.end(), '?'));
  const bool is_doubtful = !hasHue(target.colors) && unknown * DOUBTFUL_SHARE > count;
  const double limit = (is_doubtful ? DOUBTFUL_UNSURE : UNSURE) + RELATIVE_UNSURE * radius;
  return target.outermost_deviation < limit;
}

void setRings(const Rings& rings, Target& target)
{
  target.center = cv::Point2f(rings.family.center);
  target.rings.clear();
  for (const double radius : rings.radii)
  {
    target.rings.push_back(rings.family.ellipse(radius));
  }
}

/** @return false if the colours are no target's, or not those of these rings. */
bool toTarget(const cv::Mat& bgr, RingCandidate candidate, int min_rings, Target& target)
{
  target.colors = readLetters(candidate);
  if ((candidate.is_merged && !(candidate.is_explained && isRead(target.colors))) ||
      hidesRings(candidate, target.colors))
  {
    return false;
  }
  setRings(candidate.rings, target);
  if (!isReadable(target, candidate, min_rings))
  {
    return false;
  }
  if (!bgr.empty() && !candidate.rings.family.isBent())
  {
    const std::optional<double> deviation =
        placeRings(bgr, candidate.boundaries, candidate.rings.family, candidate.rings.radii);
    if (!deviation)
    {
      return false;
    }
    target.outermost_deviation = *deviation;
    setRings(candidate.rings, target);
  }
  return isSure(target, candidate.rings.radii.back()) && !hasFarNarrowerRing(candidate.rings.radii);
}

/**
 * Without a boundary inside the disk: a hole in it or dirt on it has one that makes a ring far narrower than the
 * others.
 *
 * @param target what toTarget() refused.
 */
bool toTargetWithWholeDisk(const cv::Mat& bgr, const RingCandidate& candidate, int min_rings, Target& target)
{
  const std::vector<double>& radii = candidate.rings.radii;
  if (radii.size() <= LEFT_RINGS || target.colors.find('?') > 1)
  {
    return false;
  }
  const bool is_second = isFarNarrower(radii, 1);
  const std::size_t last = is_second ? 1 : 0;
  for (std::size_t k = 0; k <= last && (is_second || isFarNarrower(radii, 0)); ++k)
  {
    RingCandidate fewer = candidate;
    removeBoundary(k, fewer);
    --fewer.ring_count;
    weighEvidence(fewer);
    if (toTarget(bgr, std::move(fewer), min_rings, target) && isRead(target.colors))
    {
      return true;
    }
  }
  return false;
}
}  // namespace

std::vector<Target> readTargets(const cv::Mat& bgr, const std::vector<RingCandidate>& candidates, int min_rings)
{
  std::vector<Target> read(candidates.size());
  std::vector<char> is_target(candidates.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(candidates.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
    {
      const RingCandidate& candidate = candidates[i];
      is_target[i] =
          toTarget(bgr, candidate, min_rings, read[i]) || toTargetWithWholeDisk(bgr, candidate, min_rings, read[i]);
    }
  });
  std::vector<Target> targets;
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    if (is_target[i] != 0)
    {
      targets.push_back(std::move(read[i]));
    }
  }
  return targets;
}

}  // namespace omr
