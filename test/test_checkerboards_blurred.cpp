#include <gtest/gtest.h>

#include "checkerboards/checkerboards.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

TEST(Checkerboards, findsLargeSquaresBlurredOverAFifthOfTheirSides)
{
  for (const double square : {50., 80.})  // px
  {
    const double width = 11 * square;
    const double height = 9 * square;
    omr::test::Render render({cvRound(width), cvRound(height)});
    render.addBoard(5, 7, omr::test::boardHomography(5, 7, {width / 2, height / 2}, square, 5), true, 0.5);
    const cv::Mat picture = 0.65 * render.picture(square / 5);
    omr::RegionMap map;
    omr::FillPipeline("reference").run(picture, omr::Settings(), {}, map);
    const auto boards = omr::findCheckerboards(omr::makeFrame(picture), map, omr::Settings());
    ASSERT_EQ(1U, boards.size()) << square;
    EXPECT_EQ(5, boards[0].rows) << square;
    EXPECT_EQ(7, boards[0].cols) << square;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
