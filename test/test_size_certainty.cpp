#include "checkerboards/judgement/size_certainty.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "lattices.h"
#include "render.h"

using omr::Lattice;
using omr::test::Render;

namespace
{
constexpr int ROWS = 6;
constexpr int COLS = 8;
const cv::Scalar WHITE = cv::Scalar::all(230);
const cv::Scalar GREY = cv::Scalar::all(90);

/** A board with a margin of a seventh of a square on a grey plate. */
class SizeCertainty : public testing::Test
{
 protected:
  SizeCertainty()
  {
    render_.addBoard(ROWS, COLS, place_, true, 0.15);
    sides_.fill(omr::SideEvidence::rim);
  }

  /** Covers columns. */
  void cover(double from, double to, const cv::Scalar& color)
  {
    render_.addPolygon({at(from, -2), at(to, -2), at(to, ROWS + 2), at(from, ROWS + 2)}, color);
  }

  /** Cuts the squares of columns at both ends. */
  void cut(double left, double right)
  {
    cover(-2, left - 0.15, GREY);
    cover(left - 0.15, left, WHITE);
    cover(COLS - right, COLS - right + 0.15, WHITE);
    cover(COLS - right + 0.15, COLS + 2, GREY);
  }

  /** @param cols of squares that the lattice has. */
  bool isCertain(int cols = COLS) const
  {
    const Lattice lattice = omr::test::latticeOf(
        ROWS - 1, cols - 1, [this](int col, int row) { return at(col + 1, row + 1); }, -1);
    std::vector<bool> seen(lattice.box.area(), true);
    for (int i = 0; i < lattice.box.height; ++i)
    {
      seen[i * lattice.box.width + lattice.box.width - 1] = i < last_column_seen_;
    }
    return omr::isSizeCertain(omr::makeFrame(render_.picture(0.8)), lattice, seen, sides_);
  }

  cv::Point2f at(double x, double y) const
  {
    return cv::Point2f(omr::test::project(place_, x, y));
  }

  cv::Matx33d place_ = omr::test::boardHomography(ROWS, COLS, {240, 190}, 34, 5);
  Render render_{{480, 380}, GREY};
  std::array<omr::SideEvidence, 4> sides_;
  int last_column_seen_ = ROWS;  // corners of it
};
}  // namespace

TEST_F(SizeCertainty, aNarrowMarginIsTheEnd)
{
  EXPECT_TRUE(isCertain());
  sides_[omr::left] = omr::SideEvidence::doubtful_border;
  EXPECT_FALSE(isCertain());
}

TEST_F(SizeCertainty, aLineOfWhichNoCornerIsSeenIsNoEnd)
{
  sides_.fill(omr::SideEvidence::border);
  last_column_seen_ = 1;
  EXPECT_TRUE(isCertain());
  last_column_seen_ = 0;
  EXPECT_FALSE(isCertain());
}

TEST_F(SizeCertainty, squaresCutOnBothSidesAreTheEnd)
{
  cut(0.45, 0.5);
  EXPECT_TRUE(isCertain());
}

TEST_F(SizeCertainty, squaresCutOnOneSideMayGoOnBelowAThing)
{
  cut(0, 0.5);
  EXPECT_FALSE(isCertain());
}

TEST_F(SizeCertainty, aGreyThingIsNoMargin)
{
  cover(COLS - 2, COLS + 2, cv::Scalar::all(120));
  EXPECT_FALSE(isCertain(COLS - 2));
}

TEST_F(SizeCertainty, aSheetLaidAslantThatPassesForTheMarginIsNoEnd)
{
  sides_.fill(omr::SideEvidence::border);
  const auto is_certain_below_sheet = [this](double top, double bottom) {
    render_ = Render({480, 380}, GREY);
    render_.addBoard(ROWS, COLS, place_, true, 0.15);
    render_.addPolygon({at(top, -0.1), at(COLS + 2, -0.1), at(COLS + 2, ROWS + 0.1), at(bottom, ROWS + 0.1)}, WHITE);
    return isCertain(COLS - 2);
  };
  EXPECT_TRUE(is_certain_below_sheet(COLS - 2, COLS - 2)) << "nobody can tell";
  EXPECT_FALSE(is_certain_below_sheet(COLS - 2, COLS - 1.6)) << "slivers of the next squares";
  EXPECT_FALSE(is_certain_below_sheet(COLS - 2.7, COLS - 2)) << "squares cut aslant";
}

TEST_F(SizeCertainty, anEdgeThatDoesNotRunAlongTheBoardIsNoMargin)
{
  render_.addPolygon({at(COLS - 2.25, -2), at(COLS + 2, -2), at(COLS + 2, ROWS + 2), at(COLS - 1.75, ROWS + 2)}, WHITE);
  EXPECT_FALSE(isCertain(COLS - 2));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
