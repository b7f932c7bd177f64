#include "enlargement.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "marker_box.h"
#include "resized_part.h"

namespace omr
{
namespace
{
/** Cells of candidates that are enlarged, at most [px]: larger squares than three of them gain nothing. */
constexpr int MAX_CELL = 4;

/** Pixels of an enlargement at most: a quarter of a full-HD frame bounds the time. */
constexpr double MAX_PIXELS = 518400;

/** Least share of a candidate's box that is filled by what is read there. The windows of a target lie about its centre,
 * in a box of 11.6 cells at most, and two rings of 0.9 cells, the least that a target has, fill a tenth of it. */
constexpr double FILLED = .1;

/** The box and half its size on each side, within the image. */
cv::Rect surroundings(const cv::Rect& box, const cv::Size& image)
{
  const cv::Point margin(box.width / 2, box.height / 2);
  return cv::Rect(box.tl() - margin, box.br() + margin) & cv::Rect({}, image);
}

bool isSmall(const cv::Rect& place, double factor)
{
  return place.area() * factor * factor <= MAX_PIXELS;
}

bool overlaps(const cv::Rect& box, const Markers& markers)
{
  const auto hit = [&box](const auto& marker) { return (box & boxOf(marker)).area() > 0; };
  return std::any_of(markers.checkerboards.begin(), markers.checkerboards.end(), hit) ||
         std::any_of(markers.targets.begin(), markers.targets.end(), hit);
}

/** Adds what suits the candidate and lies over no marker that is known. @return whether there was any. */
template <typename Marker>
bool addFound(std::vector<Marker>& found, const Candidate& candidate, const ResizedPart& part, const Markers& known,
              std::vector<Marker>& markers)
{
  bool any = false;
  for (Marker& marker : found)
  {
    moveToImage(part, marker);
    const cv::Rect box = boxOf(marker);
    if ((box & candidate.box).area() >= FILLED * candidate.box.area() && !overlaps(box, known))
    {
      markers.push_back(std::move(marker));
      any = true;
    }
  }
  return any;
}

bool lookAt(const cv::Mat& bgr, const Candidate& candidate, const std::function<Markers(const cv::Mat&)>& detect,
            Markers& markers)
{
  const cv::Rect place = surroundings(candidate.box, bgr.size());
  for (const int factor : {2, 3})
  {
    if (!isSmall(place, factor))
    {
      return false;
    }
    cv::Mat enlarged;
    cv::resize(bgr(place), enlarged, {}, factor, factor, cv::INTER_CUBIC);
    Markers found = detect(enlarged);
    const ResizedPart part = {static_cast<double>(factor), place.tl()};
    const bool board = addFound(found.checkerboards, candidate, part, markers, markers.checkerboards);
    const bool target = addFound(found.targets, candidate, part, markers, markers.targets);
    if (board || target)
    {
      return true;
    }
  }
  return false;
}
}  // namespace

void readEnlarged(const cv::Mat& bgr, int looks, const std::function<Markers(const cv::Mat&)>& detect, Markers& markers)
{
  for (Candidate& candidate : markers.candidates)
  {
    if (looks == 0)
    {
      return;
    }
    if (!candidate.read && candidate.cell <= MAX_CELL && isSmall(surroundings(candidate.box, bgr.size()), 2))
    {
      candidate.read = lookAt(bgr, candidate, detect, markers);
      --looks;
    }
  }
}

}  // namespace omr
