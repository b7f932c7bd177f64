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
  spacious_images_ = count * element_size < bytes_ / 4 ? spacious_images_ + 1 : 0;
  if (spacious_images_ > PATIENCE)
  {
    free();
  }
  grow(context, count, element_size);
}

void GrowingBuffer::grow(const cl::Context& context, std::size_t count, std::size_t element_size)
{
  idle_images_ = 0;
  const std::size_t bytes = std::max<std::size_t>(count, 1) * element_size;
  if (bytes > bytes_)
  {
    free();  // the old one first; nothing is left when the device has no room
    buffer_ = cl::Buffer(context, CL_MEM_READ_WRITE, bytes);
    bytes_ = bytes;
  }
}

void GrowingBuffer::rest()
{
  idle_images_ = bytes_ > 0 ? idle_images_ + 1 : 0;
  if (idle_images_ > PATIENCE)
  {
    free();
  }
}

void GrowingBuffer::free()
{
  buffer_ = cl::Buffer();
  bytes_ = 0;
  spacious_images_ = 0;
}

void FillBuffers::reserve(const cl::Context& context, const cv::Size& size, const Strips& strips, bool may_shrink)
{
  const auto reserve = [&](GrowingBuffer& buffer, std::size_t count, std::size_t element_size) {
    may_shrink ? buffer.reserve(context, count, element_size) : buffer.grow(context, count, element_size);
  };
  const std::size_t height = size.height;
  const std::size_t words = height * divideUp(size.width, 64);
  const std::size_t all_runs = height * divideUp(size.width, 2);
  reserve(filtered, height * size.width, 3);
  reserve(strength, divideUp(size.height, EDGE_TILE_HEIGHT) * std::size_t(divideUp(size.width, EDGE_TILE_WIDTH)),
          sizeof(cl_int));
  reserve(mask, words, sizeof(cl_ulong));
  reserve(runs, all_runs, 2 * sizeof(cl_ushort));
  reserve(row_first, height, sizeof(cl_int));
  reserve(row_runs, height, sizeof(cl_int));
  reserve(rank, words, sizeof(cl_ushort));
  reserve(run_slot, all_runs, sizeof(cl_int));
  reserve(parent, all_runs, sizeof(cl_int));
  reserve(slot_label, all_runs, sizeof(cl_int));
  reserve(slot_record, all_runs, sizeof(cl_int));
  reserve(strip_slots, height, sizeof(cl_int));  // a strip has one row at least
  reserve(strip_reports, height, sizeof(cl_uint));
  reserve(counters, 1, sizeof(Counters));
  if (strips.united)
  {
    reserve(scratch, strips.count(size.height) * std::size_t(size.width + 1 + divideUp(size.width, 64)),
            sizeof(cl_ulong));
  }
  reserve(records, withMargin(needed_records_, FIRST_RECORDS), sizeof(RegionSums));
  reserve(reported, withMargin(needed_reported_, FIRST_REPORTED), sizeof(RegionSums));
}

void FillBuffers::growRecords(const cl::Context& context, cl_uint count)
{
  records.grow(context, withMargin(count, FIRST_RECORDS), sizeof(RegionSums));
}

void FillBuffers::growReported(const cl::Context& context, cl_uint count)
{
  reported.grow(context, withMargin(count, FIRST_REPORTED), sizeof(RegionSums));
}

void FillBuffers::needed(const Counters& counters, bool may_shrink)
{
  needed_records_ = std::max(counters.records, may_shrink ? 0 : needed_records_);
  needed_reported_ = std::max(counters.reported, may_shrink ? 0 : needed_reported_);
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
