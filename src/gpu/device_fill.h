#ifndef OUTDOOR_OMR_GPU_DEVICE_FILL_H
#define OUTDOOR_OMR_GPU_DEVICE_FILL_H

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "device.h"
#include "fill_buffers.h"
#include "outdoor_omr/marker_network.h"
#include "outdoor_omr/reference_fill.h"
#include "outdoor_omr/region.h"
#include "outdoor_omr/settings.h"
#include "program.h"
#include "window_buffers.h"

namespace omr
{
/** Which kernels a device gets; the results are the same. */
enum class Geometry
{
  strips,  ///< CPU: a work-item takes a strip of rows
  words    ///< GPU: a work-item takes a pixel or a word of 64 pixels
};

/** Areas of the regions that are asked for [px], inclusive. */
struct AreaWindow
{
  cl_uint min = 1;
  cl_uint max = 0xffffffffU;
};

/**
 * The steps of the fill pipeline (device_fill.cpp: image to region mask; device_regions.cpp: mask to regions) on one
 * OpenCL device, to be called in the order of their declaration. A step enqueues its kernels and returns; what waits
 * says so. All may throw cl::Error.
 */
class DeviceFill
{
 public:
  /** Builds the kernels and runs each of them once. @throws DeviceError with the build log if they do not build. */
  DeviceFill(const Device& device, Geometry geometry);
  DeviceFill(const DeviceFill&) = delete;
  DeviceFill& operator=(const DeviceFill&) = delete;

  /**
   * Hands an image (CV_8UC3, not empty) to the device, which reads it until finish().
   *
   * @param is_enlargement of a part of the last image: the buffers stay as that one needs them.
   */
  void loadImage(const cv::Mat& bgr, bool is_enlargement = false);

  /**
   * Preliminary detection in the loaded image (device_windows.cpp), before it is filtered; waits where the network or
   * the image's size is another than the last one's. What it needs is freed after many images without.
   *
   * @param scores of all windows by the time of finish(), as windowScores() gives them.
   */
  void scoreWindows(const MarkerNetwork& network, std::vector<MarkerScores>& scores);

  void filter(Filter filter, int size);
  void findEdges(const EdgeThreshold& threshold);

  /** In the place of findEdges(): takes an edge mask (CV_8UC1, 0 = region) of the image's size; waits. */
  void loadEdges(const cv::Mat& edges);

  /**
   * Finds the regions; waits for each round of FillMethod::sweep.
   *
   * @param sweep_rounds after so many rounds of sweeps the runs take over.
   * @return             the method that gave the labels.
   */
  FillMethod labelRegions(FillMethod method, int sweep_rounds);

  /** Bring the labels (CV_32SC1) and the edge image (CV_8UC1) to the host by the time of finish(). */
  void readLabels(cv::Mat& labels);
  void readEdges(cv::Mat& edges);

  /**
   * Sums the region data; distances only for the regions in the window.
   *
   * @param measures false: colours, perimeter and distance are left at 0.
   */
  void sumRegions(const AreaWindow& window, bool measures = true);

  /**
   * Reads the sums of the regions in the window, ascending label; waits. When the image has more regions than the
   * buffers hold, they grow and sumRegions() is repeated.
   *
   * @return the number of all regions, in the window or not.
   */
  int readSums(std::vector<RegionSums>& sums);

  /** Bytes of all buffers on the device. */
  std::size_t bytes() const;

  /** Waits until all is done and lets go of the image. */
  void finish();

  /** The same after an error, further ones of which do not count. */
  void abandon();

  /** Device time of the steps since loadImage(), each with what precedes it [ms]; 0 for a step that did not run. */
  struct Times
  {
    double candidates = 0;
    double filter = 0;
    double edges = 0;
    double labels = 0;
  };
  Times times() const;

 private:
  template <typename... Arguments>
  void launch(const char* kernel, const Groups& groups, const Arguments&... arguments);
  template <typename Write>
  void readImage(cv::Mat& image, GrowingBuffer& buffer, const Write& write);
  void restUnused();
  void warmUp();
  void reserveWindows();
  void uploadWindows(const MarkerNetwork& network);
  void findCells(int level);
  void findRuns(const Strips& strips);
  bool sweep(int rounds);
  void mergeSeams();
  void findRegions();
  void sumDistances();
  void reportRegions();
  Strips stripsOfDevice() const;
  Groups rows() const;
  Groups strips() const;
  Groups words(int row_count) const;

  cl::Context context_;
  cl::CommandQueue queue_;
  Program program_;
  Geometry geometry_;
  bool shares_memory_;  ///< a CPU device works on the host's memory in place
  int compute_units_;
  FillBuffers buffers_;
  std::unique_ptr<WindowBuffers> windows_;  ///< null while there is no preliminary detection
  int images_without_windows_ = 0;          ///< in a row
  GrowingBuffer upload_, edge_image_, label_image_, sweep_labels_;
  cv::Mat bgr_;       ///< holds the pixels until finish()
  cl::Buffer image_;  ///< what the next step reads: the loaded or the filtered image
  cl_long step_ = 0;  ///< bytes from row to row of it
  bool is_enlargement_ = false;
  cv::Size size_;
  Strips strips_;
  AreaWindow window_;
  bool measures_ = true;
  cl_uint expected_reports_ = 64;
  cl::Event last_event_, loaded_, scored_, filtered_, edges_found_, labelled_;
};

template <typename... Arguments>
void DeviceFill::launch(const char* kernel, const Groups& groups, const Arguments&... arguments)
{
  last_event_ = program_.launch(queue_, kernel, groups, arguments...);
  if (loaded_() == nullptr)
  {
    loaded_ = last_event_;
  }
}

}  // namespace omr

#endif
