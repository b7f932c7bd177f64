#include "lattice_seam.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "lattice_model.h"
#include "lattice_side.h"
#include "least_squares.h"
#include "median.h"

namespace omr
{
namespace
{
constexpr int MIN_LINES = 4;  // of inner corners; the smallest board has 5 x 7 squares
constexpr int MAX_LINES = 6;  // on each side of a seam that are looked at: within them a surface's bend is cubic

/** How corners beside one plane change from a line to another [squares]; none where too few tell. */
using Change = std::optional<cv::Point2d>;

/** How corners lie beside one plane. */
class Offsets
{
 public:
  explicit Offsets(const Lattice& lattice) : lattice_(lattice), offsets_(lattice.box.area())
  {
    LatticeModel model;
    fits_ = model.fit(lattice, LatticeModel::homography, 0);
    const cv::Rect& box = lattice.box;
    for (int i = box.y; fits_ && i < box.br().y; ++i)
    {
      for (int j = box.x; j < box.br().x; ++j)
      {
        const LocalFrame frame = model.frameAt(i, j);
        const cv::Point2f offset = lattice.at(i, j).position - frame.node;
        offsets_[(i - box.y) * box.width + j - box.x] =
            cv::Point2f(cross(offset, frame.v), cross(frame.u, offset)) / cross(frame.u, frame.v);
      }
    }
  }

  bool fits() const
  {
    return fits_;
  }

  /** The median over the corners of both lines. */
  Change change(Side side, int from, int to) const
  {
    constexpr std::size_t MIN_PAIRS = 3;
    const std::vector<cv::Point2d> pairs = differences(side, from, to);
    if (pairs.size() < MIN_PAIRS)
    {
      return std::nullopt;
    }
    const auto median_of = [&](double cv::Point2d::*coordinate) {
      std::vector<double> values(pairs.size());
      std::transform(pairs.begin(), pairs.end(), values.begin(), [&](const auto& pair) { return pair.*coordinate; });
      return median(std::move(values));
    };
    return cv::Point2d(median_of(&cv::Point2d::x), median_of(&cv::Point2d::y));
  }

  /** Median distance of the corners' changes from the one of their lines [squares]. */
  double spread(Side side, int from, int to, const cv::Point2d& change) const
  {
    const std::vector<cv::Point2d> pairs = differences(side, from, to);
    std::vector<double> distances(pairs.size());
    std::transform(pairs.begin(), pairs.end(), distances.begin(),
                   [&](const cv::Point2d& pair) { return cv::norm(pair - change); });
    return median(std::move(distances));
  }

  /** From each line to the next. */
  std::vector<Change> changes(Side side, int first, int last) const
  {
    std::vector<Change> result;
    for (int line = first; line < last; ++line)
    {
      result.push_back(change(side, line, line + 1));
    }
    return result;
  }

 private:
  /** Between the corners of two lines, where both are found. */
  std::vector<cv::Point2d> differences(Side side, int from, int to) const
  {
    std::vector<cv::Point2d> result;
    const int start = lineStart(lattice_, side);
    for (int t = start; t < start + lineLength(lattice_, side); ++t)
    {
      const Node a = nodeOnLine(side, from, t);
      const Node b = nodeOnLine(side, to, t);
      if (lattice_.found(a.row, a.col) && lattice_.found(b.row, b.col))
      {
        result.emplace_back(at(b) - at(a));
      }
    }
    return result;
  }

  cv::Point2f at(const Node& node) const
  {
    return offsets_[(node.row - lattice_.box.y) * lattice_.box.width + node.col - lattice_.box.x];
  }

  const Lattice& lattice_;
  std::vector<cv::Point2f> offsets_;  // of the box, row by row [squares]
  bool fits_ = false;
};

/** The steps between the lines on both sides of a seam, as far as one smooth curve describes them. */
class Steps
{
 public:
  /** @param changes from each line of the lattice to the next. @param seam index of its line. */
  Steps(const std::vector<Change>& changes, int seam)
  {
    PointFit<TERMS> fit;
    const int end = std::min(static_cast<int>(changes.size()), seam + MAX_LINES);
    for (int line = std::max(0, seam - MAX_LINES); line < end; ++line)
    {
      if (line != seam && line + 1 != seam && changes[line])
      {
        const Step step = {(line + 0.5 - seam) / MAX_LINES, *changes[line]};
        fit.add({1, step.place, step.place * step.place}, step.change, 1);
        steps_.push_back(step);
        (line < seam ? before_ : behind_) += 1;
      }
    }
    fits_ = std::min(before_, behind_) >= MIN_LINES - 1 && fit.solve(TERMS, terms_);
  }

  bool fits() const
  {
    return fits_;
  }

  /** Both steps at the seam together. */
  cv::Point2d acrossSeam() const
  {
    return 2 * (terms_[0] + terms_[2] * (1. / (3 * MAX_LINES * MAX_LINES)));  // the mean of the squared place
  }

  /** RMS of what the curve leaves of the steps [squares]. */
  double noise() const
  {
    double sum = 0;
    for (const Step& step : steps_)
    {
      const cv::Point2d rest = step.change - terms_[0] - step.place * terms_[1] - step.place * step.place * terms_[2];
      sum += rest.dot(rest);
    }
    return std::sqrt(sum / static_cast<double>(steps_.size() - TERMS + 1));
  }

 private:
  static constexpr int TERMS = 3;
  struct Step
  {
    double place = 0;
    cv::Point2d change;
  };

  std::vector<Step> steps_;
  cv::Point2d terms_[TERMS];
  int before_ = 0;
  int behind_ = 0;
  bool fits_ = false;
};

std::optional<Seam> findSeam(const Lattice& lattice)
{
  // Of 215 boards whose lattices are long enough, drawn, rendered and photographed, none of those over 0.05 squares has
  // more than 7.5 noises; of 159 pairs 0.04 to 0.45 squares apart that were joined none has less than 0.057 and 14.
  constexpr double MIN_JUMP = 0.05;  // squares
  constexpr double MIN_NOISES = 8;
  // Corners that a stripe of gloss pulls do not agree on the jump: their spread is 0.13 to 1.5 of it, that of the
  // corners at 2753 seams of joined boards 0.11 at most.
  constexpr double MAX_SPREAD = 0.25;  // of the jump
  if (std::max(lattice.box.width, lattice.box.height) < 2 * MIN_LINES + 1)
  {
    return {};
  }
  const Offsets offsets(lattice);
  if (!offsets.fits())
  {
    return {};
  }
  std::optional<Seam> seam;
  double largest = MIN_JUMP;
  for (const Side side : {top, left})
  {
    const int first = lineIndex(lattice, side, 0);
    const int last = lineIndex(lattice, side == top ? bottom : right, 0);
    const std::vector<Change> changes = offsets.changes(side, first, last);
    for (int line = first + MIN_LINES; line <= last - MIN_LINES; ++line)
    {
      const Steps steps(changes, line - first);
      const Change change = steps.fits() ? offsets.change(side, line - 1, line + 1) : std::nullopt;
      if (!change)
      {
        continue;
      }
      // By how much the distance of the two lines beside the seam is not that of two squares [squares].
      const double jump = cv::norm(*change - steps.acrossSeam());
      if (jump > std::max(largest, MIN_NOISES * steps.noise()) &&
          offsets.spread(side, line - 1, line + 1, *change) <= MAX_SPREAD * jump)
      {
        largest = jump;
        const Side opposite = side == top ? bottom : right;
        const bool seed_is_before = line > Lattice::SEED || (line == Lattice::SEED && 2 * line > first + last);
        seam = {seed_is_before ? opposite : side, line};
      }
    }
  }
  return seam;
}
}  // namespace

bool hasSeam(const Lattice& lattice)
{
  return findSeam(lattice).has_value();
}

void dropBeyond(Lattice& lattice, const Seam& seam)
{
  while (lineIndex(lattice, seam.beyond, 0) != seam.line + inwards(seam.beyond))
  {
    dropLine(lattice, seam.beyond);
  }
}

std::vector<Seam> splitAtSeams(Lattice& lattice)
{
  std::vector<Seam> seams;
  for (std::optional<Seam> seam = findSeam(lattice); seam; seam = findSeam(lattice))
  {
    dropBeyond(lattice, *seam);
    seams.push_back(*seam);
  }
  return seams;
}

}  // namespace omr
