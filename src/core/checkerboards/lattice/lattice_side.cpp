#include "lattice_side.h"

namespace omr
{
bool isRow(Side side)
{
  return side == top || side == bottom;
}

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

int inwards(Side side)
{
  return side == top || side == left ? 1 : -1;
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

}  // namespace omr
