#include "board_sections.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "checkerboards/lattice/checkerboard_order.h"
#include "checkerboards/lattice/lattice_evidence.h"

namespace omr
{
namespace
{
constexpr int MIN_CORNERS = 12;
constexpr int MIN_SIDE = 3;  // corners
constexpr float MIN_FILL = 0.5F;
// See board_judgement.cpp: of lattices in clutter 5 % are below 2.4. Those of hidden boards have 0.3 to 1.3.
constexpr float MAX_DOUBT = 1.5F;

bool isClear(const Lattice& lattice)
{
  const Evidence evidence = latticeEvidence(lattice);
  return lattice.count() >= MIN_CORNERS && std::min(lattice.box.width, lattice.box.height) >= MIN_SIDE &&
         evidence.fill >= MIN_FILL && evidence.doubt() <= MAX_DOUBT;
}
}  // namespace

int countOn(const Lattice& lattice, const std::vector<cv::Point2f>& outline)
{
  int count = 0;
  for (int i = lattice.box.y; i < lattice.box.br().y; ++i)
  {
    for (int j = lattice.box.x; j < lattice.box.br().x; ++j)
    {
      count += lattice.found(i, j) && cv::pointPolygonTest(outline, lattice.at(i, j).position, false) > 0 ? 1 : 0;
    }
  }
  return count;
}

void BoardSections::add(const Lattice& lattice)
{
  if (!isClear(lattice))
  {
    return;
  }
  Section section{lattice, boardOutline(lattice)};
  const auto shares_place = [&](const Section& other) {
    return countOn(section.lattice, other.outline) > 0 || countOn(other.lattice, section.outline) > 0;
  };
  const bool beaten = std::any_of(sections_.begin(), sections_.end(), [&](const Section& other) {
    return other.lattice.count() >= lattice.count() && shares_place(other);
  });
  if (!beaten)
  {
    sections_.erase(std::remove_if(sections_.begin(), sections_.end(), shares_place), sections_.end());
    sections_.push_back(std::move(section));
  }
}

std::vector<Lattice> BoardSections::beside(const std::vector<std::vector<cv::Point2f>>& boards) const
{
  std::vector<Lattice> lattices;
  for (const Section& section : sections_)
  {
    if (std::none_of(boards.begin(), boards.end(),
                     [&](const auto& board) { return countOn(section.lattice, board) > 0; }))
    {
      lattices.push_back(section.lattice);
    }
  }
  return lattices;
}

}  // namespace omr
