#ifndef OUTDOOR_OMR_LOCATE_H
#define OUTDOOR_OMR_LOCATE_H

#include <string>
#include <vector>

#include "outdoor_omr/camera.h"
#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/markers.h"
#include "outdoor_omr/parts.h"
#include "outdoor_omr/pose.h"
#include "outdoor_omr/target.h"

namespace omr
{
/** A part, its pose, and the markers that carried it. */
struct PartPose
{
  std::string part;
  Pose pose;
  std::vector<int> checkerboards;  ///< indices of the detected boards, those of sections after those of the boards
  std::vector<int> targets;        ///< indices of the detected targets
};

/** What one group of markers in the image can be, likeliest first. Only one that is certain is fit for use. */
struct Sighting
{
  std::vector<PartPose> candidates;  ///< at least one; more where the markers in view do not tell them apart

  bool certain() const
  {
    return candidates.size() == 1;
  }
};

/**
 * Recognises parts by the combination of their markers (paper, sections 3.4 and 4.1) and measures their poses.
 *
 * Every seen board starts a candidate for every board of its size in the parts file, in every orientation that its
 * squares allow; the part's other markers are then looked for where the pose expects them. Markers that are there speak
 * for the candidate, targets of other colours there against it, and so do boards that lie near their place but do not
 * fit it; one that just is not seen does not count. More markers beat fewer; among equals the reprojection error
 * decides, if it does (isRival()), else all are reported. Nothing is excluded by a marker that speaks against it alone:
 * that may be misread. What only such markers remain of is not reported: it is a foreign thing with a like board.
 *
 * A board whose size is not certain, or a section of one, carries a part only together with another marker of it, and
 * as any section of the part's board. A part is at as many places as it has copies: where more groups of markers carry
 * it, those with the most have it, and equals are the candidates of one sighting.
 *
 * @param camera must be that of the image in which the markers were found.
 * @return one for each group of markers that fits a part; a marker belongs to one sighting.
 */
std::vector<Sighting> locateParts(const std::vector<Checkerboard>& checkerboards, const std::vector<Target>& targets,
                                  const std::vector<Part>& parts, const Camera& camera);

/** The same from all markers, sections of boards among them. */
std::vector<Sighting> locateParts(const Markers& markers, const std::vector<Part>& parts, const Camera& camera);

/**
 * What is likely wrong where a part's markers do not lie where its pose expects them, in words that name the part;
 * empty where they do. @param reprojection_error Pose::rms_error [px].
 */
std::string misfitOf(const std::string& part, double reprojection_error);

}  // namespace omr

#endif
