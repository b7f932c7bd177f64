#include "fill_buffers.h"

#include <algorithm>

#include "outdoor_omr/reference_fill.h"
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
std::size_t withMargin(cl_uint count, cl_uint least)
{
  return std::max(count + count / 4, least);
}
}  // namespace

void GrowingBuffer::reserve(const cl::Context& context, std::size_t count, std::size_t element_size)
{
  const std::size_t bytes = std::max<std::size_t>(count, 1) * element_size;
  spacious_images_ = bytes < bytes_ / 4 ? spacious_images_ + 1 : 0;
  if (bytes > bytes_ || spacious_images_ > PATIENCE)
  {
    buffer_ = cl::Buffer();  // frees the old one first
    bytes_ = 0;              // nothing is left when the device has no room
    buffer_ = cl::Buffer(context, CL_MEM_READ_WRITE, bytes);
    bytes_ = bytes;
    spacious_images_ = 0;
  }
}

void FillBuffers::reserve(const cl::Context& context, const cv::Size& size, const Strips& strips)
{
  const std::size_t height = size.height;
  const std::size_t words = height * divideUp(size.width, 64);
  const std::size_t all_runs = height * divideUp(size.width, 2);
  filtered.reserve(context, height * size.width, 3);
  strength.reserve(context,
                   divideUp(size.height, EDGE_TILE_HEIGHT) * std::size_t(divideUp(size.width, EDGE_TILE_WIDTH)),
                   sizeof(cl_int));
  mask.reserve(context, words, sizeof(cl_ulong));
  runs.reserve(context, all_runs, 2 * sizeof(cl_ushort));
  row_first.reserve(context, height, sizeof(cl_int));
  row_runs.reserve(context, height, sizeof(cl_int));
  rank.reserve(context, words, sizeof(cl_ushort));
  run_slot.reserve(context, all_runs, sizeof(cl_int));
  parent.reserve(context, all_runs, sizeof(cl_int));
  slot_label.reserve(context, all_runs, sizeof(cl_int));
  slot_record.reserve(context, all_runs, sizeof(cl_int));
  strip_slots.reserve(context, height, sizeof(cl_int));  // a strip has one row at least
  strip_reports.reserve(context, height, sizeof(cl_uint));
  counters.reserve(context, 1, sizeof(Counters));
  if (strips.united)
  {
    scratch.reserve(context, strips.count(size.height) * std::size_t(size.width + 1 + divideUp(size.width, 64)),
                    sizeof(cl_ulong));
  }
  records.reserve(context, withMargin(needed_records_, FIRST_RECORDS), sizeof(RegionSums));
  reported.reserve(context, withMargin(needed_reported_, FIRST_REPORTED), sizeof(RegionSums));
}

void FillBuffers::growRecords(const cl::Context& context, cl_uint count)
{
  records.reserve(context, withMargin(count, FIRST_RECORDS), sizeof(RegionSums));
}

void FillBuffers::growReported(const cl::Context& context, cl_uint count)
{
  reported.reserve(context, withMargin(count, FIRST_REPORTED), sizeof(RegionSums));
}

void FillBuffers::needed(const Counters& counters)
{
  needed_records_ = counters.records;
  needed_reported_ = counters.reported;
}

cl_uint FillBuffers::recordCapacity() const
{
  return static_cast<cl_uint>(records.bytes() / sizeof(RegionSums));
}

cl_uint FillBuffers::reportedCapacity() const
{
  return static_cast<cl_uint>(reported.bytes() / sizeof(RegionSums));
}

std::size_t FillBuffers::bytes() const
{
  std::size_t sum = 0;
  for (const GrowingBuffer* buffer :
       {&filtered, &strength, &mask, &runs, &row_first, &row_runs, &rank, &run_slot, &parent, &slot_label, &slot_record,
        &strip_slots, &strip_reports, &scratch, &counters, &records, &reported})
  {
    sum += buffer->bytes();
  }
  return sum;
}

}  // namespace omr
