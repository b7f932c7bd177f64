#ifndef OUTDOOR_OMR_GPU_FILL_BUFFERS_H
#define OUTDOOR_OMR_GPU_FILL_BUFFERS_H

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "opencl.h"

namespace omr
{
inline int divideUp(int a, int b)
{
  return (a + b - 1) / b;
}

/** How the runs are cut into pieces of work, see kernels/runs.cl. */
struct Strips
{
  int rows = 1;         ///< rows of a strip
  bool united = false;  ///< one lane unites the runs of a strip without atomics (CPU); else every run is a slot
  int count(int height) const
  {
    return divideUp(height, rows);
  }
};

/** The counters of one image: the struct Counters of kernels/record.cl. */
struct Counters
{
  cl_uint records = 0;
  cl_uint regions = 0;
  cl_uint reported = 0;
  cl_uint changed = 0;
};

/** Images in a row that need less than a quarter of a buffer before it shrinks: some seconds of video. */
constexpr int PATIENCE = 100;

/** A device buffer that grows at once and shrinks when it has been far too large for many images. */
class GrowingBuffer
{
 public:
  /**
   * Makes room for count elements of a size, once an image; the content is lost when the size changes.
   */
  void reserve(const cl::Context& context, std::size_t count, std::size_t element_size);

  /** The same any number of times; never shrinks. */
  void grow(const cl::Context& context, std::size_t count, std::size_t element_size);

  /** Once an image, before the first use: many images without any use free it. */
  void rest();

  void free();

  const cl::Buffer& operator*() const
  {
    return buffer_;
  }

  std::size_t bytes() const
  {
    return bytes_;
  }

 private:
  cl::Buffer buffer_;
  std::size_t bytes_ = 0;
  int spacious_images_ = 0;  // in a row
  int idle_images_ = 0;      // in a row
};

/** Frees a vector that has room for more elements than are enough; its content is lost. */
template <typename T>
void giveBack(std::vector<T>& elements, std::size_t enough)
{
  if (elements.capacity() > enough)
  {
    std::vector<T>().swap(elements);
  }
}

/** What the kernels keep on the device between two steps; the layouts are those of kernels/runs.cl and merge.cl. */
struct FillBuffers
{
  GrowingBuffer filtered;       ///< H x W x 3 bytes
  GrowingBuffer strength;       ///< strongest edge response of each tile, see kernels/edges.cl
  GrowingBuffer mask;           ///< 1 bit a pixel, see kernels/mask.cl
  GrowingBuffer runs;           ///< start and end of every run
  GrowingBuffer row_first;      ///< of each row: its first run
  GrowingBuffer row_runs;       ///< of each row: number of runs
  GrowingBuffer rank;           ///< of each word: runs of the row before it
  GrowingBuffer run_slot;       ///< of each run: its slot
  GrowingBuffer parent;         ///< of each slot: union-find parent
  GrowingBuffer slot_label;     ///< of each slot: its first pixel
  GrowingBuffer slot_record;    ///< of each slot: its record
  GrowingBuffer strip_slots;    ///< of each strip: number of slots
  GrowingBuffer strip_reports;  ///< of each strip: records in the window of areas
  GrowingBuffer scratch;        ///< of each strip: channel sums and outline of a row
  GrowingBuffer counters;
  GrowingBuffer records;   ///< of regions or of their parts
  GrowingBuffer reported;  ///< records in the window of areas

  /**
   * Makes room for an image, and for as many records as the last ones needed.
   *
   * @param may_shrink false: what is larger stays, however often.
   * @throws cl::Error if there is none.
   */
  void reserve(const cl::Context& context, const cv::Size& size, const Strips& strips, bool may_shrink);

  /** Room for records, after an image that needs more than there is. */
  void growRecords(const cl::Context& context, cl_uint count);
  void growReported(const cl::Context& context, cl_uint count);

  /** What the image needed: the next ones will need about as many, or where may_shrink is false no less than before. */
  void needed(const Counters& counters, bool may_shrink);

  cl_uint recordCapacity() const;
  cl_uint reportedCapacity() const;
  std::size_t bytes() const;

 private:
  cl_uint needed_records_ = 0;
  cl_uint needed_reported_ = 0;
};

}  // namespace omr

#endif
