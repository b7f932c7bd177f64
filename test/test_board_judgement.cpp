#include "checkerboards/board_judgement.h"

#include <gtest/gtest.h>

#include "lattices.h"

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

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
