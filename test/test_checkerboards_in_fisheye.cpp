#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "checkerboards/checkerboards.h"
#include "checkerboards/lattice/corners.h"
#include "checkerboards/lattice/lattice_extent.h"
#include "lattices.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "render.h"

using omr::Checkerboard;
using omr::Lattice;
using omr::test::Render;

namespace
{
/** An equidistant lens beside the pinhole camera that the renderer has: as far from the middle as the ray's angle. */
class Fisheye
{
 public:
  /** @param angle to the axis, of a ray through the middle of the pinhole picture's left side [degrees] */
  Fisheye(const cv::Size& size, double angle)
      : middle_((size.width - 1) / 2., (size.height - 1) / 2.), focal_(middle_.x / std::tan(angle * CV_PI / 180))
  {
  }

  cv::Point2d fromPinhole(const cv::Point2d& point) const
  {
    const cv::Point2d offset = point - middle_;
    const double distance = std::max(1e-9, cv::norm(offset));
    return middle_ + offset * (focal_ * std::atan(distance / focal_) / distance * MAGNIFICATION);
  }

  cv::Mat bend(const cv::Mat& picture) const
  {
    cv::Mat map(picture.size(), CV_32FC2);
    for (int y = 0; y < map.rows; ++y)
    {
      for (int x = 0; x < map.cols; ++x)
      {
        const cv::Point2d offset = cv::Point2d(x, y) - middle_;
        const double distance = std::max(1e-9, cv::norm(offset));
        const double angle = std::min(1.5, distance / focal_ / MAGNIFICATION);
        map.at<cv::Point2f>(y, x) = middle_ + offset * (focal_ * std::tan(angle) / distance);
      }
    }
    cv::Mat bent;
    cv::remap(picture, bent, map, {}, cv::INTER_CUBIC, cv::BORDER_CONSTANT);
    return bent;
  }

 private:
  static constexpr double MAGNIFICATION = 1.6;  // the middle is drawn larger, so that the rim is not too small

  cv::Point2d middle_;
  double focal_;
};

std::vector<Checkerboard> find(const cv::Mat& picture)
{
  omr::RegionMap map;
  omr::FillPipeline("reference").run(picture, omr::Settings(), {}, map);
  return omr::findCheckerboards(omr::makeFrame(picture), map, omr::Settings());
}

/** Distance of a corner to the nearest true one [px]. */
double distanceToNearest(const cv::Point2f& corner, int rows, int cols, const cv::Matx33d& pinhole,
                         const Fisheye& fisheye)
{
  double least = 1e9;
  for (int i = 1; i < rows; ++i)
  {
    for (int j = 1; j < cols; ++j)
    {
      const cv::Point2d truth = fisheye.fromPinhole(omr::test::project(pinhole, j, i));
      least = std::min(least, cv::norm(cv::Point2d(corner) - truth));
    }
  }
  return least;
}

/** Of all inner corners of a board of 7 x 10 squares, where they are. */
Lattice latticeOf(const cv::Matx33d& pinhole, const Fisheye& fisheye)
{
  return omr::test::latticeOf(6, 9, [&](int col, int row) {
    return cv::Point2f(fisheye.fromPinhole(omr::test::project(pinhole, col + 1, row + 1)));
  });
}

const cv::Matx33d BOARD = omr::test::boardHomography(7, 10, {590, 440}, 85, 15);
}  // namespace

TEST(CheckerboardsInFisheye, boardsUpToItsRimAreFoundWithAllCorners)
{
  const cv::Size size(1200, 900);
  struct Case
  {
    int rows, cols;
    double angle, square, turn;
    cv::Point2d center;
  };
  for (const Case& one : {Case{5, 7, 72.7, 98.2, 10.6, {579, 408}},
                          {5, 7, 68.9, 113.7, 9.1, {582, 417}},
                          {7, 10, 70.2, 80.3, 28.5, {553, 410}},
                          {7, 10, 68.5, 89.8, 12.7, {592, 420}}})
  {
    const cv::Matx33d pinhole = omr::test::boardHomography(one.rows, one.cols, one.center, one.square, one.turn);
    Render render(size);
    render.addBoard(one.rows, one.cols, pinhole);
    const Fisheye fisheye(size, one.angle);
    const std::vector<Checkerboard> boards = find(fisheye.bend(render.picture()));
    ASSERT_EQ(1u, boards.size()) << one.angle;
    EXPECT_EQ(one.rows, boards[0].rows) << one.angle;
    EXPECT_EQ(one.cols, boards[0].cols) << one.angle;
    for (std::size_t i = 0; i < boards[0].inner_corners.size(); ++i)
    {
      // A prediction that the picture did not bear out was 35 px off, and said to be seen.
      EXPECT_TRUE(boards[0].inner_corners_seen[i]) << one.angle;
      EXPECT_LT(distanceToNearest(boards[0].inner_corners[i], one.rows, one.cols, pinhole, fisheye), 0.5) << one.angle;
    }
  }
}

TEST(CheckerboardsInFisheye, theSurfaceDropsWhatIsWrongAndNotWhatBends)
{
  const Fisheye fisheye({1200, 900}, 68);
  const cv::Matx33d tilted = omr::test::boardHomography(7, 10, {500, 380}, 85, 15, 40);
  Lattice whole = latticeOf(tilted, fisheye);  // two of its corners are none of a cubic's
  omr::dropOutliers(whole);
  EXPECT_EQ(54, whole.count());
  Lattice lattice = latticeOf(tilted, fisheye);
  lattice.at(Lattice::SEED + 2, Lattice::SEED + 4).position += cv::Point2f(25, -20);
  omr::dropOutliers(lattice);
  EXPECT_EQ(53, lattice.count());
  EXPECT_FALSE(lattice.found(Lattice::SEED + 2, Lattice::SEED + 4));
}

TEST(CheckerboardsInFisheye, aCornerWithoutFourSquaresIsNotSeen)
{
  const Fisheye fisheye({1200, 900}, 72);
  Render render({1200, 900});
  render.addBoard(7, 10, BOARD);
  const omr::Frame frame = omr::makeFrame(fisheye.bend(render.picture()));
  Lattice lattice = latticeOf(BOARD, fisheye);
  lattice.at(Lattice::SEED + 2, Lattice::SEED + 4).position =
      fisheye.fromPinhole(omr::test::project(BOARD, 5.4, 3));  // on the edge beside it
  const std::vector<bool> seen = omr::refineCorners(frame, lattice);
  ASSERT_EQ(54u, seen.size());
  EXPECT_EQ(53, std::count(seen.begin(), seen.end(), true));
  EXPECT_FALSE(seen[2 * 9 + 4]);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
