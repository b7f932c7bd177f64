#ifndef OUTDOOR_OMR_GPU_WINDOW_BUFFERS_H
#define OUTDOOR_OMR_GPU_WINDOW_BUFFERS_H

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "fill_buffers.h"
#include "outdoor_omr/marker_network.h"

namespace omr
{
/** What the kernels of the preliminary detection keep on the device; the layouts are those of cells.cl, haar.cl and
 * network.cl. */
struct WindowBuffers
{
  std::array<GrowingBuffer, 2> sums;  ///< of the cells of a level and of the next one, in turn
  GrowingBuffer cells;                ///< three planes of the cells of a level
  GrowingBuffer logarithm;
  GrowingBuffer tables;
  GrowingBuffer weights;
  GrowingBuffer gate_weights;
  GrowingBuffer blocks;  ///< planes of the blocks of a level
  GrowingBuffer passes;  ///< of the windows of a level
  GrowingBuffer scores;

  MarkerNetwork network;  ///< whose weights the buffers hold

  /** Makes room for an image of at least one pixel. @throws cl::Error if there is none. */
  void reserve(const cl::Context& context, const cv::Size& size);

  std::size_t bytes() const;
};

/** The lookup tables of haar.cl: 40 shifts by length, crossings. */
std::vector<cl_uchar> packTables();

/** A network's weights in the order of network.cl. */
std::vector<cl_float> packWeights(const MarkerNetwork& network);
std::vector<cl_float> packGate(const FeedForward& gate);

}  // namespace omr

#endif
