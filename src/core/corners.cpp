#include "outdoor_omr/corners.h"

#include "corner_fit.h"
#include "outdoor_omr/lattice_model.h"
#include "outdoor_omr/lattice_prediction.h"

namespace omr
{
namespace
{
/** Moves the corners to where their pictures fit. @param model through them, if it explains them; none otherwise. */
void fitCorners(const cv::Mat& grey, const LatticeModel* model, Lattice& lattice)
{
  const Lattice before = lattice;
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
      lattice.at(i, j).position = fitCorner(grey, corner);
    }
  }
}
}  // namespace

std::vector<bool> refineCorners(const Frame& frame, Lattice& lattice)
{
  constexpr double RIDGE = 0.5;
  constexpr double MAX_RMS = 0.8;  // px; blurred and shadowed boards have 0.3 to 0.7 (with 0.35: degrade 0.17 for 0.10)
  constexpr float MODEL_SHARE = 0.8F;  // of the surface in the result
  LatticeModel model;
  if (!model.fitSmooth(lattice, RIDGE))
  {
    return {};
  }
  fitCorners(frame.raw_grey, model.rms() < MAX_RMS ? &model : nullptr, lattice);
  if (!model.fitSmooth(lattice, RIDGE))
  {
    return {};
  }
  const bool explains = model.rms() < MAX_RMS;
  const cv::Rect box = lattice.box;
  std::vector<bool> seen;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      LatticeNode& node = lattice.at(i, j);
      const cv::Point2f smooth = model.at(i, j);
      const bool refuted = explains && model.isOutlier(length(node.position - smooth));
      seen.push_back(node.found && !refuted);
      if (!seen.back())
      {
        node.position = smooth;
      }
      else if (explains)
      {
        node.position += MODEL_SHARE * (smooth - node.position);
      }
    }
  }
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      lattice.at(i, j).found = true;
    }
  }
  return seen;
}

}  // namespace omr
