#include "corners.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "checkerboards/corners/corner_fit.h"
#include "lattice_model.h"
#include "lattice_prediction.h"
#include "lattice_side.h"
#include "median.h"

namespace omr
{
namespace
{
/**
 * Weights corners whose picture is worse explained than the others': something covers a part of them, draws them by
 * 0.03 to 0.3 px and the surface with them. On rendered plates of which 30 % is hidden (240 pictures) the seen corners
 * beside unseen squares, squares of 7 to 16 px: RMS 0.07 -> 0.014 px; occlusion set, all corners: 0.062 -> 0.048.
 *
 * @param noise of corners that nothing covers, beside the surface [px].
 */
void weightCorners(const std::vector<float>& misfits, float noise, Lattice& lattice)
{
  constexpr float CLEAN = 2.5F;      // deviations of the misfits; normal ones lie below
  constexpr float DRAWN = 0.6F;      // px of error by a misfit of the whole contrast, beyond the others'
  constexpr float UNFITTED = 0.15F;  // px; of saddle points
  std::vector<float> sorted;
  std::copy_if(misfits.begin(), misfits.end(), std::back_inserter(sorted), [](float misfit) { return misfit >= 0; });
  if (sorted.empty())
  {
    return;
  }
  const float usual = median(sorted);
  std::transform(sorted.begin(), sorted.end(), sorted.begin(), [&](float misfit) { return std::abs(misfit - usual); });
  const float limit = usual + CLEAN * 1.4826F * median(std::move(sorted));
  std::size_t number = 0;
  for (int i = lattice.box.y; i < lattice.box.br().y; ++i)
  {
    for (int j = lattice.box.x; j < lattice.box.br().x; ++j, ++number)
    {
      const float misfit = misfits[number];
      const float excess = std::sqrt(std::max(0.F, misfit * misfit - limit * limit));
      const float error = misfit < 0 ? UNFITTED : DRAWN * excess;
      lattice.at(i, j).weight = noise * noise / (noise * noise + error * error);
    }
  }
}

/**
 * Moves the corners to where their pictures fit.
 *
 * @param model through them, if it explains them; none otherwise: then nothing but its picture speaks for a corner, and
 *              those without one, up to a third, are removed.
 * @return misfits of all nodes, see CornerFit.
 */
std::vector<float> fitCorners(const cv::Mat& grey, const LatticeModel* model, Lattice& lattice)
{
  // Where no surface tells, in pictures of fisheyes, an outer corner passed for one 15 px off.
  constexpr float MIN_SQUARENESS = 1.2F;
  const Lattice before = lattice;
  std::vector<float> misfits(before.box.area(), -1);
  std::vector<Node> unfitted;
  for (int i = before.box.y; i < before.box.br().y; ++i)
  {
    for (int j = before.box.x; j < before.box.br().x; ++j)
    {
      const cv::Point2f position = before.at(i, j).position;
      LocalFrame corner;
      if (!before.found(i, j) || (model == nullptr && !predictNode(before, i, j, 1, corner)))
      {
        continue;
      }
      if (model == nullptr)
      {
        corner.node = position;
      }
      else
      {
        corner = model->frameAt(i, j);
        if (model->isOutlier(length(position - corner.node)))
        {
          continue;
        }
      }
      const CornerFit fit = fitCorner(grey, corner);
      lattice.at(i, j).position = fit.position;
      if (model == nullptr && fit.squareness < MIN_SQUARENESS)
      {
        unfitted.push_back({i, j});
      }
      misfits[(i - before.box.y) * before.box.width + j - before.box.x] = fit.misfit;
    }
  }
  if (3 * static_cast<int>(unfitted.size()) <= before.count())
  {
    for (const Node& node : unfitted)
    {
      lattice.remove(node.row, node.col);
    }
  }
  return misfits;
}

/**
 * Whether the picture has a corner where the surface has it: where the search missed it, or a shadow's edge or a thing
 * beside it draws it. Of 753 visible corners that were not seen 151 are there, of 493 hidden ones none; not seen on the
 * doe set 4.7 -> 3.9 % of the visible ones, occlusion 16.7 -> 13.7, blender 10.8 -> 6.6.
 *
 * @param contrast of the board, with the corner's sign.
 */
bool isThere(const cv::Mat& grey, const LocalFrame& corner, float contrast)
{
  constexpr float MAX_MISFIT = 0.3F;
  constexpr float MAX_OFF = 0.3F;  // px
  constexpr float MIN_SQUARENESS = 1.2F;
  constexpr float MIN_CONTRAST = 0.7F;  // of the board's; five hidden ones that pass for the rest have .40 to .55
  const CornerFit fit = fitCorner(grey, corner);
  return fit.misfit >= 0 && fit.misfit < MAX_MISFIT && length(fit.position - corner.node) < MAX_OFF &&
         fit.squareness > MIN_SQUARENESS && fit.contrast / contrast > MIN_CONTRAST;
}

/**
 * How much alike the residuals of neighbours are, 0 (noise) to 1 (all the same): those of a sheet that ripples are
 * alike, and no error of measurement.
 *
 * @return 0 where there are too few.
 */
float coherence(const Lattice& lattice, const LatticeModel& model)
{
  constexpr int MIN_PAIRS = 12;
  const cv::Rect& box = lattice.box;
  std::vector<cv::Point2f> residuals(box.area());
  std::vector<bool> counts(box.area());
  for (int k = 0; k < box.area(); ++k)
  {
    const int row = box.y + k / box.width;
    const int col = box.x + k % box.width;
    const cv::Point2f residual = lattice.at(row, col).position - model.at(row, col);
    residuals[k] = std::sqrt(lattice.at(row, col).weight) * residual;
    counts[k] = lattice.found(row, col) && !model.isOutlier(length(residual));
  }
  double product = 0;
  double square = 0;
  int pairs = 0;
  const auto add = [&](int k, int beside) {
    if (counts[k] && counts[beside])
    {
      product += residuals[k].dot(residuals[beside]);
      square += (residuals[k].dot(residuals[k]) + residuals[beside].dot(residuals[beside])) / 2;
      ++pairs;
    }
  };
  for (int k = 0; k < box.area(); ++k)
  {
    if (k % box.width + 1 < box.width)
    {
      add(k, k + 1);
    }
    if (k + box.width < box.area())
    {
      add(k, k + box.width);
    }
  }
  return pairs < MIN_PAIRS || product <= 0 ? 0.F : static_cast<float>(product / square);
}

/**
 * Share of the surface in the corners' places: what neighbours have in common is the sheet's shape. Of flat boards
 * (doe, degrade) nine of ten are below 0.01, of bent ones half above 0.29. RMS of the corners, with 0.8 for all and so:
 * curved 0.051 -> 0.037 px, blender 0.101 -> 0.093, real 0.505 -> 0.490, occlusion 0.0494 -> 0.0497, doe and degrade as
 * before. With 0.1 and 0.3 as limits occlusion has 0.0506.
 */
float surfaceShare(float coherence)
{
  constexpr float LARGEST = 0.8F;
  constexpr float NOISE = 0.15F;  // coherence up to here
  constexpr float SHAPE = 0.45F;  // and from here
  return LARGEST * std::clamp((SHAPE - coherence) / (SHAPE - NOISE), 0.F, 1.F);
}
}  // namespace

std::vector<bool> refineCorners(const Frame& frame, Lattice& lattice)
{
  constexpr double RIDGE = 0.5;
  constexpr double MAX_RMS = 0.8;  // px; blurred and shadowed boards have 0.3 to 0.7 (with 0.35: degrade 0.17 for 0.10)
  constexpr int PREDICTION_WINDOW = 3;  // nodes
  constexpr float NOISE = 0.015F;       // px; corners have it on rendered boards
  // The second sees whether the surface bears the weights of the first: a crumpled sheet does not (one board of the
  // blender set 0.1 -> 0.47 px with one).
  constexpr int WEIGHTINGS = 2;
  // Of a corner that counts as measured: it is off by three times the noise, and others say where it is. As measured
  // ones they would bend poses: the worst of 220 plates hidden to 30 % at 4 to 6 m 11 -> 3 mm.
  constexpr float MIN_WEIGHT = 0.1F;
  LatticeModel model;
  bool is_surface = model.fitSmooth(lattice, RIDGE);
  const std::vector<float> misfits =
      fitCorners(frame.raw_grey, is_surface && model.rms() < MAX_RMS ? &model : nullptr, lattice);
  is_surface = is_surface && model.fitSmooth(lattice, RIDGE);
  float noise = NOISE;
  for (int round = 0; is_surface && round < WEIGHTINGS; ++round)
  {
    noise = std::max(noise, static_cast<float>(model.median()));
    weightCorners(misfits, noise, lattice);
    is_surface = model.fitSmooth(lattice, RIDGE);
  }
  const bool explains = is_surface && model.rms() < MAX_RMS;
  const float share = explains ? surfaceShare(coherence(lattice, model)) : 0;
  const cv::Rect box = lattice.box;
  const float contrast = lattice.medianContrast();
  std::vector<bool> seen;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      LatticeNode& node = lattice.at(i, j);
      const cv::Point2f smooth = is_surface ? model.at(i, j) : node.position;
      const bool refuted = explains && model.isOutlier(length(node.position - smooth));
      seen.push_back(node.found && !refuted && node.weight > MIN_WEIGHT);
      if (!seen.back())
      {
        LocalFrame near;
        node.position = explains || !predictNode(lattice, i, j, PREDICTION_WINDOW, near) ? smooth : near.node;
        seen.back() = explains && isThere(frame.raw_grey, model.frameAt(i, j), lattice.sign(i, j) * contrast);
      }
      else if (explains)
      {
        node.position += (1 - (1 - share) * node.weight) * (smooth - node.position);
      }
    }
  }
  lattice.fill();
  return seen;
}

}  // namespace omr
