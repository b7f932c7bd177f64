#include "outdoor_omr/locate.h"

#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "part_match.h"

namespace omr
{
namespace
{
/** [px]. Rendered flat plates have 0.013 at most, 0.033 where a third is hidden, boards on cylinders 0.148, boards on
 * paper before real cameras 0.07 to 0.18; of 49 boards on cylinders described as flat 27 have more than this. */
constexpr double MISFIT = 0.3;

/** What one seed board can be, best first. */
struct Reading
{
  int seed = 0;
  std::vector<PartMatch> matches;

  int score() const
  {
    return matches.front().score();
  }
};

/** Whether `best`, which is not worse, leaves `other` no chance. */
bool excludes(const PartMatch& best, const PartMatch& other)
{
  if (best.score() != other.score())
  {
    // Only a marker that speaks for one excludes the other: that one speaks against it may be the marker's fault.
    return best.score() > 0 || best.supports() > other.supports();
  }
  const bool same_pixels = best.checkerboards == other.checkerboards && best.targets == other.targets;
  return same_pixels && !isRival(best.poses.front(), other.poses.front());
}

bool isBetter(const PartMatch& a, const PartMatch& b)
{
  if (a.score() != b.score())
  {
    return a.score() > b.score();
  }
  return a.poses.front().chi_square < b.poses.front().chi_square;
}

/** The readings of one board; none if no part explains it. */
Reading read(int seed, const SeenMarkers& seen, const std::vector<Part>& parts, const Camera& camera)
{
  Reading reading{seed, {}};
  const Checkerboard& board = seen.checkerboards[seed];
  for (const PartHypothesis& hypothesis : partHypotheses(board, parts, camera))
  {
    PartMatch match = matchPart(hypothesis, seed, seen, camera);
    // A board that may be larger could be any section of it: only another marker tells which.
    if (!match.poses.empty() && (board.size_certain || match.score() > 0))
    {
      reading.matches.push_back(std::move(match));
    }
  }
  std::vector<PartMatch>& matches = reading.matches;
  std::stable_sort(matches.begin(), matches.end(), isBetter);
  if (matches.empty())
  {
    return reading;
  }
  const PartMatch best = matches.front();
  matches.erase(
      std::remove_if(matches.begin() + 1, matches.end(), [&](const PartMatch& other) { return excludes(best, other); }),
      matches.end());
  const auto is_refuted = [](const PartMatch& match) { return match.contradictions > 0 && match.supports() == 0; };
  if (std::all_of(matches.begin(), matches.end(), is_refuted))
  {
    matches.clear();
  }
  return reading;
}

template <typename Function>
void forMarkers(const Reading& reading, const Function& function)
{
  for (const PartMatch& match : reading.matches)
  {
    std::for_each(match.checkerboards.begin(), match.checkerboards.end(), [&](int i) { function(true, i); });
    std::for_each(match.targets.begin(), match.targets.end(), [&](int i) { function(false, i); });
  }
}

Sighting sightingOf(const Reading& reading)
{
  Sighting sighting;
  for (const PartMatch& match : reading.matches)
  {
    for (const Pose& pose : match.poses)
    {
      const bool known =
          std::any_of(sighting.candidates.begin(), sighting.candidates.end(), [&](const PartPose& other) {
            return other.part == match.part->name && isSamePose(other.pose.camera_part, pose.camera_part);
          });
      if (!known)
      {
        sighting.candidates.push_back({match.part->name, pose, match.checkerboards, match.targets});
      }
    }
  }
  return sighting;
}

/** Sightings in the making: of a part there are no more places than copies. */
class Sightings
{
 public:
  /** To be called with the best supported readings first. */
  void add(const Reading& reading)
  {
    Sighting sighting = sightingOf(reading);
    if (sighting.certain())
    {
      places_[reading.matches.front().part].push_back({sighting.candidates.front(), reading.score()});
      return;
    }
    ambiguous_.push_back(std::move(sighting));
  }

  /** Of a part with more places than copies those with more markers stay; equals, of which one at least is none, are
   * candidates of one sighting. */
  std::vector<Sighting> all() const
  {
    std::vector<Sighting> sightings;
    for (const auto& [part, places] : places_)
    {
      const auto copies = static_cast<std::size_t>(part->copies);
      const bool too_many = places.size() > copies;
      const int score_left_out = too_many ? places[copies].score : -1;
      Sighting equals;
      for (const Place& place : places)
      {
        if (!too_many || place.score > score_left_out)
        {
          sightings.push_back({{place.found}});
        }
        else if (place.score == score_left_out && places[copies - 1].score == score_left_out)
        {
          equals.candidates.push_back(place.found);
        }
      }
      if (!equals.candidates.empty())
      {
        sightings.push_back(std::move(equals));
      }
    }
    sightings.insert(sightings.end(), ambiguous_.begin(), ambiguous_.end());
    return sightings;
  }

 private:
  struct Place
  {
    PartPose found;
    int score = 0;
  };

  std::map<const Part*, std::vector<Place>> places_;
  std::vector<Sighting> ambiguous_;
};

/** The best supported of the readings that explain something; the end if none does. */
std::vector<Reading>::iterator bestReading(std::vector<Reading>& readings)
{
  return std::min_element(readings.begin(), readings.end(), [](const Reading& a, const Reading& b) {
    if (a.score() != b.score())
    {
      return a.score() > b.score();
    }
    return a.matches.size() < b.matches.size();
  });
}
}  // namespace

std::vector<Sighting> locateParts(const std::vector<Checkerboard>& checkerboards, const std::vector<Target>& targets,
                                  const std::vector<Part>& parts, const Camera& camera)
{
  SeenMarkers seen{checkerboards, targets, std::vector<bool>(checkerboards.size(), true),
                   std::vector<bool>(targets.size(), true)};
  std::vector<Reading> readings;
  readings.reserve(checkerboards.size());
  for (int i = 0; i < static_cast<int>(checkerboards.size()); ++i)
  {
    readings.push_back(read(i, seen, parts, camera));
  }
  Sightings sightings;
  while (true)
  {
    const auto explains_nothing = [](const Reading& reading) { return reading.matches.empty(); };
    readings.erase(std::remove_if(readings.begin(), readings.end(), explains_nothing), readings.end());
    const auto best = bestReading(readings);
    if (best == readings.end())
    {
      return sightings.all();
    }
    // The best are first, so a part's later sightings have fewer markers or as many.
    const Reading taken = *best;
    readings.erase(best);
    sightings.add(taken);
    forMarkers(taken, [&](bool is_board, int i) { (is_board ? seen.checkerboard_free : seen.target_free)[i] = false; });
    for (Reading& reading : readings)
    {
      bool changed = false;
      forMarkers(reading, [&](bool is_board, int i) {
        changed = changed || !(is_board ? seen.checkerboard_free : seen.target_free)[i];
      });
      if (!seen.checkerboard_free[reading.seed])
      {
        reading.matches.clear();
      }
      else if (changed)
      {
        reading = read(reading.seed, seen, parts, camera);
      }
    }
  }
}

std::vector<Sighting> locateParts(const Markers& markers, const std::vector<Part>& parts, const Camera& camera)
{
  std::vector<Checkerboard> checkerboards = markers.checkerboards;
  checkerboards.insert(checkerboards.end(), markers.sections.begin(), markers.sections.end());
  return locateParts(checkerboards, markers.targets, parts, camera);
}

std::string misfitOf(const std::string& part, double reprojection_error)
{
  if (!(reprojection_error > MISFIT))
  {
    return "";
  }
  std::ostringstream words;
  words << std::fixed << std::setprecision(2) << part << ": reprojection error " << reprojection_error
        << " px, more than " << MISFIT
        << ": likely its description in the parts file, its surface or the camera's calibration is off";
  return words.str();
}

}  // namespace omr
