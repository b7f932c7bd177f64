#include "targets/family/bent_sheet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "targets/family/bent_distances.h"
#include "targets/family/bent_point.h"

using omr::BentSheet;
using omr::RingFamily;

namespace
{
RingFamily bentFamily()
{
  RingFamily family;
  omr::familyFromMoments({320.3, 240.7}, 900, 200, 500, family);
  family.hx = .0005;
  family.hy = -.0003;
  family.bend = {.007, .004};
  family.normal = {-.2, .5};
  family.hz = .0004;
  return family;
}

/** Places on the sheet, the last ones where it goes on straight. */
std::size_t somePlaces(BentSheet::Points& places)
{
  constexpr std::size_t SIZE = 40;
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    const double radius = 6. * static_cast<double>(i + 1);
    places.x[i] = radius * std::cos(2.4 * static_cast<double>(i));
    places.y[i] = radius * std::sin(2.4 * static_cast<double>(i));
  }
  return SIZE;
}

constexpr double STRAIGHT = 170;  // px from the centre; where the sheet may be straight
}  // namespace

TEST(BentSheet, saysOfManyPointsWhatTheFamilySaysOfOne)
{
  const RingFamily family = bentFamily();
  const BentSheet sheet(family);
  BentSheet::Points places;
  BentSheet::Points image;
  BentSheet::Points gradients;
  const std::size_t size = somePlaces(places);
  sheet.toImage(places, size, image);
  sheet.gradients(places, size, gradients);
  for (std::size_t i = 0; i < size; ++i)
  {
    const cv::Point2d q(places.x[i], places.y[i]);
    EXPECT_NEAR(0, cv::norm(family.toImage(q) - cv::Point2d(image.x[i], image.y[i])), 1e-9);
    const cv::Point2d gradient = family.radiusGradient(q);
    EXPECT_NEAR(0, cv::norm(gradient - cv::Point2d(gradients.x[i], gradients.y[i])), 1e-9 * cv::norm(gradient));
  }
}

TEST(BentSheet, findsThePlacesOfAnImage)
{
  const RingFamily family = bentFamily();
  const BentSheet sheet(family);
  BentSheet::Points places;
  BentSheet::Points image;
  std::size_t size = somePlaces(places);
  for (; std::hypot(places.x[size - 1], places.y[size - 1]) > STRAIGHT; --size)
  {
  }
  sheet.toImage(places, size, image);
  BentSheet::Points found = places;
  for (std::size_t i = 0; i < size; ++i)
  {
    found.x[i] *= 1.1;
    found.y[i] -= 5;
  }
  sheet.toPlane(image, size, found);
  for (std::size_t i = 0; i < size; ++i)
  {
    EXPECT_NEAR(places.x[i], found.x[i], 1e-4);
    EXPECT_NEAR(places.y[i], found.y[i], 1e-4);
  }
}

TEST(BentSheet, derivativesAreThoseOfTheDistance)
{
  constexpr double STEP = 1e-6;  // of each unknown
  const RingFamily family = bentFamily();
  BentSheet::Points places;
  const std::size_t size = somePlaces(places);
  std::vector<cv::Point2d> qs;
  for (std::size_t i = 0; i < size; ++i)
  {
    qs.emplace_back(places.x[i], places.y[i]);
  }
  std::vector<omr::BentRow> rows;
  omr::differentiateBent(qs, family, rows);
  for (std::size_t i = 0; i < size; ++i)
  {
    const cv::Point2d gradient = family.radiusGradient(qs[i]);
    for (int k = 0; k < omr::BENT_UNKNOWNS; ++k)
    {
      const auto image = [&](double step) {
        RingFamily moved = family;
        double* const unknowns[] = {&moved.center.x, &moved.center.y, &moved.a,        &moved.b,
                                    &moved.d,        &moved.hx,       &moved.hy,       &moved.bend.x,
                                    &moved.bend.y,   &moved.normal.x, &moved.normal.y, &moved.hz};
        *unknowns[k] += step;
        return moved.toImage(qs[i]);
      };
      const cv::Point2d move = (image(STEP) - image(-STEP)) / (2 * STEP);
      const double expected = -gradient.dot(move) / cv::norm(gradient);
      EXPECT_NEAR(expected, rows[i][k], 1e-3 + 1e-4 * std::abs(expected)) << "unknown " << k << ", place " << qs[i];
    }
    EXPECT_NEAR(-1 / cv::norm(gradient), rows[i][omr::BENT_UNKNOWNS], 1e-9);
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
