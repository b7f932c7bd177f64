#include "lattice_extent.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "border.h"
#include "checkerboards/corners/corner_ring.h"
#include "lattice_model.h"
#include "lattice_prediction.h"

namespace omr
{
namespace
{
constexpr int WINDOW = 3;  // nodes, of a prediction beside the lattice

/** Whether a corner of the outermost line is clear, and where the others say. @param frame receives what they say */
bool isClear(const Lattice& lattice, int row, int col, LocalFrame& frame)
{
  constexpr float MIN_CORRELATION = 0.93F;
  constexpr float MAX_DEVIATION = 0.1F;    // squares
  constexpr float DEVIATION_NOISE = 0.4F;  // px
  const LatticeNode& node = lattice.at(row, col);
  return node.found && node.correlation >= MIN_CORRELATION && predictNode(lattice, row, col, WINDOW, frame) &&
         squaresBetween(frame, node.position) <= MAX_DEVIATION + DEVIATION_NOISE / squareHeight(frame);
}

/** Whether it lies between four squares whose centres alternate. */
bool isBetweenSquares(const Lattice& lattice, const Frame& image, int row, int col, LocalFrame frame)
{
  constexpr float MIN_CONTRAST_SHARE = 0.3F;
  const LatticeNode& node = lattice.at(row, col);
  const PyramidView view(image, squareHeight(frame));
  frame.node = node.position;
  const float gap = quadrantGap(sampleQuadrants(view, frame, 0.5F), lattice.sign(row, col));
  return gap >= MIN_CONTRAST_SHARE * node.contrast;
}

/** What speaks for the outermost line of a side. */
struct LineSupport
{
  float share = 0;  // of the line's nodes that are found
  bool enough = false;
};

LineSupport lineSupport(const Lattice& lattice, CornerLooker& looker, Side side)
{
  constexpr float MIN_SHARE = 0.34F;
  const int line = lineIndex(lattice, side, 0);
  const int start = lineStart(lattice, side);
  const int end = start + lineLength(lattice, side);
  int found = 0;
  int convincing = 0;
  int anchored = 0;  // convincing, squares checked, beside another corner
  for (int t = start; t < end; ++t)
  {
    const Node node = nodeOnLine(side, line, t);
    if (!lattice.found(node.row, node.col))
    {
      continue;
    }
    ++found;
    LocalFrame frame;
    if (isClear(lattice, node.row, node.col, frame))
    {
      ++convincing;
      const Node inner = nodeOnLine(side, line + inwards(side), t);
      const Node before = nodeOnLine(side, line, t - 1);
      const Node after = nodeOnLine(side, line, t + 1);
      const bool beside = lattice.found(inner.row, inner.col) || lattice.found(before.row, before.col) ||
                          lattice.found(after.row, after.col);
      anchored += beside && isBetweenSquares(lattice, looker.frame(), node.row, node.col, frame) ? 1 : 0;
    }
  }
  LineSupport support;
  support.share = static_cast<float>(found) / static_cast<float>(end - start);
  support.enough = anchored >= 1 || (found >= 2 && support.share >= MIN_SHARE && convincing >= 1);
  // One corner beyond a whole line is rather the background's beside a narrow margin. Of 969 photographs of boards that
  // were scaled, turned, darkened, blurred: found 739 -> 746, wrong 8 -> 3.
  const bool beyond_whole = countOnLine(lattice, side, line + inwards(side)) == end - start;
  support.enough = support.enough && (found > 1 || !beyond_whole);
  // The border beyond speaks for a line that lies alone behind a gap, where no prediction is sharp.
  support.enough = support.enough || (found > 0 && lookAtBorder(lattice, looker.frame(), side, 1).ends());
  // A line where the board ends, rather than goes on, has more outer corners than inner ones.
  const BorderLine border = lookAtBorder(lattice, looker.frame(), side, 0);
  support.enough = support.enough && border.seen <= found + border.goes_on;
  return support;
}

/** Drops outermost lines, the least supported first. */
void trim(Lattice& lattice, CornerLooker& looker)
{
  while (lattice.box.width > 1 && lattice.box.height > 1)
  {
    bool drop = false;
    Side worst = top;
    float worst_share = 2;
    for (const Side side : SIDES)
    {
      const LineSupport support = lineSupport(lattice, looker, side);
      if (!support.enough && support.share < worst_share)
      {
        drop = true;
        worst = side;
        worst_share = support.share;
      }
    }
    if (!drop)
    {
      return;
    }
    dropLine(lattice, worst);
  }
}

SideEvidence sideEvidence(const Lattice& lattice, const Frame& frame, Side side, const BorderLine& border)
{
  constexpr int MIN_BORDER = 2;  // signs of it, as the two outer corners of a rim square; clutter gave one at most
  // Of the last line of inner corners; the more must be there, the less is seen of the border.
  constexpr float MIN_LINE_SHARE = 0.5F;
  constexpr float MIN_LINE_SHARE_ALONE = 0.8F;
  const auto found = static_cast<float>(countOnLine(lattice, side, lineIndex(lattice, side, 0)));
  const float share = found / static_cast<float>(lineLength(lattice, side));
  if (border.ends())
  {
    // Beside a complete line of corners one corner of a target or of the next board looks like a rim that goes on: 20
    // of 1409 boards. Two are the rim beyond a label: of 93 boards with one drawn on them 19 were certain and wrong.
    const int least = share < 1 ? 1 : 2;
    return rimBeyond(lattice, frame, side) >= least ? SideEvidence::doubtful_border : SideEvidence::border;
  }
  if (border.endsBare())
  {
    return SideEvidence::bare;
  }
  if (border.outside > border.places)
  {
    return SideEvidence::cut;
  }
  const int seen = border.seen + border.edges;
  const bool is_last =
      border.seen + border.margins >= MIN_BORDER || share >= (seen > 0 ? MIN_LINE_SHARE : MIN_LINE_SHARE_ALONE);
  // A corner alone may be chance, and what is plain beside it no margin: of 1354
  // boards on transformed photographs 1 wrong -> 0.
  const bool is_shown = found + static_cast<float>(border.seen) > 1;
  return is_last && is_shown && border.goes_on <= MAX_GOING_ON ? SideEvidence::rim : SideEvidence::none;
}

/** The corners that are far from where the model has them. */
std::vector<Node> outliersOf(const Lattice& lattice, const LatticeModel& model)
{
  constexpr double MIN_RESIDUAL = 0.8;         // px
  constexpr double MIN_RESIDUAL_SHARE = 0.05;  // squares
  constexpr double MAX_MEDIANS = 5;
  std::vector<Node> outliers;
  const cv::Rect box = lattice.box;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      if (lattice.found(i, j))
      {
        const double limit = std::max({MIN_RESIDUAL, MIN_RESIDUAL_SHARE * squareHeight(model.frameAt(i, j)),
                                       MAX_MEDIANS * std::max(0.05, model.median())});
        if (length(model.at(i, j) - lattice.at(i, j).position) > limit)
        {
          outliers.push_back({i, j});
        }
      }
    }
  }
  return outliers;
}

}  // namespace

void dropOutliers(Lattice& lattice)
{
  constexpr int MIN_CORNERS = 12;
  constexpr int MIN_CUBIC_CORNERS = 20;  // twice its terms
  constexpr int MIN_SMOOTH_CORNERS = 30;
  constexpr double RIDGE = 0.1;
  const int count = lattice.count();
  LatticeModel model;
  if (count < MIN_CORNERS || lattice.box.width < 3 || lattice.box.height < 3 ||
      !model.fit(lattice, count >= MIN_SMOOTH_CORNERS ? LatticeModel::cubic : LatticeModel::quadratic, RIDGE))
  {
    return;
  }
  std::vector<Node> outliers = outliersOf(lattice, model);
  // Where a third does not fit, it is the model that is wrong.
  if (outliers.empty() || static_cast<int>(outliers.size()) * 3 > count)
  {
    return;
  }
  // So it is where a finer one leaves half of them: a fisheye bends more than a curved plate.
  const bool finer = count >= MIN_SMOOTH_CORNERS
                         ? model.fitSmooth(lattice, RIDGE)
                         : count >= MIN_CUBIC_CORNERS && model.fit(lattice, LatticeModel::cubic, RIDGE);
  if (finer)
  {
    const std::vector<Node> left = outliersOf(lattice, model);
    outliers = 2 * left.size() <= outliers.size() ? left : outliers;
  }
  for (const Node& node : outliers)
  {
    lattice.remove(node.row, node.col);
  }
}

std::array<SideEvidence, 4> settleExtent(Lattice& lattice, CornerLooker& looker)
{
  constexpr int MAX_HIDDEN_LINES = 3;
  trim(lattice, looker);
  std::array<int, 4> hidden_lines = {};
  for (const Side side : SIDES)
  {
    for (int hidden = 0; hidden <= MAX_HIDDEN_LINES; ++hidden)
    {
      if (lookAtBorder(lattice, looker.frame(), side, 1 + hidden).ends())
      {
        addLines(lattice, side, hidden);
        hidden_lines[side] = hidden;
        break;
      }
    }
  }
  // Lines added on one side make the others longer, so these are looked at once all are there.
  std::array<SideEvidence, 4> evidence;
  for (const Side side : SIDES)
  {
    const BorderLine border =
        lookAtLine(lattice, looker.frame(), side, lineIndex(lattice, side, 1), BORDER_WINDOW + 1 + hidden_lines[side]);
    evidence[side] = sideEvidence(lattice, looker.frame(), side, border);
  }
  return evidence;
}

}  // namespace omr
