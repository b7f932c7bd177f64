#include "outdoor_omr/lattice_growth.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "outdoor_omr/lattice_prediction.h"

namespace omr
{
namespace
{
constexpr int PREDICTION_WINDOW = 3;  // nodes
constexpr float TOLERANCE = 0.25F;    // squares, while few corners support the prediction
constexpr float SUPPORTED_TOLERANCE = 0.15F;
constexpr int SUPPORTED = 6;  // corners within two nodes
constexpr int MAX_ROUNDS = 60;

/** Number of found corners within two nodes, and their median contrast. */
struct Neighbourhood
{
  int count = 0;
  float contrast = 0;
};

Neighbourhood neighbourhood(const Lattice& lattice, int row, int col)
{
  std::array<float, 25> contrasts;
  Neighbourhood result;
  for (int i = row - 2; i <= row + 2; ++i)
  {
    for (int j = col - 2; j <= col + 2; ++j)
    {
      if (lattice.found(i, j))
      {
        contrasts[result.count++] = lattice.at(i, j).contrast;
      }
    }
  }
  if (result.count > 0)
  {
    const auto middle = contrasts.begin() + result.count / 2;
    std::nth_element(contrasts.begin(), middle, contrasts.begin() + result.count);
    result.contrast = *middle;
  }
  return result;
}

bool isOnNeighbour(const Lattice& lattice, int row, int col, const cv::Point2f& position, float distance)
{
  for (int i = row - 1; i <= row + 1; ++i)
  {
    for (int j = col - 1; j <= col + 1; ++j)
    {
      if (lattice.found(i, j) && length(lattice.at(i, j).position - position) < distance)
      {
        return true;
      }
    }
  }
  return false;
}

bool lookAtNode(Lattice& lattice, CornerLooker& looker, int row, int col, float tolerance)
{
  LocalFrame predicted;
  LatticeNode& node = lattice.at(row, col);
  node.looks = static_cast<std::uint8_t>(std::min(node.looks + 1, 255));
  if (!predictNode(lattice, row, col, PREDICTION_WINDOW, predicted))
  {
    return false;
  }
  const Neighbourhood known = neighbourhood(lattice, row, col);
  CornerQuery query;
  query.sign = lattice.sign(row, col);
  query.contrast = known.contrast;
  query.tolerance = known.count >= SUPPORTED ? std::min(tolerance, SUPPORTED_TOLERANCE) : tolerance;
  const CornerLook corner = looker.look(predicted, query);
  if (!corner.found || isOnNeighbour(lattice, row, col, corner.position, 0.5F * squareHeight(predicted)))
  {
    return false;
  }
  lattice.put(row, col, corner);
  return true;
}

/** Nodes beside found corners, best supported first; one that failed waits until its support has doubled. */
struct Frontier
{
  struct Candidate
  {
    int support, row, col;
  };

  explicit Frontier(const Lattice& lattice)
  {
    for (int i = lattice.box.y - 1; i <= lattice.box.br().y; ++i)
    {
      for (int j = lattice.box.x - 1; j <= lattice.box.br().x; ++j)
      {
        if (!lattice.found(i, j) && Lattice::admits(i, j))
        {
          consider(lattice, i, j);
        }
      }
    }
    std::sort(candidates.begin(), candidates.begin() + count, [](const Candidate& a, const Candidate& b) {
      return std::tie(b.support, a.row, a.col) < std::tie(a.support, b.row, b.col);
    });
  }

  void consider(const Lattice& lattice, int row, int col)
  {
    const int sides = static_cast<int>(lattice.found(row - 1, col)) + static_cast<int>(lattice.found(row + 1, col)) +
                      static_cast<int>(lattice.found(row, col - 1)) + static_cast<int>(lattice.found(row, col + 1));
    const int diagonals =
        static_cast<int>(lattice.found(row - 1, col - 1)) + static_cast<int>(lattice.found(row - 1, col + 1)) +
        static_cast<int>(lattice.found(row + 1, col - 1)) + static_cast<int>(lattice.found(row + 1, col + 1));
    const int looks = lattice.at(row, col).looks;
    if (sides > 0 && (looks == 0 || sides + diagonals > 2 * looks))
    {
      candidates[count++] = {3 * sides + diagonals, row, col};
    }
  }

  std::array<Candidate, Lattice::SIZE * Lattice::SIZE> candidates;
  int count = 0;
};
}  // namespace

void growLattice(Lattice& lattice, CornerLooker& looker, int max_count)
{
  for (int round = 0; round < MAX_ROUNDS && lattice.count() < max_count; ++round)
  {
    const int before = lattice.count();
    const Frontier frontier(lattice);
    for (int i = 0; i < frontier.count; ++i)
    {
      lookAtNode(lattice, looker, frontier.candidates[i].row, frontier.candidates[i].col, TOLERANCE);
    }
    if (lattice.count() == before)
    {
      return;
    }
  }
}

void fillHoles(Lattice& lattice, CornerLooker& looker)
{
  const cv::Rect box = lattice.box;
  for (int pass = 0; pass < 2; ++pass)
  {
    for (int i = box.y; i < box.br().y; ++i)
    {
      for (int j = box.x; j < box.br().x; ++j)
      {
        if (!lattice.found(i, j))
        {
          lookAtNode(lattice, looker, i, j, 0.8F * TOLERANCE);
        }
      }
    }
  }
}

}  // namespace omr
