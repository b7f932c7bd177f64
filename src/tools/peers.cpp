#include "peers.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#ifdef OUTDOOR_OMR_HAS_APRILTAG
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#endif
#ifdef OUTDOOR_OMR_HAS_MRGINGHAM
#include <mrgingham/mrgingham.hh>
#endif

namespace omr
{
namespace
{
cv::Mat greyOf(const cv::Mat& image)
{
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

#ifdef OUTDOOR_OMR_HAS_APRILTAG
constexpr int APRILTAG_THREADS = 2;

std::function<void()> prepareAprilTag(const cv::Mat& image)
{
  const std::shared_ptr<apriltag_family_t> family(tag36h11_create(), tag36h11_destroy);
  const std::shared_ptr<apriltag_detector_t> detector(apriltag_detector_create(), [family](apriltag_detector_t* old) {
    apriltag_detector_destroy(old);  // before its family
  });
  apriltag_detector_add_family(detector.get(), family.get());
  detector->quad_decimate = 1;
  detector->nthreads = APRILTAG_THREADS;
  return [=, grey = greyOf(image)] {
    image_u8_t view = {grey.cols, grey.rows, static_cast<int32_t>(grey.step), grey.data};
    apriltag_detections_destroy(apriltag_detector_detect(detector.get(), &view));
  };
}
#endif

#ifdef OUTDOOR_OMR_HAS_MRGINGHAM
std::function<void()> prepareMrgingham(const cv::Mat& image, int corners)
{
  return [=, grey = greyOf(image)] {
    std::vector<mrgingham::PointDouble> points;
    signed char* levels = nullptr;
    mrgingham::find_chessboard_from_image_array(points, &levels, corners, grey);
    std::free(levels);
  };
}
#endif
}  // namespace

Contestant gaussianPeer(int size)
{
  return {"cv::GaussianBlur", [size](const cv::Mat& image) {
            return [=, blurred = cv::Mat()]() mutable {
              cv::GaussianBlur(image, blurred, {size, size}, 0, 0, cv::BORDER_REPLICATE);
            };
          }};
}

Contestant medianPeer(int size)
{
  return {"cv::medianBlur", [size](const cv::Mat& image) {
            return [=, blurred = cv::Mat()]() mutable { cv::medianBlur(image, blurred, size); };
          }};
}

Contestant sobelPeer()
{
  return {"cv::Sobel twice", [](const cv::Mat& image) {
            return [=, gx = cv::Mat(), gy = cv::Mat()]() mutable {
              cv::Sobel(image, gx, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
              cv::Sobel(image, gy, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
            };
          }};
}

Contestant componentsPeer(const EdgesOf& edges_of)
{
  return {"cv::connectedComponents", [edges_of](const cv::Mat& image) {
            return [open = cv::Mat(edges_of(image) == 0), labels = cv::Mat()]() mutable {
              cv::connectedComponents(open, labels, 4);
            };
          }};
}

Contestant componentsWithStatsPeer(const EdgesOf& edges_of)
{
  return {"cv::connectedComponentsWithStats", [edges_of](const cv::Mat& image) {
            return
                [open = cv::Mat(edges_of(image) == 0), labels = cv::Mat(), stats = cv::Mat(),
                 centers = cv::Mat()]() mutable { cv::connectedComponentsWithStats(open, labels, stats, centers, 4); };
          }};
}

Contestant chainPeer(const EdgesOf& edges_of)
{
  return {"OpenCV's chain", [edges_of](const cv::Mat& image) {
            return [=, blur = gaussianPeer(3).prepare(image), sobel = sobelPeer().prepare(image),
                    components = componentsWithStatsPeer(edges_of).prepare(image)] {
              blur();
              sobel();
              components();
            };
          }};
}

Contestant memcpyPeer()
{
  return {"memcpy", [](const cv::Mat& image) {
            return [=, copy = image.clone()]() mutable {
              std::memcpy(copy.data, image.data, image.total() * image.elemSize());
            };
          }};
}

std::vector<Contestant> detectorPeers(const cv::Size& squares)
{
  const cv::Size corners(squares.width - 1, squares.height - 1);
  std::vector<Contestant> peers = {{"cv::findChessboardCornersSB", [corners](const cv::Mat& image) {
                                      return [=, grey = greyOf(image), found = std::vector<cv::Point2f>()]() mutable {
                                        cv::findChessboardCornersSB(grey, corners, found);
                                      };
                                    }}};
#ifdef OUTDOOR_OMR_HAS_MRGINGHAM
  peers.push_back({"mrgingham", [longer = std::max(corners.width, corners.height)](const cv::Mat& image) {
                     return prepareMrgingham(image, longer);
                   }});
#endif
#ifdef OUTDOOR_OMR_HAS_APRILTAG
  peers.push_back({"AprilTag 3", prepareAprilTag});
#endif
  return peers;
}

}  // namespace omr
