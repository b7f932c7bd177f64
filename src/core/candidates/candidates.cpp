#include "outdoor_omr/candidates.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "marker_box.h"
#include "outdoor_omr/haar_features.h"

namespace omr
{
namespace
{
/** Larger scores count as this one: their odds are a matter of a few windows in training. */
constexpr float LARGEST_SCORE = .999F;

/** Boxes that share more than this of the smaller one are one candidate. */
constexpr double SAME = .5;

/** Share of a candidate's box that a marker must cover, or of the marker that the box must cover, for it to be read. */
constexpr double READ = .4;

/** A candidate with what decides between rivals. */
struct Cluster
{
  Candidate candidate;
  double support = 0;  // sum of its windows' scores above -1, and of those merged into it
};

/** Windows this far apart belong together: two that are missed between them do not part them. */
constexpr int REACH = 3;

/** Windows of one level, in sets of neighbours. */
class NeighbourSets
{
 public:
  explicit NeighbourSets(const cv::Size& grid) : number_(grid, -1)
  {
  }

  /** Row by row. */
  void add(const cv::Point& index)
  {
    int own = static_cast<int>(parents_.size());
    parents_.push_back(own);
    number_(index) = own;
    for (int y = std::max(0, index.y - REACH); y <= index.y; ++y)
    {
      for (int x = std::max(0, index.x - REACH); x <= std::min(number_.cols - 1, index.x + REACH); ++x)
      {
        if (number_(y, x) >= 0)
        {
          const int other = firstOf(number_(y, x));
          const int first = std::min(own, other);
          parents_[std::max(own, other)] = first;
          own = first;
        }
      }
    }
  }

  /** The first window of the set of a window, in the order in which they were added. */
  int firstOf(int window) const
  {
    while (parents_[window] != window)
    {
      window = parents_[window];
    }
    return window;
  }

 private:
  cv::Mat_<int> number_;  ///< of the windows that were added

  std::vector<int> parents_;
};

/** Neighbouring windows of one level above the threshold of a kind. @param windows above it, row by row. */
void addClusters(const std::vector<cv::Point>& windows, const MarkerScores* scores, const cv::Size& grid, int level,
                 MarkerKind kind, std::vector<Cluster>& clusters)
{
  if (windows.empty())
  {
    return;
  }
  NeighbourSets sets(grid);
  for (const cv::Point& index : windows)
  {
    sets.add(index);
  }
  std::vector<Cluster> found(windows.size());
  for (std::size_t i = 0; i < windows.size(); ++i)
  {
    const float score = scores[windows[i].y * grid.width + windows[i].x][static_cast<int>(kind)];
    Cluster& cluster = found[sets.firstOf(static_cast<int>(i))];
    cluster.candidate.box |= windowRect(windows[i], level);
    cluster.candidate.score = std::max(cluster.candidate.score, score);
    cluster.support += score + 1;
    cluster.candidate.windows += 1;
  }
  for (Cluster& cluster : found)
  {
    if (cluster.candidate.windows > 0)
    {
      cluster.candidate.kind = kind;
      cluster.candidate.cell = cellSize(level);
      clusters.push_back(cluster);
    }
  }
}

void sortBySupport(std::vector<Cluster>& clusters)
{
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const Cluster& a, const Cluster& b) { return a.support > b.support; });
}

/**
 * Of two clusters in one place the better supported one stays; the box covers both if they are of one kind.
 *
 * @return best supported first.
 */
std::vector<Cluster> merge(std::vector<Cluster> clusters)
{
  sortBySupport(clusters);
  std::vector<Cluster> merged;
  for (const Cluster& cluster : clusters)
  {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const Cluster& other) {
      const double shared = (other.candidate.box & cluster.candidate.box).area();
      return shared > SAME * std::min(other.candidate.box.area(), cluster.candidate.box.area());
    });
    if (same == merged.end())
    {
      merged.push_back(cluster);
    }
    else if (same->candidate.kind == cluster.candidate.kind)
    {
      same->candidate.box |= cluster.candidate.box;
      same->candidate.score = std::max(same->candidate.score, cluster.candidate.score);
      same->candidate.windows += cluster.candidate.windows;
      same->support += cluster.support;
    }
  }
  sortBySupport(merged);
  return merged;
}

/** A marker's box covers the candidate, or the other way round. */
bool shows(const Candidate& candidate, const cv::Rect& marker)
{
  const double shared = (candidate.box & marker).area();
  return shared > READ * std::min(candidate.box.area(), marker.area());
}

/** Marks what shows a marker; the first of it covers the marker then, or else a candidate of its own does. */
void markRead(const cv::Rect& marker, MarkerKind kind, std::vector<Candidate>& candidates)
{
  bool covered = false;
  for (Candidate& candidate : candidates)
  {
    if (shows(candidate, marker))
    {
      candidate.read = true;
      candidate.box |= covered ? cv::Rect() : marker;
      covered = true;
    }
  }
  if (!covered)
  {
    Candidate own;
    own.box = marker;
    own.kind = kind;
    own.read = true;
    candidates.push_back(own);
  }
}
}  // namespace

std::array<float, BOX_FEATURES> boxFeatures(const Candidate& candidate)
{
  const auto places = [&](int pixels) { return (pixels / candidate.cell - WINDOW_CELLS) / WINDOW_STRIDE + 1; };
  const auto windows = static_cast<float>(candidate.windows);
  const float share = windows / static_cast<float>(places(candidate.box.width) * places(candidate.box.height));
  return {std::atanh(std::clamp(candidate.score, -LARGEST_SCORE, LARGEST_SCORE)), std::log2(windows), std::log2(share)};
}

float evidenceOf(const std::array<float, BOX_FEATURES>& features, const BoxEvidence& model)
{
  return std::inner_product(features.begin(), features.end(), model.weights.begin() + 1, model.weights[0]);
}

std::vector<Candidate> findCandidates(const cv::Size& size, const std::vector<MarkerScores>& scores,
                                      const MarkerNetwork& network)
{
  std::vector<Cluster> clusters;
  const MarkerScores* first = scores.data();
  for (int level = 0; level < HAAR_LEVELS; ++level)
  {
    const cv::Size grid = windowGrid(size, level);
    if (grid.empty())
    {
      break;
    }
    std::array<std::vector<cv::Point>, MARKER_KINDS> above;
    for (int i = 0; i < grid.area(); ++i)
    {
      if (network.passes(first[i]))
      {
        for (int k = 0; k < MARKER_KINDS; ++k)
        {
          if (first[i][k] > network.thresholds[k])
          {
            above[k].emplace_back(i % grid.width, i / grid.width);
          }
        }
      }
    }
    for (const MarkerKind kind : {MarkerKind::checkerboard, MarkerKind::target})
    {
      addClusters(above[static_cast<int>(kind)], first, grid, level, kind, clusters);
    }
    first += grid.area();
  }
  clusters = merge(merge(std::move(clusters)));  // a box that grew may have reached another one
  std::vector<Candidate> candidates;
  candidates.reserve(clusters.size());
  for (const Cluster& cluster : clusters)
  {
    candidates.push_back(cluster.candidate);
    const BoxEvidence& model = network.boxes[static_cast<int>(cluster.candidate.kind)];
    candidates.back().evidence = evidenceOf(boxFeatures(cluster.candidate), model);
  }
  return candidates;
}

void removeDoubtful(const MarkerNetwork& network, float BoxEvidence::*least, std::vector<Candidate>& candidates)
{
  const auto doubtful = [&](const Candidate& candidate) {
    return !candidate.read && candidate.evidence < network.boxes[static_cast<int>(candidate.kind)].*least;
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), doubtful), candidates.end());
}

void markRead(const cv::Size& size, const std::vector<Checkerboard>& checkerboards, const std::vector<Target>& targets,
              std::vector<Candidate>& candidates)
{
  const cv::Rect image({}, size);  // what is cut by it has corners, or half a ring, outside
  for (const Checkerboard& board : checkerboards)
  {
    markRead(boxOf(board) & image, MarkerKind::checkerboard, candidates);
  }
  for (const Target& target : targets)
  {
    markRead(boxOf(target) & image, MarkerKind::target, candidates);
  }
}

}  // namespace omr
