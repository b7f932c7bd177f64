#include <gtest/gtest.h>

#include <algorithm>

#include "checkerboards/checkerboards.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

using omr::Checkerboard;
using omr::test::Render;

namespace
{
struct Found
{
  std::vector<Checkerboard> boards, sections;
};

Found find(const cv::Mat& picture)
{
  omr::RegionMap map;
  omr::FillPipeline("reference").run(picture, omr::Settings(), {}, map);
  Found found;
  found.boards = omr::findCheckerboards(omr::makeFrame(picture), map, omr::Settings(), nullptr, &found.sections);
  return found;
}

class BoardSections : public ::testing::Test
{
 protected:
  BoardSections()
  {
    render_.addBoard(7, 9, board_);
  }

  cv::Point2d at(double col, double row) const
  {
    return omr::test::project(board_, col, row);
  }

  /** Covers a rectangle of the board [squares]. */
  void cover(double left, double top, double right, double bottom)
  {
    render_.addPolygon({at(left, top), at(right, top), at(right, bottom), at(left, bottom)}, cv::Scalar(60, 90, 120));
  }

  cv::Matx33d board_ = omr::test::boardHomography(7, 9, {300, 220}, 25, 10, 20);
  Render render_{cv::Size(600, 440)};
};
}  // namespace

TEST_F(BoardSections, hiddenOnTwoSidesABoardIsASection)
{
  cover(4.6, -2, 12, 4.4);
  cover(6.6, -2, 12, 10);
  const Found found = find(render_.picture());
  EXPECT_TRUE(found.boards.empty());
  ASSERT_EQ(1U, found.sections.size());
  const Checkerboard& section = found.sections[0];
  EXPECT_FALSE(section.size_certain);
  ASSERT_EQ(static_cast<std::size_t>((section.rows - 1) * (section.cols - 1)), section.inner_corners.size());
  int seen = 0;
  for (std::size_t i = 0; i < section.inner_corners.size(); ++i)
  {
    double nearest = 1e9;
    for (int row = 1; row < 7; ++row)
    {
      for (int col = 1; col < 9; ++col)
      {
        nearest = std::min(nearest, cv::norm(section.inner_corners[i] - cv::Point2f(at(col, row))));
      }
    }
    if (section.inner_corners_seen[i])
    {
      ++seen;
      EXPECT_LT(nearest, 0.15);
    }
  }
  EXPECT_GE(seen, 24);
}

TEST_F(BoardSections, aBoardIsNone)
{
  const Found found = find(render_.picture());
  EXPECT_EQ(1U, found.boards.size());
  EXPECT_TRUE(found.sections.empty());
}

TEST_F(BoardSections, fewCornersAreNone)
{
  cover(3.5, -2, 12, 10);
  cover(-3, 3.5, 12, 10);
  const Found found = find(render_.picture());
  EXPECT_TRUE(found.boards.empty());
  EXPECT_TRUE(found.sections.empty());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
