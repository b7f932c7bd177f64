// What no pipeline takes is refused before a thread looks at it, and the detector goes on.

#include <gtest/gtest.h>

#include <stdexcept>

#include "outdoor_omr/detector.h"

TEST(RefusedImages, leaveTheDetectorFitForOthers)
{
  omr::Detector detector("reference");
  const omr::Settings settings;
  const int cube[] = {40, 40, 40};
  for (const cv::Mat& image : {cv::Mat(), cv::Mat(3, cube, CV_8UC3, cv::Scalar::all(90)), cv::Mat(40, 40, CV_8UC1),
                               cv::Mat(40, 40, CV_16UC3), cv::Mat(40, 70000, CV_8UC3, cv::Scalar::all(90))})
  {
    EXPECT_THROW(detector.detect(image, settings), std::invalid_argument) << image.dims << " " << image.size();
  }
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(200, 1), cv::Size(1, 200), cv::Size(40, 40)})
  {
    const omr::Markers markers = detector.detect(cv::Mat(size, CV_8UC3, cv::Scalar::all(90)), settings);
    EXPECT_TRUE(markers.checkerboards.empty() && markers.targets.empty()) << size;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
