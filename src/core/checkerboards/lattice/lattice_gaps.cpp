#include "lattice_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "border.h"
#include "lattice_evidence.h"
#include "lattice_growth.h"
#include "lattice_model.h"
#include "lattice_prediction.h"
#include "lattice_side.h"

namespace omr
{
namespace
{
constexpr int REACH = 3;      // squares; with 4 the jump reaches the next board
constexpr int FAR_REACH = 5;  // where the surface says to a tenth of a square where clear corners would lie

/** One way to look across a gap. */
struct Attempt
{
  LatticeModel::Terms terms;
  float tolerance;  // squares
  int reach;        // squares
  float correlation;
};

// Where one attempt finds nothing the next is made: corners pulled by what hides their neighbours mislead the plain fit
// over three squares, a robust one loses boards of few corners.
constexpr std::array<Attempt, 4> ATTEMPTS = {{{LatticeModel::homography, 0.2F, REACH, 0.9F},
                                              {LatticeModel::robust_homography, 0.2F, REACH, 0.9F},
                                              {LatticeModel::homography, 0.3F, REACH, 0.9F},
                                              {LatticeModel::homography, 0.1F, FAR_REACH, 0.95F}}};

struct Find
{
  int row, col;
  CornerLook corner;
};

/** Looks for a corner that no found corner need be beside of: more is asked of it. */
bool lookAcrossGap(const Lattice& lattice, CornerLooker& looker, const std::optional<LatticeModel>& surface,
                   const Attempt& attempt, float contrast, Find& find)
{
  constexpr float MIN_CONTRAST_SHARE = 0.4F;
  LocalFrame predicted;
  if (surface)
  {
    predicted = surface->frameAt(find.row, find.col);
  }
  else if (!predictNode(lattice, find.row, find.col, REACH + 2, predicted))
  {
    return false;
  }
  if (cross(predicted.u, predicted.v) * cross(lattice.seedFrame().u, lattice.seedFrame().v) <= 0)
  {
    return false;
  }
  CornerQuery query;
  query.sign = lattice.sign(find.row, find.col);
  query.tolerance = attempt.tolerance;
  query.contrast = contrast;
  query.correlation = attempt.correlation;
  find.corner = looker.look(predicted, query);
  if (!find.corner.found || find.corner.contrast < MIN_CONTRAST_SHARE * contrast)
  {
    return false;
  }
  const float least = 0.6F * squareHeight(predicted);
  for (int i = find.row - 2; i <= find.row + 2; ++i)
  {
    for (int j = find.col - 2; j <= find.col + 2; ++j)
    {
      if (lattice.found(i, j) && length(lattice.at(i, j).position - find.corner.position) < least)
      {
        return false;
      }
    }
  }
  return true;
}

bool isWithinReach(const Lattice& lattice, int row, int col, int reach)
{
  for (int i = std::max(0, row - reach); i <= std::min(Lattice::SIZE - 1, row + reach); ++i)
  {
    for (int j = std::max(0, col - reach); j <= std::min(Lattice::SIZE - 1, col + reach); ++j)
    {
      if (lattice.found(i, j))
      {
        return true;
      }
    }
  }
  return false;
}

/** What is seen beside the lattice, by Side. */
std::array<BorderLine, 4> bordersOf(const Lattice& lattice, const Frame& frame)
{
  std::array<BorderLine, 4> borders;
  for (const Side side : SIDES)
  {
    borders[side] = lookAtBorder(lattice, frame, side, 1);
  }
  return borders;
}

/** Whether a margin is seen on any side. Where none is, squares that end at plain ground are the border of a board
 * without one; else a thing that lies on the board may have its edge there. Of 216 boards drawn in pairs 0.8 to 3
 * squares apart, without a margin or with a narrow one, 24 -> 182 are found, wrong 89 -> 16. */
bool hasMargin(const std::array<BorderLine, 4>& borders)
{
  return std::any_of(borders.begin(), borders.end(), [](const BorderLine& border) { return border.ends(); });
}
/** How far a jump may go beyond each side, by Side: not across a border. */
std::array<int, 4> reachBeyond(const Lattice& lattice, const Frame& frame, int reach)
{
  const std::array<BorderLine, 4> borders = bordersOf(lattice, frame);
  const bool has_margin = hasMargin(borders);
  std::array<int, 4> beyond = {};
  for (const Side side : SIDES)
  {
    const bool ends = borders[side].ends() || (borders[side].endsBare() && !has_margin);
    beyond[side] = ends ? 0 : reach;
  }
  return beyond;
}

bool isWhole(const Lattice& lattice, const std::array<int, 4>& reach)
{
  return lattice.count() == lattice.box.area() &&
         std::all_of(reach.begin(), reach.end(), [](int squares) { return squares == 0; });
}

/** The lattice's surface, where one homography says where the next square is. */
std::optional<LatticeModel> surfaceOf(const Lattice& lattice, LatticeModel::Terms terms)
{
  constexpr double MAX_RESIDUAL = 0.06;  // squares
  LatticeModel model;
  if (!model.fit(lattice, terms, 0))
  {
    return std::nullopt;
  }
  const cv::Rect& box = lattice.box;
  const LocalFrame middle = model.frameAt(box.y + (box.height - 1) / 2., box.x + (box.width - 1) / 2.);
  return model.rms() < MAX_RESIDUAL * squareHeight(middle) ? std::make_optional(model) : std::nullopt;
}

std::vector<Find> lookAcrossGaps(const Lattice& lattice, CornerLooker& looker,
                                 const std::optional<LatticeModel>& surface, const Attempt& attempt,
                                 const std::array<int, 4>& reach)
{
  const cv::Rect& box = lattice.box;
  const float contrast = lattice.medianContrast();
  std::vector<Find> finds;
  for (int i = box.y - reach[top]; i < box.br().y + reach[bottom]; ++i)
  {
    for (int j = box.x - reach[left]; j < box.br().x + reach[right]; ++j)
    {
      Find find{i, j, {}};
      if (Lattice::admits(i, j) && !lattice.found(i, j) && isWithinReach(lattice, i, j, attempt.reach) &&
          lookAcrossGap(lattice, looker, surface, attempt, contrast, find))
      {
        finds.push_back(find);
      }
    }
  }
  return finds;
}

/** One find alone may be chance: another or a corner must be beside it. */
void removeLone(const Lattice& lattice, std::vector<Find>& finds)
{
  const auto is_alone = [&](const Find& find) {
    return !isWithinReach(lattice, find.row, find.col, 1) &&
           std::none_of(finds.begin(), finds.end(), [&](const Find& other) {
             return std::max(std::abs(other.row - find.row), std::abs(other.col - find.col)) == 1;
           });
  };
  finds.erase(std::remove_if(finds.begin(), finds.end(), is_alone), finds.end());
}
}  // namespace

void jumpGaps(Lattice& lattice, CornerLooker& looker)
{
  constexpr int MAX_ROUNDS = 9;
  constexpr int MIN_CORNERS = 6;
  constexpr float MIN_FAR_CORRELATION = 0.99F;  // of the lattice; below fences a far jump meets the next board
  std::size_t next = 0;
  for (int round = 0; round < MAX_ROUNDS && lattice.count() >= MIN_CORNERS && next < ATTEMPTS.size(); ++round)
  {
    const Attempt& attempt = ATTEMPTS[next];
    const std::array<int, 4> reach = reachBeyond(lattice, looker.frame(), attempt.reach);
    if (isWhole(lattice, reach))
    {
      return;
    }
    const std::optional<LatticeModel> surface = surfaceOf(lattice, attempt.terms);
    if (attempt.reach > REACH && !(surface && latticeEvidence(lattice).correlation >= MIN_FAR_CORRELATION))
    {
      return;
    }
    std::vector<Find> finds = lookAcrossGaps(lattice, looker, surface, attempt, reach);
    removeLone(lattice, finds);
    if (finds.empty())
    {
      ++next;
      continue;
    }
    for (const Find& find : finds)
    {
      lattice.put(find.row, find.col, find.corner);
    }
    growLattice(lattice, looker, Lattice::SIZE * Lattice::SIZE);
    next = 0;
  }
}

void splitAtBorders(Lattice& lattice, const Frame& frame)
{
  const bool has_margin = hasMargin(bordersOf(lattice, frame));
  for (const Side side : SIDES)
  {
    // From the middle outwards: a line without inner corners that has a border's outer ones on the inner side.
    const int last = lineIndex(lattice, side, 0);
    for (int line = Lattice::SEED; (last - line) * inwards(side) < 0; line -= inwards(side))
    {
      const BorderLine border = lookAtLine(lattice, frame, side, line, BORDER_WINDOW + 1);
      // The next board begins a line further out at least: both lines are without inner corners.
      const int inner_corners =
          std::max(countOnLine(lattice, side, line), countOnLine(lattice, side, line - inwards(side)));
      const int seen = has_margin ? border.seen : std::max(border.seen, border.bare);
      if (3 * inner_corners > seen)
      {
        continue;
      }
      if (seen >= 0.7 * border.places || (border.mayEnd() && inner_corners == 0))
      {
        while (lineIndex(lattice, side, 0) != line + inwards(side))
        {
          dropLine(lattice, side);
        }
        break;
      }
    }
  }
}

}  // namespace omr
