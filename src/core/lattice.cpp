#include "outdoor_omr/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "outdoor_omr/least_squares.h"

namespace omr
{
namespace
{
constexpr int PREDICTION_WINDOW = 3;  // nodes
constexpr float TOLERANCE = 0.25F;    // squares, while few corners support the prediction
constexpr float SUPPORTED_TOLERANCE = 0.15F;
constexpr int SUPPORTED = 6;   // corners within two nodes
constexpr float MIN_AREA = 4;  // px^2 of a square
constexpr int MAX_ROUNDS = 60;

/** The corners around a node, gathered for a prediction. */
struct Support
{
  int count = 0;
  int first_row = Lattice::SIZE, last_row = -1, first_col = Lattice::SIZE, last_col = -1;
  int nearest_row = 0, nearest_col = 0;
  double nearest = 1e9;
};

/** With fewer than three corners, or all on one line: the step along the line, the seed's step across. */
LocalFrame predictFromLine(const Lattice& lattice, const Support& support, int row, int col)
{
  LocalFrame frame = lattice.seedFrame();
  if (support.count > 1 && support.last_col > support.first_col && support.first_row == support.last_row)
  {
    frame.u = (lattice.at(support.first_row, support.last_col).position -
               lattice.at(support.first_row, support.first_col).position) *
              (1.F / static_cast<float>(support.last_col - support.first_col));
  }
  if (support.count > 1 && support.last_row > support.first_row && support.first_col == support.last_col)
  {
    frame.v = (lattice.at(support.last_row, support.first_col).position -
               lattice.at(support.first_row, support.first_col).position) *
              (1.F / static_cast<float>(support.last_row - support.first_row));
  }
  frame.node = lattice.at(support.nearest_row, support.nearest_col).position;
  frame.node = frame.at(static_cast<float>(col - support.nearest_col), static_cast<float>(row - support.nearest_row));
  return frame;
}

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

float median(std::vector<float>& values, float otherwise)
{
  if (values.empty())
  {
    return otherwise;
  }
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}
}  // namespace

Lattice::Lattice() : nodes_(SIZE * SIZE)
{
}

void Lattice::start(const LocalFrame& seed, const CornerLook& corner)
{
  std::fill(nodes_.begin(), nodes_.end(), LatticeNode());
  seed_ = seed;
  seed_sign_ = corner.sign;
  count_ = 0;
  box = cv::Rect();
  put(SEED, SEED, corner);
}

void Lattice::put(int row, int col, const CornerLook& corner)
{
  LatticeNode& node = at(row, col);
  count_ += node.found ? 0 : 1;
  node.found = true;
  node.position = corner.position;
  node.contrast = corner.contrast;
  node.correlation = corner.correlation;
  box |= cv::Rect(col, row, 1, 1);
}

void Lattice::remove(int row, int col)
{
  LatticeNode& node = at(row, col);
  count_ -= node.found ? 1 : 0;
  node.found = false;
}

float Lattice::medianContrast() const
{
  std::vector<float> contrasts;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      if (found(i, j))
      {
        contrasts.push_back(at(i, j).contrast);
      }
    }
  }
  return median(contrasts, 0);
}

bool predictNode(const Lattice& lattice, int row, int col, int window, LocalFrame& predicted)
{
  constexpr int AFFINE = 3;
  constexpr int BILINEAR = 4;
  constexpr int QUADRATIC = 6;
  const cv::Rect rows_cols = lattice.box & cv::Rect(col - window, row - window, 2 * window + 1, 2 * window + 1);
  PointFit<QUADRATIC> fit;
  Support support;
  for (int i = rows_cols.y; i < rows_cols.br().y; ++i)
  {
    for (int j = rows_cols.x; j < rows_cols.br().x; ++j)
    {
      if (!lattice.found(i, j) || (i == row && j == col))
      {
        continue;
      }
      const double x = j - col;
      const double y = i - row;
      const double distance = x * x + y * y;
      fit.add({1, x, y, x * y, x * x, y * y}, lattice.at(i, j).position, 1 / (0.3 + distance));
      ++support.count;
      support.first_row = std::min(support.first_row, i);
      support.last_row = std::max(support.last_row, i);
      support.first_col = std::min(support.first_col, j);
      support.last_col = std::max(support.last_col, j);
      if (distance < support.nearest)
      {
        support.nearest = distance;
        support.nearest_row = i;
        support.nearest_col = j;
      }
    }
  }
  if (support.count == 0)
  {
    return false;
  }
  const int spread = std::min(support.last_row - support.first_row, support.last_col - support.first_col);
  if (support.count < AFFINE || spread < 1)
  {
    predicted = predictFromLine(lattice, support, row, col);
  }
  else
  {
    const int features = support.count >= 9 && spread >= 2 ? QUADRATIC : support.count >= 5 ? BILINEAR : AFFINE;
    // A little pull of the curvature towards none: extrapolation over two squares is what it is for.
    fit.addRidge(3, 0.02);
    fit.addRidge(4, 0.08);
    fit.addRidge(5, 0.08);
    cv::Point2d coefficients[QUADRATIC];
    if (!fit.solve(features, coefficients))
    {
      return false;
    }
    predicted = {coefficients[0], coefficients[1], coefficients[2]};
  }
  const float area = cross(predicted.u, predicted.v);
  return area * cross(lattice.seedFrame().u, lattice.seedFrame().v) > 0 && std::abs(area) > MIN_AREA;
}

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

float Evidence::doubt() const
{
  return (1 - correlation) / 0.05F + unevenness / 0.15F + (1 - fill) / 0.4F;
}

Evidence latticeEvidence(const Lattice& lattice)
{
  Evidence evidence;
  std::vector<float> correlations;
  std::vector<float> unevenness;
  // Third differences as sums of four or six nodes; the scale brings their noise to that of a second difference.
  const auto difference = [&](int i, int j, int di, int dj, int ei, int ej) {
    // d d e: the second difference along d, of two lines one step e apart.
    const bool all = lattice.found(i - di, j - dj) && lattice.found(i, j) && lattice.found(i + di, j + dj) &&
                     lattice.found(i - di + ei, j - dj + ej) && lattice.found(i + ei, j + ej) &&
                     lattice.found(i + di + ei, j + dj + ej);
    if (!all)
    {
      return;
    }
    const cv::Point2f here =
        lattice.at(i - di, j - dj).position - 2 * lattice.at(i, j).position + lattice.at(i + di, j + dj).position;
    const cv::Point2f there = lattice.at(i - di + ei, j - dj + ej).position - 2 * lattice.at(i + ei, j + ej).position +
                              lattice.at(i + di + ei, j + dj + ej).position;
    const float step = length(lattice.at(i + di, j + dj).position - lattice.at(i - di, j - dj).position) / 2;
    const float noise = std::sqrt(di == ei ? 20.F / 6 : 2.F);
    unevenness.push_back(length(there - here) / (noise * std::max(step, 1e-3F)));
  };
  for (int i = lattice.box.y; i < lattice.box.br().y; ++i)
  {
    for (int j = lattice.box.x; j < lattice.box.br().x; ++j)
    {
      if (lattice.found(i, j))
      {
        correlations.push_back(lattice.at(i, j).correlation);
        difference(i, j, 0, 1, 0, 1);
        difference(i, j, 1, 0, 1, 0);
        difference(i, j, 0, 1, 1, 0);
        difference(i, j, 1, 0, 0, 1);
      }
    }
  }
  evidence.fill = static_cast<float>(lattice.count()) / static_cast<float>(std::max(1, lattice.box.area()));
  evidence.correlation = median(correlations, 0);
  evidence.unevenness = median(unevenness, 0);
  return evidence;
}

}  // namespace omr
