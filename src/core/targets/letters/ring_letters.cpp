#include "ring_letters.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "color_key.h"
#include "narrow_rings.h"
#include "ring_colors.h"
#include "targets/boundaries/ring_beyond.h"
#include "targets/boundaries/ring_deblur.h"

namespace omr
{
namespace
{
constexpr double SHARP_WIDTH = 7;  // of rings that show their colour in each direction without the blur's help [px]

// A boundary between two rings that read alike, as glare makes them.
constexpr double EVIDENT_CONTRAST = .2;
constexpr double EVIDENT_COHERENCE = .9;
constexpr double EVIDENT_SHARE = .5;

// Distance of the edgels to their boundaries, most, of rings whose letters may explain them worse.
constexpr double CLOSE_RMS = .13;            // [px]
constexpr double CLOSE_RELATIVE_RMS = .001;  // more, relative to the outer radius

// Between two hues compression leaves a faint one of both, and this may have an edge of its own: in 5 of 2200 targets,
// turned, enlarged, noisy or compressed once more, 3 to 7 px wide. Of the rings of the others, of which none is a
// mixture, a black one between red and blue comes nearest, with .36 of the step.
constexpr double HALO_WIDTH = .6;  // most of what has a letter, times that of either neighbour
constexpr double HALO_HUE = .15;   // most, from the line between the neighbours' colours, relative to their step

// Where the inks tell which rings there are.
constexpr double NARROW = 5;          // of the narrowest ring, most [px]
constexpr double ROUND = .7;          // share of the directions, least: outlines of square sheets have .52 to .62
constexpr double SAME_BOUNDARY = .5;  // most, of the width of the narrowest ring
// Narrower rings are hidden by the blur, which inks explain; wider ones by what lies on them. Where the key knows no
// letter of such a one, its ink must leave less: of brown things on disks inks leave 4.4 to 23.
constexpr double COVERED_WIDTH = 5;  // [px]
constexpr double MOST_COVERED_REST = 4;

/** Whether there is a boundary, whatever the colours. */
bool isEvident(const Boundary& boundary)
{
  return boundary.contrast > EVIDENT_CONTRAST && boundary.coherence > EVIDENT_COHERENCE &&
         share(boundary.agreeing & boundary.supported) > EVIDENT_SHARE;
}

/** Whether ring k, which has two neighbours, is far narrower than both. */
bool isNarrow(const std::vector<double>& radii, std::size_t k)
{
  const double inside = radii[k - 1] - (k > 1 ? radii[k - 2] : 0);
  const double outside = radii[k + 1] - radii[k];
  return radii[k] - radii[k - 1] < HALO_WIDTH * std::min(inside, outside);
}

bool isHue(char letter)
{
  return letter == 'R' || letter == 'G' || letter == 'B';
}

/** Whether a colour, in linear light, lies between two others. */
bool isMixture(const LinearColor& color, const LinearColor& from, const LinearColor& to)
{
  const LinearColor step = to - from;
  const double share = (color - from).dot(step) / step.dot(step);
  return share > 0 && share < 1 && cv::norm(from + share * step - color) < HALO_HUE * cv::norm(step);
}

/** Index of a boundary that is no more than the halo of a stronger one, or the number of boundaries. */
std::size_t findHalo(const ColorMeasurement& measure, const std::string& key, const std::vector<Boundary>& boundaries,
                     const std::vector<double>& radii)
{
  std::vector<LinearColor> colors;
  for (std::size_t k = 1; k + 1 < radii.size(); ++k)
  {
    // Beside white every dark ring is nearly a mixture of it and black.
    if (!isHue(key[k - 1]) || !isHue(key[k + 1]) || (key[k] != '?' && !isNarrow(radii, k)))
    {
      continue;
    }
    colors = colors.empty() ? measure() : colors;
    if (isMixture(colors[k], colors[k - 1], colors[k + 1]))
    {
      return boundaries[k].contrast < boundaries[k - 1].contrast ? k : k - 1;
    }
  }
  return radii.size();
}

/**
 * Index of a boundary between rings that read alike, or the number of boundaries.
 *
 * @param key receives '?' for rings that read alike but have an evident boundary.
 */
std::size_t findMerged(const std::vector<Boundary>& boundaries, std::string& key)
{
  const std::string read = key;
  for (std::size_t k = 0; k + 1 < read.size(); ++k)
  {
    if (read[k] != '?' && read[k] == read[k + 1])
    {
      if (!isEvident(boundaries[k]))
      {
        return k;
      }
      key[k] = key[k + 1] = '?';
    }
  }
  return boundaries.size();
}

/** The key's letters, without the boundaries between equal ones and without halos. */
KeyReading readColors(const RingProfile& profile, bool is_close, std::vector<Boundary>& boundaries,
                      std::vector<double>& radii)
{
  while (true)
  {
    std::vector<ColorMeasurement> ways = {[&] { return measureRingColors(profile, boundaries, radii); }};
    const bool is_sharp = narrowestRing(radii) > SHARP_WIDTH;
    if (is_sharp)
    {
      ways.emplace_back([&] { return measureColorsIn(Light::brightest, profile, radii); });
      ways.emplace_back([&] { return measureColorsIn(Light::darkest, profile, radii); });
    }
    // Where its outer boundary shows the colour inside it is the ring's, whatever hides its inner boundary.
    std::vector<bool> seen(radii.size());
    std::transform(boundaries.begin(), boundaries.end(), seen.begin(),
                   [](const Boundary& boundary) { return boundary.shown; });
    KeyReading key = readColorKey(ways, seen, is_sharp, is_close);
    std::size_t k = findHalo(ways.front(), key.letters, boundaries, radii);
    k = k < radii.size() ? k : findMerged(boundaries, key.letters);
    if (k == radii.size())
    {
      return key;
    }
    radii.erase(radii.begin() + static_cast<std::ptrdiff_t>(k));
    boundaries.erase(boundaries.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

AngleBins shownAt(const Boundary& boundary)
{
  return boundary.agreeing & boundary.supported;
}

/**
 * Whether the outermost one shows all around, where one of the two inside it does: something may hide them all. The
 * outline of a small square sheet comes near to a circle on its four sides. @param boundaries at least three.
 */
bool isRound(const std::vector<Boundary>& boundaries)
{
  const std::size_t last = boundaries.size() - 1;
  const AngleBins inside = shownAt(boundaries[last - 1]) | shownAt(boundaries[last - 2]);
  return share(inside & shownAt(boundaries[last])) > ROUND * share(inside);
}

/** Letters that inks explain, but that something may hide, become '?'. @param key what colours alone tell. */
void doubtHidden(const std::string& key, double profile_scale, NarrowRings& rings)
{
  double inner = 0;
  for (std::size_t k = 0; k < rings.radii.size(); ++k)
  {
    const bool is_unexplained = key.size() == rings.radii.size() && key[k] == '?' && rings.rests[k] > MOST_COVERED_REST;
    if (rings.radii[k] - inner > COVERED_WIDTH * profile_scale && is_unexplained)
    {
      rings.letters[k] = '?';
    }
    inner = rings.radii[k];
  }
}

/** Gives the candidate other rings, with what is known of those of their boundaries that were found. */
void takeRings(std::vector<double> radii, RingCandidate& candidate)
{
  const double apart = SAME_BOUNDARY * narrowestRing(radii);
  std::vector<Boundary> found;
  for (std::size_t k = 0; k < candidate.boundaries.size(); ++k)
  {
    const bool stays = std::any_of(radii.begin(), radii.end(),
                                   [&](double radius) { return std::abs(radius - candidate.rings.radii[k]) < apart; });
    if (stays)
    {
      found.push_back(candidate.boundaries[k]);
    }
  }
  candidate.rings.radii = std::move(radii);
  candidate.ring_count = static_cast<int>(candidate.rings.radii.size());
  if (!found.empty() && found.size() < candidate.boundaries.size())
  {
    candidate.boundaries = std::move(found);
    weighEvidence(candidate);
  }
}
}  // namespace

std::string readLetters(RingCandidate& candidate)
{
  const std::vector<double> radii = scaledBy(candidate.profile_scale, candidate.rings.radii);
  std::vector<double> left = radii;
  std::vector<Boundary> boundaries = candidate.boundaries;
  const KeyReading key = readColors(*candidate.profile, fitsClosely(candidate.rings), boundaries, left);
  const std::string& letters = key.letters;
  left = scaledBy(1. / candidate.profile_scale, left);
  // Halos would make narrow rings of wide ones: inks read a noisy BGBRG of 8 px as BGBPRG.
  if (narrowestRing(left) < NARROW)
  {
    NarrowRings rings;
    const auto read = [&](const std::vector<double>& found, Ground ground) {
      return readNarrowRings(*candidate.profile, found, candidate.profile_scale, ground, rings);
    };
    const bool is_sheet = radii.size() > 2 && !isRound(candidate.boundaries);
    if ((is_sheet && read({radii.begin(), radii.end() - 1}, Ground::white)) ||
        read(radii, is_sheet ? Ground::white : Ground::any))
    {
      doubtHidden(letters, candidate.profile_scale, rings);
      takeRings(scaledBy(1. / candidate.profile_scale, rings.radii), candidate);
      candidate.is_explained = true;
      return rings.letters;
    }
  }
  const auto unknown = std::count(letters.begin(), letters.end(), '?');
  const auto hidden = std::count_if(boundaries.begin(), boundaries.end(), [](const Boundary& b) { return !b.shown; });
  candidate.is_certain = key.is_certain && unknown == hidden;
  candidate.boundaries = std::move(boundaries);
  candidate.rings.radii = std::move(left);
  return letters;
}

bool fitsClosely(const Rings& rings)
{
  return rings.rms < CLOSE_RMS + CLOSE_RELATIVE_RMS * rings.radii.back();
}

}  // namespace omr
