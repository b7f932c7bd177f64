#include "checkerboards/judgement/board_judgement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "checkerboards/checkerboards.h"
#include "lattices.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

using omr::Lattice;
using omr::SideEvidence;

namespace
{
constexpr int ROWS = 10;
constexpr int COLS = 15;

/** Clear corners, without those of the rows in the middle. */
Lattice latticeWithout(int rows)
{
  Lattice lattice = omr::test::latticeOf(ROWS, COLS, [](int col, int row) {
    return cv::Point2f(20.F * static_cast<float>(col), 20.F * static_cast<float>(row));
  });
  const cv::Rect box = lattice.box;
  for (int i = 0; i < rows; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      lattice.remove(box.y + 3 + i, j);
    }
  }
  return lattice;
}

/** Boards and sections. */
std::vector<omr::Checkerboard> findIn(const cv::Mat& picture)
{
  omr::RegionMap map;
  omr::FillPipeline("reference").run(picture, omr::Settings(), {}, map);
  std::vector<omr::Checkerboard> sections;
  std::vector<omr::Checkerboard> found =
      omr::findCheckerboards(omr::makeFrame(picture), map, omr::Settings(), {}, &sections);
  found.insert(found.end(), sections.begin(), sections.end());
  return found;
}

enum class Places
{
  all,
  every_other  // as the dark squares of a board
};

/** Dots on a sheet, of a radius relative to the sides of squares. */
cv::Mat gridOfDots(Places places, double radius, double angle, double sheet = 240, double ink = 20)
{
  constexpr int ROWS = 6;
  constexpr int COLS = 9;
  const cv::Matx33d to_pixels = omr::test::boardHomography(ROWS, COLS, {210, 170}, 25, angle, 20);
  omr::test::Render render({420, 340});
  const auto at = [&](double x, double y) { return omr::test::project(to_pixels, x, y); };
  render.addPolygon({at(-1, -1), at(COLS + 1, -1), at(COLS + 1, ROWS + 1), at(-1, ROWS + 1)}, cv::Scalar::all(sheet));
  for (int i = 0; i < ROWS; ++i)
  {
    for (int j = 0; j < COLS; ++j)
    {
      if (places == Places::all || (i + j) % 2 == 0)
      {
        render.addCircle({j + 0.5, i + 0.5}, radius, to_pixels, cv::Scalar::all(ink));
      }
    }
  }
  return render.picture();
}
}  // namespace

TEST(BoardJudgement, tilesThatThePictureCutsAreNoBoard)
{
  const auto is_board = [](int hidden_rows, SideEvidence first, SideEvidence others) {
    return omr::isBoard(latticeWithout(hidden_rows), {first, others, others, others});
  };
  EXPECT_FALSE(is_board(4, SideEvidence::rim, SideEvidence::cut));
  EXPECT_TRUE(is_board(1, SideEvidence::rim, SideEvidence::cut)) << "little is hidden";
  EXPECT_TRUE(is_board(4, SideEvidence::rim, SideEvidence::rim)) << "all in the picture";
  EXPECT_TRUE(is_board(4, SideEvidence::border, SideEvidence::cut)) << "a border";
}

TEST(BoardJudgement, fewBlurredCornersAreABoardWhereTheyLieEvenly)
{
  const auto is_board = [](float unevenness, int hidden) {
    Lattice lattice = omr::test::latticeOf(4, 6, [&](int col, int row) {
      const float aside = (3 * col + 2 * row) % 5 < 2 ? unevenness : -unevenness;
      return 20.F * cv::Point2f(static_cast<float>(col) + aside, static_cast<float>(row) - aside);
    });
    const cv::Rect box = lattice.box;
    for (int i = 0; i < box.area(); ++i)
    {
      lattice.at(box.y + i / box.width, box.x + i % box.width).correlation = 0.945F;
    }
    for (int j = 0; j < hidden; ++j)
    {
      lattice.remove(box.y + 1, box.x + j);
    }
    const SideEvidence rim = SideEvidence::rim;
    return omr::isBoard(lattice, {rim, rim, rim, rim});
  };
  EXPECT_TRUE(is_board(0, 0));
  EXPECT_TRUE(is_board(0.01F, 4));
  EXPECT_FALSE(is_board(0.08F, 0)) << "uneven";
  EXPECT_FALSE(is_board(0, 5)) << "too few";
}

TEST(BoardJudgement, threeBordersSpeakForABoardThatIsHalfHidden)
{
  const Lattice lattice = latticeWithout(6);
  Lattice doubtful = lattice;  // with less clear corners
  const cv::Rect box = lattice.box;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      doubtful.at(i, j).correlation = 0.945F;
    }
  }
  const SideEvidence border = SideEvidence::border;
  const SideEvidence rim = SideEvidence::rim;
  EXPECT_TRUE(omr::isBoard(lattice, {border, border, rim, rim}));
  EXPECT_TRUE(omr::isBoard(doubtful, {border, border, border, rim}));
  EXPECT_FALSE(omr::isBoard(doubtful, {border, border, rim, rim}));
}

TEST(BoardJudgement, aLatticeWithoutAnyOfItsCornersLiesAcrossAnother)
{
  const auto is_board = [](bool keeps_one) {
    Lattice lattice = latticeWithout(0);
    const cv::Rect box = lattice.box;
    for (int i = 0; i < box.height; ++i)
    {
      for (int j = 0; j < box.width; ++j)
      {
        const int from_end = std::min(i, box.height - 1 - i) + std::min(j, box.width - 1 - j);
        if (from_end < 3 && !(keeps_one && i + j < 3))
        {
          lattice.remove(box.y + i, box.x + j);
        }
      }
    }
    const SideEvidence border = SideEvidence::border;
    return omr::isBoard(lattice, {border, border, border, border});
  };
  EXPECT_FALSE(is_board(false));
  EXPECT_TRUE(is_board(true));
}

TEST(BoardJudgement, aGridOfDotsIsNoBoardThatLiesAcross)
{
  for (const double radius : {0.3, 0.35, 0.4, 0.45})
  {
    for (const double angle : {0, 20, 45})
    {
      EXPECT_TRUE(findIn(gridOfDots(Places::all, radius, angle)).empty()) << radius << ", " << angle << " degrees";
    }
  }
}

TEST(BoardJudgement, dotsInThePlacesOfSquaresAreNoBoard)
{
  for (const double radius : {0.4, 0.48, 0.54, 0.6})
  {
    for (const double angle : {0, 20, 45})
    {
      EXPECT_TRUE(findIn(gridOfDots(Places::every_other, radius, angle)).empty()) << radius << ", " << angle;
      EXPECT_TRUE(findIn(gridOfDots(Places::every_other, radius, angle, 30, 230)).empty()) << "light, " << radius;
    }
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
