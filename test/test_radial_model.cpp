#include "checkerboards/lattice/radial_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "checkerboards/lattice/lattice.h"
#include "lattices.h"

using omr::CornerLook;
using omr::Lattice;
using omr::LocalFrame;
using omr::RadialModel;

namespace
{
const cv::Size PICTURE(1280, 960);

/** Where an equidistant fisheye with its axis through the middle of the picture sees a node of a tilted board. */
cv::Point2f seenBy(double focal_px, int col, int row)
{
  const cv::Point3d point(0.3 * (col - 4), 0.3 * (row - 2), 1 + 0.05 * col);
  const double across = std::hypot(point.x, point.y);
  const double scale = across > 0 ? focal_px * std::atan2(across, point.z) / across : 0;
  return {static_cast<float>((PICTURE.width - 1) / 2. + scale * point.x),
          static_cast<float>((PICTURE.height - 1) / 2. + scale * point.y)};
}

/** @param rows, cols of its corners, the rest of the board is not found yet. */
Lattice latticeSeen(int rows, int cols, double focal_px)
{
  return omr::test::latticeOf(rows, cols, [&](int col, int row) { return seenBy(focal_px, col, row); });
}
}  // namespace

TEST(RadialModel, forecastsWhereAFisheyeShowsTheRestOfTheBoard)
{
  constexpr double FOCAL_PX = 400;
  RadialModel model;
  ASSERT_TRUE(model.fit(latticeSeen(5, 4, FOCAL_PX), PICTURE));
  for (int row = 0; row < 5; ++row)
  {
    for (int col = 4; col < 7; ++col)
    {
      LocalFrame frame;
      ASSERT_TRUE(model.frameAt(Lattice::SEED + row, Lattice::SEED + col, frame));
      EXPECT_LT(squaresBetween(frame, seenBy(FOCAL_PX, col, row)), 0.1) << row << " " << col;
      const cv::Point2f step = (seenBy(FOCAL_PX, col + 1, row) - seenBy(FOCAL_PX, col - 1, row)) / 2;
      EXPECT_NEAR(omr::length(frame.u) / omr::length(step), 1, 0.1) << row << " " << col;
    }
  }
}

TEST(RadialModel, isNoneOfCornersThatLieOtherwise)
{
  Lattice lattice = latticeSeen(5, 4, 400);
  CornerLook corner;
  corner.sign = 1;
  for (int row = 0; row < 5; ++row)
  {
    corner.position = lattice.at(Lattice::SEED + row, Lattice::SEED + 2).position;
    corner.position += cv::Point2f(row % 2 == 0 ? 40.F : -40.F, 0);
    lattice.put(Lattice::SEED + row, Lattice::SEED + 2, corner);
  }
  RadialModel model;
  EXPECT_FALSE(model.fit(lattice, PICTURE));
}

TEST(RadialModel, isNoneOfTooFewCorners)
{
  RadialModel model;
  EXPECT_FALSE(model.fit(latticeSeen(1, 1, 400), PICTURE));
  EXPECT_FALSE(model.fit(latticeSeen(1, 4, 400), PICTURE));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
