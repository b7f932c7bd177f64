#include "checkerboards/lattice/lattice_extent.h"

#include <gtest/gtest.h>

#include "checkerboards/lattice/border.h"
#include "checkerboards/lattice/lattice.h"
#include "checkerboards/lattice/lattice_gaps.h"
#include "lattices.h"
#include "render.h"

using omr::CornerLooker;
using omr::Frame;
using omr::Lattice;
using omr::LocalFrame;
using omr::test::Render;

TEST(LatticeExtent, aSingleCornerBeyondAWholeLineIsTheBackgrounds)
{
  const cv::Matx33d truth = omr::test::boardHomography(7, 10, {320, 240}, 36, 4, 20);
  const auto at = [&](double x, double y) { return omr::test::project(truth, x, y); };
  Render render({640, 480}, cv::Scalar::all(25));
  render.addBoard(7, 10, truth, true, 0.03);
  // With the black square (0, 4), the white one above and the dark ground it alternates around (0, 4), once.
  render.addPolygon({at(-1.2, 4), at(-0.03, 4), at(-0.03, 8), at(-1.2, 8)}, cv::Scalar::all(230));
  const cv::Mat picture = render.picture();
  const Frame frame = omr::makeFrame(picture);
  CornerLooker looker(frame, 10000);
  const LocalFrame seed{at(5, 3), at(6, 3) - at(5, 3), at(5, 4) - at(5, 3)};
  Lattice lattice = omr::test::grow(looker, seed);
  ASSERT_EQ(cv::Size(10, 6), lattice.box.size()) << "nothing of the background resembles a corner";
  settleExtent(lattice, looker);
  EXPECT_EQ(cv::Size(9, 6), lattice.box.size());
}

TEST(LatticeExtent, aSingleCornerOnPlainGroundEndsNoBoard)
{
  const cv::Matx33d truth = omr::test::boardHomography(7, 10, {320, 240}, 36, 4);
  const auto at = [&](double x, double y) { return omr::test::project(truth, x, y); };
  const auto add = [&](Render& render, double x0, double x1, double y0, double y1, const cv::Scalar& color) {
    render.addPolygon({at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)}, color);
  };
  Render render({640, 480}, cv::Scalar::all(230));
  render.addBoard(7, 10, truth);
  // The rim squares are cut, so no outer corner shows where the false one lies, which a dark thing draws beside a line
  // that is not whole.
  add(render, -2, 0.3, 0, 4, cv::Scalar::all(230));
  add(render, -2, 0.3, 5, 7, cv::Scalar::all(230));
  add(render, -2, 1, 2, 3, cv::Scalar::all(230));
  add(render, -3, 0, 3, 4, cv::Scalar::all(20));
  const Frame frame = omr::makeFrame(render.picture());
  CornerLooker looker(frame, 10000);
  const LocalFrame seed{at(5, 3), at(6, 3) - at(5, 3), at(5, 4) - at(5, 3)};
  Lattice lattice = omr::test::grow(looker, seed);
  ASSERT_EQ(cv::Size(10, 6), lattice.box.size());
  const auto sides = settleExtent(lattice, looker);
  EXPECT_EQ(cv::Size(10, 6), lattice.box.size());
  EXPECT_EQ(omr::SideEvidence::none, sides[omr::left]);
}

TEST(LatticeExtent, aBorderIsJudgedByAllOfItsPlaces)
{
  const cv::Matx33d truth = omr::test::boardHomography(7, 11, {320, 240}, 36, 4);
  const auto at = [&](double x, double y) { return omr::test::project(truth, x, y); };
  Render render({640, 480}, cv::Scalar::all(90));
  render.addBoard(7, 11, truth);
  const auto cover = [&](double x0, double x1, double y0, double y1) {
    render.addPolygon({at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)}, cv::Scalar(40, 150, 200));
  };
  cover(0.5, 3.4, -2, 9);     // three lines of corners, beyond which the left border is seen
  cover(6.5, 9.5, -2, 0.55);  // half of the upper border beside them
  cover(-2, 0.5, -2, 0.5);
  const Frame frame = omr::makeFrame(render.picture());
  CornerLooker looker(frame, 10000);
  const LocalFrame seed{at(6, 3), at(7, 3) - at(6, 3), at(6, 4) - at(6, 3)};
  Lattice lattice = omr::test::grow(looker, seed);
  ASSERT_EQ(cv::Size(7, 6), lattice.box.size());
  ASSERT_TRUE(omr::lookAtBorder(lattice, frame, omr::top, 1).ends());
  const auto sides = settleExtent(lattice, looker);
  ASSERT_EQ(cv::Size(10, 6), lattice.box.size());
  EXPECT_EQ(omr::SideEvidence::border, sides[omr::left]);
  EXPECT_EQ(omr::SideEvidence::rim, sides[omr::top]);
}

TEST(LatticeExtent, aLineAcrossWhichSquaresGoOnIsNoBorder)
{
  const cv::Matx33d truth = omr::test::boardHomography(6, 12, {320, 240}, 36, 4);
  const auto at = [&](double x, double y) { return omr::test::project(truth, x, y); };
  Render render({640, 480}, cv::Scalar::all(90));
  render.addBoard(6, 12, truth);
  render.addPolygon({at(-0.5, 5), at(8.5, 5), at(8.5, 9), at(-0.5, 9)},
                    cv::Scalar::all(215));  // as light as the margin
  const Frame frame = omr::makeFrame(render.picture());
  CornerLooker looker(frame, 10000);
  const LocalFrame seed{at(5, 3), at(6, 3) - at(5, 3), at(5, 4) - at(5, 3)};
  Lattice lattice = omr::test::grow(looker, seed);
  const auto sides = settleExtent(lattice, looker);
  ASSERT_EQ(cv::Size(11, 4), lattice.box.size());
  EXPECT_GE(omr::lookAtBorder(lattice, frame, omr::bottom, 1).seen, 6);
  EXPECT_FALSE(omr::lookAtBorder(lattice, frame, omr::bottom, 1).ends());
  EXPECT_EQ(omr::SideEvidence::none, sides[omr::bottom]);
  EXPECT_EQ(omr::SideEvidence::border, sides[omr::top]);
}

TEST(LatticeGaps, aClearLatticeGoesOnBehindAWideThing)
{
  const cv::Matx33d truth = omr::test::boardHomography(6, 10, {320, 240}, 30, 12, 10);
  const auto at = [&](double x, double y) { return omr::test::project(truth, x, y); };
  Render render({640, 480});
  render.addBoard(6, 10, truth);
  render.addPolygon({at(3.3, -3), at(7.3, -3), at(7.7, 9), at(3.7, 9)}, {40, 150, 200});  // over four lines of corners
  const Frame frame = omr::makeFrame(render.picture());
  CornerLooker looker(frame, 10000);
  const LocalFrame seed{at(2, 3), at(3, 3) - at(2, 3), at(2, 4) - at(2, 3)};
  Lattice lattice = omr::test::grow(looker, seed);
  ASSERT_EQ(cv::Size(3, 5), lattice.box.size());
  jumpGaps(lattice, looker);
  EXPECT_EQ(cv::Size(9, 5), lattice.box.size());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
