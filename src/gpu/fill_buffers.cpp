#include "fill_buffers.h"

#include <algorithm>

#include "outdoor_omr/region.h"

namespace omr
{
static_assert(sizeof(RegionSums) == 104, "kernels/record.cl has the same layout");

namespace
{
/** Records at the start: a busy photograph of 1080p has 38000 regions. */
constexpr cl_uint FIRST_RECORDS = 65536;
constexpr cl_uint FIRST_REPORTED = 16384;

/** Room for a quarter more than was needed, so that a growing scene does not grow the buffer in every frame. */
cl_uint withMargin(cl_uint count)
{
  return count + count / 4;
}
}  // namespace

void GrowingBuffer::reserve(const cl::Context& context, std::size_t count, std::size_t element_size)
{
  const std::size_t bytes = std::max<std::size_t>(count, 1) * element_size;
  if (bytes > bytes_)
  {
    buffer_ = cl::Buffer();  // frees the old one first
    bytes_ = 0;
    buffer_ = cl::Buffer(context, CL_MEM_READ_WRITE, bytes);
    bytes_ = bytes;
  }
}

void FillBuffers::reserve(const cl::Context& context, const cv::Size& size, const Strips& strips)
{
  const std::size_t height = size.height;
  const std::size_t words = height * divideUp(size.width, 64);
  const std::size_t all_runs = height * divideUp(size.width, 2);
  const std::size_t strip_count = strips.count(size.height);
  filtered.reserve(context, height * size.width, 3);
  mask.reserve(context, words, sizeof(cl_ulong));
  runs.reserve(context, all_runs, 2 * sizeof(cl_ushort));
  row_first.reserve(context, height, sizeof(cl_int));
  row_runs.reserve(context, height, sizeof(cl_int));
  rank.reserve(context, words, sizeof(cl_ushort));
  run_slot.reserve(context, all_runs, sizeof(cl_int));
  parent.reserve(context, all_runs, sizeof(cl_int));
  slot_label.reserve(context, all_runs, sizeof(cl_int));
  slot_record.reserve(context, all_runs, sizeof(cl_int));
  strip_slots.reserve(context, strip_count, sizeof(cl_int));
  strip_reports.reserve(context, strip_count, sizeof(cl_uint));
  counters.reserve(context, 1, sizeof(Counters));
  if (strips.united)
  {
    scratch.reserve(context, strip_count * (size.width + 1 + divideUp(size.width, 64)), sizeof(cl_ulong));
  }
  reserveRecords(context, record_capacity == 0 ? FIRST_RECORDS : 0);
  reserveReported(context, reported_capacity == 0 ? FIRST_REPORTED : 0);
}

void FillBuffers::reserveRecords(const cl::Context& context, cl_uint count)
{
  if (count > record_capacity)
  {
    record_capacity = 0;  // nothing is left when the device has no room
    records.reserve(context, withMargin(count), sizeof(RegionSums));
    record_capacity = withMargin(count);
  }
}

void FillBuffers::reserveReported(const cl::Context& context, cl_uint count)
{
  if (count > reported_capacity)
  {
    reported_capacity = 0;  // nothing is left when the device has no room
    reported.reserve(context, withMargin(count), sizeof(RegionSums));
    reported_capacity = withMargin(count);
  }
}

}  // namespace omr
