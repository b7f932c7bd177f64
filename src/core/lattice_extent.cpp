#include "outdoor_omr/lattice_extent.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "outdoor_omr/lattice_model.h"

namespace outdoor_omr
{
namespace
{
constexpr int WINDOW = 3;  // nodes, of a prediction beside the lattice
constexpr int REACH = 3;   // squares; with 4 the jump reaches the next board

struct Node
{
  int row, col;
};

bool isRow(Side side)
{
  return side == top || side == bottom;
}

/** Index of the line that lies `distance` outside the outermost line of nodes. */
int lineIndex(const Lattice& lattice, Side side, int distance)
{
  switch (side)
  {
    case top:
      return lattice.box.y - distance;
    case bottom:
      return lattice.box.br().y - 1 + distance;
    case left:
      return lattice.box.x - distance;
    default:
      return lattice.box.br().x - 1 + distance;
  }
}

/** First node and number of nodes along the side. */
int lineStart(const Lattice& lattice, Side side)
{
  return isRow(side) ? lattice.box.x : lattice.box.y;
}

int lineLength(const Lattice& lattice, Side side)
{
  return isRow(side) ? lattice.box.width : lattice.box.height;
}

Node nodeOnLine(Side side, int line, int along)
{
  return isRow(side) ? Node{line, along} : Node{along, line};
}

/** +1 or -1: the direction from the side's border into the board. */
int inwards(Side side)
{
  return side == top || side == left ? 1 : -1;
}

bool isInPicture(const cv::Mat& image, const cv::Point2f& point, float margin)
{
  return point.x >= margin && point.y >= margin && point.x < image.cols - 1 - margin &&
         point.y < image.rows - 1 - margin;
}

int countOnLine(const Lattice& lattice, Side side, int line)
{
  const int start = lineStart(lattice, side);
  int found = 0;
  for (int t = start; t < start + lineLength(lattice, side); ++t)
  {
    const Node node = nodeOnLine(side, line, t);
    found += lattice.found(node.row, node.col) ? 1 : 0;
  }
  return found;
}

/** Whether a corner of the outermost line would convince by itself: clear, where the others say, between four squares
 * whose centres alternate. */
bool convinces(const Lattice& lattice, const CornerLooker& looker, int row, int col, bool check_squares)
{
  constexpr float MIN_CORRELATION = 0.93F;
  constexpr float MAX_DEVIATION = 0.1F;    // squares
  constexpr float DEVIATION_NOISE = 0.4F;  // px
  constexpr float MIN_CONTRAST_SHARE = 0.3F;
  const LatticeNode& node = lattice.at(row, col);
  LocalFrame frame;
  if (!node.found || node.correlation < MIN_CORRELATION || !predictNode(lattice, row, col, WINDOW, frame))
  {
    return false;
  }
  const float height = squareHeight(frame);
  if (squaresBetween(frame, node.position) > MAX_DEVIATION + DEVIATION_NOISE / height)
  {
    return false;
  }
  if (!check_squares)
  {
    return true;
  }
  frame.node = node.position;
  const PyramidView view(looker.frame(), height);
  const float first = view.sample(frame.at(0.5F, 0.5F));
  const float second = view.sample(frame.at(-0.5F, 0.5F));
  const float third = view.sample(frame.at(-0.5F, -0.5F));
  const float fourth = view.sample(frame.at(0.5F, -0.5F));
  const float gap = lattice.sign(row, col) > 0 ? std::min(first, third) - std::max(second, fourth)
                                               : std::min(second, fourth) - std::max(first, third);
  return gap >= MIN_CONTRAST_SHARE * node.contrast;
}

/** @param window of the predictions [nodes]. */
BorderLine lookAtLine(const Lattice& lattice, CornerLooker& looker, Side side, int line, int window)
{
  BorderLine result;
  const int start = lineStart(lattice, side);
  const int end = start + lineLength(lattice, side);
  const float contrast = lattice.medianContrast();
  for (int t = start - 1; t <= end; ++t)
  {
    const Node node = nodeOnLine(side, line, t);
    // The dark square inside the border is the one towards u and v with u * v = -sign.
    const int in = inwards(side);
    const int across = -lattice.sign(node.row, node.col) * in;
    const bool is_corner_square = (t == start - 1 && across < 0) || (t == end && across > 0);
    LocalFrame predicted;
    if (is_corner_square || !predictNode(lattice, node.row, node.col, window, predicted))
    {
      continue;
    }
    if (!isInPicture(looker.frame().raw_grey, predicted.node, 2))
    {
      ++result.outside;
      continue;
    }
    ++result.places;
    const int dark_u = isRow(side) ? across : in;
    const int dark_v = isRow(side) ? in : across;
    const RimLook look = looker.lookAtRim(predicted, dark_u, dark_v, isRow(side), contrast);
    result.seen += look == RimLook::outer_corner ? 1 : 0;
    result.edges += look == RimLook::outer_edge ? 1 : 0;
    result.goes_on += look == RimLook::inner_corner ? 1 : 0;
  }
  return result;
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
    if (convinces(lattice, looker, node.row, node.col, false))
    {
      ++convincing;
      const Node inner = nodeOnLine(side, line + inwards(side), t);
      const Node before = nodeOnLine(side, line, t - 1);
      const Node after = nodeOnLine(side, line, t + 1);
      const bool beside = lattice.found(inner.row, inner.col) || lattice.found(before.row, before.col) ||
                          lattice.found(after.row, after.col);
      anchored += beside && convinces(lattice, looker, node.row, node.col, true) ? 1 : 0;
    }
  }
  LineSupport support;
  support.share = static_cast<float>(found) / static_cast<float>(end - start);
  support.enough = anchored >= 1 || (found >= 2 && support.share >= MIN_SHARE && convincing >= 1);
  // A line where the board ends, rather than goes on, has more outer corners than inner ones.
  const BorderLine border = lookAtBorder(lattice, looker, side, 0);
  support.enough = support.enough && border.seen <= found + border.goes_on;
  return support;
}

void dropLine(Lattice& lattice, Side side)
{
  const int line = lineIndex(lattice, side, 0);
  const int start = lineStart(lattice, side);
  const int end = start + lineLength(lattice, side);
  for (int t = start; t < end; ++t)
  {
    const Node node = nodeOnLine(side, line, t);
    lattice.remove(node.row, node.col);
  }
  cv::Rect& box = lattice.box;
  box.y += side == top ? 1 : 0;
  box.x += side == left ? 1 : 0;
  box.height -= isRow(side) ? 1 : 0;
  box.width -= isRow(side) ? 0 : 1;
}

void addLines(Lattice& lattice, Side side, int count)
{
  cv::Rect& box = lattice.box;
  box.y -= side == top ? count : 0;
  box.x -= side == left ? count : 0;
  box.height += isRow(side) ? count : 0;
  box.width += isRow(side) ? 0 : count;
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

SideEvidence sideEvidence(const Lattice& lattice, Side side, const BorderLine& border)
{
  constexpr int MIN_BORDER = 2;  // outer corners, the two of one rim square; something else gave one at most
  // Of the last line of inner corners; the more must be there, the less is seen of the border.
  constexpr float MIN_LINE_SHARE = 0.5F;
  constexpr float MIN_LINE_SHARE_ALONE = 0.8F;
  if (border.ends())
  {
    return SideEvidence::border;
  }
  if (border.outside > border.places)
  {
    return SideEvidence::cut;
  }
  const int seen = border.seen + border.edges;
  const auto found = static_cast<float>(countOnLine(lattice, side, lineIndex(lattice, side, 0)));
  const float share = found / static_cast<float>(lineLength(lattice, side));
  const bool is_last = border.seen >= MIN_BORDER || share >= (seen > 0 ? MIN_LINE_SHARE : MIN_LINE_SHARE_ALONE);
  return is_last && border.goes_on <= 1 + border.seen / 2 ? SideEvidence::rim : SideEvidence::none;
}

/** Looks for a corner that no found corner need be beside of: more is asked of it. */
bool lookAcrossGap(const Lattice& lattice, CornerLooker& looker, const LatticeModel* model, float contrast, int row,
                   int col, CornerLook& corner)
{
  constexpr float TOLERANCE = 0.2F;
  constexpr float MIN_CORRELATION = 0.9F;
  constexpr float MIN_CONTRAST_SHARE = 0.4F;
  LocalFrame predicted;
  if (model != nullptr)
  {
    predicted = model->frameAt(row, col);
  }
  else if (!predictNode(lattice, row, col, REACH + 2, predicted))
  {
    return false;
  }
  if (cross(predicted.u, predicted.v) * cross(lattice.seedFrame().u, lattice.seedFrame().v) <= 0)
  {
    return false;
  }
  CornerQuery query;
  query.sign = lattice.sign(row, col);
  query.tolerance = TOLERANCE;
  query.contrast = contrast;
  query.correlation = MIN_CORRELATION;
  corner = looker.look(predicted, query);
  if (!corner.found || corner.contrast < MIN_CONTRAST_SHARE * contrast)
  {
    return false;
  }
  const float least = 0.6F * squareHeight(predicted);
  for (int i = row - 2; i <= row + 2; ++i)
  {
    for (int j = col - 2; j <= col + 2; ++j)
    {
      if (lattice.found(i, j) && length(lattice.at(i, j).position - corner.position) < least)
      {
        return false;
      }
    }
  }
  return true;
}

bool isWithinReach(const Lattice& lattice, int row, int col)
{
  for (int i = std::max(0, row - REACH); i <= std::min(Lattice::SIZE - 1, row + REACH); ++i)
  {
    for (int j = std::max(0, col - REACH); j <= std::min(Lattice::SIZE - 1, col + REACH); ++j)
    {
      if (lattice.found(i, j))
      {
        return true;
      }
    }
  }
  return false;
}
}  // namespace

bool BorderLine::mayEnd() const
{
  constexpr float MIN_SHARE = 0.35F;
  return seen >= 3 && goes_on == 0 && static_cast<float>(seen) >= MIN_SHARE * static_cast<float>(places);
}

bool BorderLine::ends() const
{
  constexpr float MIN_SHARE = 0.5F;
  return seen >= 2 && seen > goes_on && static_cast<float>(seen) >= MIN_SHARE * static_cast<float>(places);
}

BorderLine lookAtBorder(const Lattice& lattice, CornerLooker& looker, Side side, int distance)
{
  return lookAtLine(lattice, looker, side, lineIndex(lattice, side, distance), WINDOW + distance);
}

void splitAtBorders(Lattice& lattice, CornerLooker& looker)
{
  for (const Side side : SIDES)
  {
    // From the middle outwards: a line without inner corners that has a border's outer ones on the inner side.
    const int last = lineIndex(lattice, side, 0);
    for (int line = Lattice::SEED; (last - line) * inwards(side) < 0; line -= inwards(side))
    {
      const BorderLine border = lookAtLine(lattice, looker, side, line, WINDOW + 1);
      // The next board begins a line further out at least: both lines are without inner corners.
      const int inner_corners =
          std::max(countOnLine(lattice, side, line), countOnLine(lattice, side, line - inwards(side)));
      if (3 * inner_corners > border.seen)
      {
        continue;
      }
      if (border.seen >= 0.7 * border.places || (border.mayEnd() && inner_corners == 0))
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

void jumpGaps(Lattice& lattice, CornerLooker& looker)
{
  constexpr int MAX_ROUNDS = 6;
  constexpr int MIN_CORNERS = 6;
  constexpr double MAX_RESIDUAL = 0.06;  // squares, at which one homography still says where the next square is
  struct Find
  {
    int row, col;
    CornerLook corner;
  };
  for (int round = 0; round < MAX_ROUNDS && lattice.count() >= MIN_CORNERS; ++round)
  {
    LatticeModel model;
    const cv::Rect box = lattice.box;
    const bool fits =
        model.fit(lattice, LatticeModel::homography, 0) &&
        model.rms() < MAX_RESIDUAL * squareHeight(model.frameAt(box.y + box.height / 2., box.x + box.width / 2.));
    const float contrast = lattice.medianContrast();
    int reach[4];
    for (const Side side : SIDES)
    {
      reach[side] = lookAtBorder(lattice, looker, side, 1).ends() ? 0 : REACH;
    }
    std::vector<Find> finds;
    for (int i = box.y - reach[top]; i < box.br().y + reach[bottom]; ++i)
    {
      for (int j = box.x - reach[left]; j < box.br().x + reach[right]; ++j)
      {
        Find find{i, j, {}};
        if (Lattice::admits(i, j) && !lattice.found(i, j) && isWithinReach(lattice, i, j) &&
            lookAcrossGap(lattice, looker, fits ? &model : nullptr, contrast, i, j, find.corner))
        {
          finds.push_back(find);
        }
      }
    }
    // One alone may be chance: another find or a corner must be beside it.
    const Lattice& known = lattice;
    const auto is_alone = [&](const Find& find) {
      for (int i = find.row - 1; i <= find.row + 1; ++i)
      {
        for (int j = find.col - 1; j <= find.col + 1; ++j)
        {
          if (known.found(i, j))
          {
            return false;
          }
        }
      }
      return std::none_of(finds.begin(), finds.end(), [&](const Find& other) {
        const int distance = std::max(std::abs(other.row - find.row), std::abs(other.col - find.col));
        return distance == 1;
      });
    };
    finds.erase(std::remove_if(finds.begin(), finds.end(), is_alone), finds.end());
    for (const Find& find : finds)
    {
      lattice.put(find.row, find.col, find.corner);
    }
    if (finds.empty())
    {
      return;
    }
    growLattice(lattice, looker, Lattice::SIZE * Lattice::SIZE);
  }
}

void dropOutliers(Lattice& lattice)
{
  constexpr int MIN_CORNERS = 12;
  constexpr double MIN_RESIDUAL = 0.8;         // px
  constexpr double MIN_RESIDUAL_SHARE = 0.05;  // squares
  constexpr double MAX_MEDIANS = 5;
  LatticeModel model;
  if (lattice.count() < MIN_CORNERS || lattice.box.width < 3 || lattice.box.height < 3 ||
      !model.fit(lattice, lattice.count() >= 30 ? LatticeModel::cubic : LatticeModel::quadratic, 0.1))
  {
    return;
  }
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
  // Where a third does not fit, it is the model that is wrong.
  if (static_cast<int>(outliers.size()) * 3 <= lattice.count())
  {
    for (const Node& node : outliers)
    {
      lattice.remove(node.row, node.col);
    }
  }
}

std::array<SideEvidence, 4> settleExtent(Lattice& lattice, CornerLooker& looker)
{
  constexpr int MAX_HIDDEN_LINES = 2;
  trim(lattice, looker);
  std::array<BorderLine, 4> borders;
  for (const Side side : SIDES)
  {
    borders[side] = lookAtBorder(lattice, looker, side, 1);
    for (int hidden = 1; hidden <= MAX_HIDDEN_LINES && !borders[side].ends(); ++hidden)
    {
      const BorderLine beyond = lookAtBorder(lattice, looker, side, 1 + hidden);
      if (beyond.ends())
      {
        addLines(lattice, side, hidden);
        borders[side] = beyond;
      }
    }
  }
  std::array<SideEvidence, 4> evidence;
  for (const Side side : SIDES)
  {
    evidence[side] = sideEvidence(lattice, side, borders[side]);
  }
  return evidence;
}

}  // namespace outdoor_omr
