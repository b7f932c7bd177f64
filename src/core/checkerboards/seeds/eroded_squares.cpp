#include "eroded_squares.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "checkerboards/corners/local_frame.h"
#include "median.h"
#include "saturated_islands.h"
#include "square_shape.h"

namespace omr
{
namespace
{
constexpr int WHITE = 235;                // grey value that pictures in too much light exceed on paper
constexpr float MAX_PART_SIDE = 40;       // squares; the largest board lying diagonally, with its surroundings, has 38
constexpr float SURROUNDINGS = 4;         // squares
constexpr std::size_t MAX_PARTS = 3;      // bounds the time
constexpr std::size_t MAX_ISLANDS = 600;  // three boards of the largest size have as many dark squares

/** A dark square with its place among the others. */
struct Place
{
  LocalFrame frame;  ///< from its centre, the sides as printed
  float height = 0;  ///< [px]
  float width = 0;   ///< as seen [squares as printed]
  float shape = 0;   ///< how far it reaches towards its neighbours, relative to that towards the white: 1 of squares
};

/** The largest islands in the open. */
std::vector<Island> islandsIn(const Frame& frame, const SearchMap& open)
{
  constexpr int MIN_AREA = 4;  // px
  std::vector<Island> islands = findIslands(frame.grey.front(), WHITE);
  islands.erase(
      std::remove_if(islands.begin(), islands.end(),
                     [&](const Island& island) { return island.area < MIN_AREA || !open.isOpen(island.center); }),
      islands.end());
  if (islands.size() > MAX_ISLANDS)
  {
    std::nth_element(islands.begin(), islands.begin() + MAX_ISLANDS, islands.end(),
                     [](const Island& a, const Island& b) { return a.area > b.area; });
    islands.resize(MAX_ISLANDS);
  }
  return islands;
}

/** Steps to the nearest islands that are alike in size, nearest first. */
void stepsToNeighbours(const Island& island, const std::vector<Island>& islands, std::vector<cv::Point2f>& steps)
{
  constexpr std::size_t MAX_STEPS = 8;
  constexpr int MAX_RATIO = 3;  // of the areas
  const auto is_nearer = [](const cv::Point2f& a, const cv::Point2f& b) { return a.dot(a) < b.dot(b); };
  steps.clear();
  for (const Island& other : islands)
  {
    const cv::Point2f step = other.center - island.center;
    if (&other == &island || other.area > MAX_RATIO * island.area || island.area > MAX_RATIO * other.area ||
        (steps.size() == MAX_STEPS && !is_nearer(step, steps.back())))
    {
      continue;
    }
    if (steps.size() == MAX_STEPS)
    {
      steps.pop_back();
    }
    steps.insert(std::upper_bound(steps.begin(), steps.end(), step, is_nearer), step);
  }
}

/** Whether there is a neighbour opposite to the one of a step; then the step becomes the mean of both. */
bool hasOpposite(const std::vector<cv::Point2f>& steps, cv::Point2f& step)
{
  constexpr float MAX_DEVIATION = 0.25F;  // of the step
  const auto opposite = std::find_if(steps.begin(), steps.end(), [&](const cv::Point2f& other) {
    return length(other + step) < MAX_DEVIATION * length(step);
  });
  if (opposite == steps.end())
  {
    return false;
  }
  step = 0.5F * (step - *opposite);
  return true;
}

/** The nearest two neighbours in different directions of which one has an opposite at least: those of a square. */
bool findDiagonals(const std::vector<cv::Point2f>& steps, cv::Point2f& first, cv::Point2f& second)
{
  constexpr float MIN_SINE = 0.35F;
  constexpr float MAX_RATIO = 2.5F;
  for (std::size_t a = 0; a < steps.size(); ++a)
  {
    for (std::size_t b = a + 1; b < steps.size() && length(steps[b]) <= MAX_RATIO * length(steps[a]); ++b)
    {
      first = steps[a];
      second = steps[b];
      if (std::abs(cross(first, second)) < MIN_SINE * length(first) * length(second))
      {
        continue;
      }
      const bool first_has = hasOpposite(steps, first);
      if (hasOpposite(steps, second) || first_has)
      {
        return true;
      }
    }
  }
  return false;
}

/** @return whether the square is smaller than its place, all around. */
bool measureSquare(const Frame& frame, const cv::Point2f& center, const cv::Point2f& first, const cv::Point2f& second,
                   Place& place)
{
  constexpr float MAX_WIDTH = 1.2F;  // squares
  const float dark = sampleGrey(frame.grey.front(), center.x, center.y);
  const float threshold = (dark + 255) / 2;
  place.frame = {center, 0.5F * (first + second), 0.5F * (first - second)};
  place.height = squareHeight(place.frame);
  const SquareReach reach = reachOfSquare(frame.grey.front(), center, first, second, threshold, true);
  place.width = reach.side;
  place.shape = reach.shape();
  return reach.corner < 1 && place.width < MAX_WIDTH;
}

std::vector<Place> findPlaces(const Frame& frame, const SearchMap& open)
{
  const std::vector<Island> islands = islandsIn(frame, open);
  std::vector<Place> places;
  std::vector<cv::Point2f> steps;
  for (const Island& island : islands)
  {
    cv::Point2f first;
    cv::Point2f second;
    Place place;
    stepsToNeighbours(island, islands, steps);
    if (findDiagonals(steps, first, second) && measureSquare(frame, island.center, first, second, place))
    {
      places.push_back(place);
    }
  }
  return places;
}

/** Takes the places that the first one reaches from one to the next, out of all. */
std::vector<Place> takeGroup(std::vector<Place>& places)
{
  constexpr float MAX_DISTANCE = 3;  // squares
  constexpr float MAX_RATIO = 1.5F;  // of heights
  std::vector<Place> group = {places.back()};
  places.pop_back();
  for (std::size_t k = 0; k < group.size(); ++k)
  {
    const Place from = group[k];
    const auto reached = std::partition(places.begin(), places.end(), [&](const Place& other) {
      const float least = std::min(from.height, other.height);
      return length(from.frame.node - other.frame.node) >= MAX_DISTANCE * least ||
             std::max(from.height, other.height) >= MAX_RATIO * least;
    });
    group.insert(group.end(), reached, places.end());
    places.erase(reached, places.end());
  }
  return group;
}

template <typename Value>
float medianOf(const std::vector<Place>& group, const Value& value)
{
  std::vector<float> values;
  std::transform(group.begin(), group.end(), std::back_inserter(values), value);
  return median(std::move(values));
}

/** @return whether the group may be squares of a board. */
bool toPart(const Frame& frame, std::vector<Place>& group, ErodedPart& part)
{
  constexpr std::size_t MIN_PLACES = 4;
  constexpr float MIN_SHAPE = 0.73F;
  constexpr float MIN_SEEN = 4;  // px of a square's side; below it the pixels shape it
  if (group.size() < MIN_PLACES || medianOf(group, [](const Place& place) { return place.shape; }) < MIN_SHAPE)
  {
    return false;
  }
  const auto middle = group.begin() + static_cast<std::ptrdiff_t>(group.size() / 2);
  std::nth_element(group.begin(), middle, group.end(),
                   [](const Place& a, const Place& b) { return a.height < b.height; });
  part.u = middle->frame.u;
  part.v = middle->frame.v;
  part.width = medianOf(group, [](const Place& place) { return place.width; });
  cv::Rect box(middle->frame.node, cv::Size(1, 1));
  for (const Place& place : group)
  {
    box |= cv::Rect(place.frame.node, cv::Size(1, 1));
  }
  const int around = cvCeil(SURROUNDINGS * middle->height);
  box = cv::Rect(box.tl() - cv::Point(around, around), box.br() + cv::Point(around, around));
  part.area = box & cv::Rect({}, frame.raw_grey.size());
  return part.width * middle->height >= MIN_SEEN &&
         static_cast<float>(std::max(box.width, box.height)) <= MAX_PART_SIDE * middle->height;
}
}  // namespace

std::vector<ErodedPart> findErodedParts(const Frame& frame, const SearchMap& open)
{
  std::vector<Place> places = findPlaces(frame, open);
  std::vector<std::pair<std::size_t, ErodedPart>> parts;
  while (!places.empty())
  {
    std::vector<Place> group = takeGroup(places);
    ErodedPart part;
    if (toPart(frame, group, part))
    {
      parts.emplace_back(group.size(), part);
    }
  }
  std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  parts.resize(std::min(parts.size(), MAX_PARTS));
  std::vector<ErodedPart> result;
  std::transform(parts.begin(), parts.end(), std::back_inserter(result), [](const auto& part) { return part.second; });
  return result;
}

}  // namespace omr
