#include "lattice_growth.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "lattice_prediction.h"
#include "median.h"

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
    result.contrast = median(contrasts, result.count);
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

void lookAtNode(Lattice& lattice, CornerLooker& looker, int row, int col, float tolerance)
{
  LocalFrame predicted;
  LatticeNode& node = lattice.at(row, col);
  node.looks = static_cast<std::uint8_t>(std::min(node.looks + 1, 255));
  if (!predictNode(lattice, row, col, PREDICTION_WINDOW, predicted))
  {
    return;
  }
  const Neighbourhood known = neighbourhood(lattice, row, col);
  CornerQuery query;
  query.sign = lattice.sign(row, col);
  query.contrast = known.contrast;
  query.tolerance = known.count >= SUPPORTED ? std::min(tolerance, SUPPORTED_TOLERANCE) : tolerance;
  const CornerLook corner = looker.look(predicted, query);
  if (corner.found && !isOnNeighbour(lattice, row, col, corner.position, 0.5F * squareHeight(predicted)))
  {
    lattice.put(row, col, corner);
  }
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

/** How the step from corner to corner changes at one of them, in steps. */
bool changeAt(const Lattice& lattice, int row, int col, int down, int right, cv::Point2f& change)
{
  if (!lattice.found(row - down, col - right) || !lattice.found(row, col) || !lattice.found(row + down, col + right))
  {
    return false;
  }
  const cv::Point2f before = lattice.at(row, col).position - lattice.at(row - down, col - right).position;
  const cv::Point2f after = lattice.at(row + down, col + right).position - lattice.at(row, col).position;
  change = (after - before) * (1 / std::max(length(before), length(after)));
  return true;
}

/**
 * Whether the steps between corners change from square to square so much that the change itself does, as in pictures of
 * fisheyes. Neighbouring lines must agree: single corners are also moved by the edges of shadows.
 */
bool bendsStrongly(const Lattice& lattice)
{
  constexpr int MIN_CORNERS = 12;
  constexpr float MIN_CHANGE = 0.12F;
  constexpr float MAX_DIFFERENCE = 0.5F;    // of two lines, of the change
  constexpr float MIN_SHARE = 0.15F;        // of the places
  constexpr float MIN_CORRELATION = 0.97F;  // clutter has less; its lattices would be grown twice
  if (lattice.count() < MIN_CORNERS)
  {
    return false;
  }
  int count = 0;
  int bent = 0;
  const auto consider = [&](int row, int col, int down, int right) {
    cv::Point2f here;
    cv::Point2f beside;
    if (changeAt(lattice, row, col, down, right, here) &&
        changeAt(lattice, row + right, col + down, down, right, beside))
    {
      const float least = std::min(length(here), length(beside));
      ++count;
      bent += least > MIN_CHANGE && length(here - beside) < MAX_DIFFERENCE * least ? 1 : 0;
    }
  };
  float correlation = 0;
  for (int i = lattice.box.y; i < lattice.box.br().y; ++i)
  {
    for (int j = lattice.box.x; j < lattice.box.br().x; ++j)
    {
      correlation += lattice.found(i, j) ? lattice.at(i, j).correlation : 0;
      consider(i, j, 0, 1);
      consider(i, j, 1, 0);
    }
  }
  return correlation > MIN_CORRELATION * static_cast<float>(lattice.count()) &&
         static_cast<float>(bent) > MIN_SHARE * static_cast<float>(count);
}

/** So that nodes are looked at again, with better predictions. */
void forgetLooks(Lattice& lattice)
{
  for (int i = lattice.box.y - 1; i <= lattice.box.br().y; ++i)
  {
    for (int j = lattice.box.x - 1; j <= lattice.box.br().x; ++j)
    {
      if (Lattice::admits(i, j))
      {
        lattice.at(i, j).looks = 0;
      }
    }
  }
}
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
    const bool bent = lattice.bends_strongly;
    lattice.bends_strongly = bent || bendsStrongly(lattice);
    if (lattice.bends_strongly)
    {
      RadialModel model;
      const bool fits = model.fit(lattice, looker.frame().raw_grey.size());
      lattice.radial = fits ? std::optional<RadialModel>(model) : std::nullopt;
    }
    if (lattice.bends_strongly && !bent)
    {
      forgetLooks(lattice);
    }
    else if (lattice.count() == before)
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
