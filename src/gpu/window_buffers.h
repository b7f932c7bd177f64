#ifndef OUTDOOR_OMR_GPU_WINDOW_BUFFERS_H
#define OUTDOOR_OMR_GPU_WINDOW_BUFFERS_H

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "fill_buffers.h"
#include "outdoor_omr/marker_network.h"

namespace omr
{
/** Where the cells and windows of a level lie: the struct Level of kernels/levels.cl. */
struct WindowLevel
{
  cl_uint first_cell = 0;
  cl_int cells_across = 0, cells_down = 0;
  cl_uint first_window = 0;
  cl_int windows_across = 0, windows_down = 0;
};

/** Of all HAAR_LEVELS; those without a window have none. */
std::vector<WindowLevel> windowLevels(const cv::Size& size);

/** Lengths of the lists of windows: the struct Lists of kernels/levels.cl. */
struct WindowLists
{
  cl_uint likely = 0;
  cl_uint beside = 0;
};

/** What the kernels of the preliminary detection keep on the device; the layouts are those of the kernels. */
struct WindowBuffers
{
  GrowingBuffer levels;
  std::array<GrowingBuffer, 2> sums;  ///< of the cells of a level and of the next one, in turn
  GrowingBuffer cells;
  GrowingBuffer logarithm;
  GrowingBuffer tables;
  GrowingBuffer weights;
  GrowingBuffer gate_weights;
  GrowingBuffer blocks;  ///< planes of the blocks of a level
  GrowingBuffer lists;   ///< their lengths
  GrowingBuffer likely;  ///< windows
  GrowingBuffer beside;
  GrowingBuffer scores;

  bool has_tables = false;  ///< the buffers hold them
  MarkerNetwork network;    ///< whose weights the buffers hold
  cv::Size size;            ///< of the image whose levels they hold

  /** Makes room for an image of at least one pixel. @throws cl::Error if there is none. */
  void reserve(const cl::Context& context, const cv::Size& size);

  std::size_t bytes() const;
};

/** The lookup tables of haar.cl: 40 shifts by length, crossings. */
std::vector<cl_uchar> packTables();

/** A network's weights in the order of network.cl and gate.cl. */
std::vector<cl_float> packWeights(const MarkerNetwork& network);
std::vector<cl_float> packGate(const FeedForward& gate);

}  // namespace omr

#endif
