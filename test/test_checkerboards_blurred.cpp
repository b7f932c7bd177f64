#include <gtest/gtest.h>

#include "checkerboards/checkerboards.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

TEST(Checkerboards, findsLargeSquaresBlurredOverAFifthOfTheirSides)
{
  constexpr double SQUARE = 50;  // px
  omr::test::Render render({560, 460});
  render.addBoard(5, 7, omr::test::boardHomography(5, 7, {280, 230}, SQUARE, 5), true, 0.5);
  const cv::Mat picture = 0.65 * render.picture(SQUARE / 5);
  omr::RegionMap map;
  omr::FillPipeline("reference").run(picture, omr::Settings(), {}, map);
  const auto boards = omr::findCheckerboards(omr::makeFrame(picture), map, omr::Settings());
  ASSERT_EQ(1U, boards.size());
  EXPECT_EQ(5, boards[0].rows);
  EXPECT_EQ(7, boards[0].cols);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
