#ifndef OUTDOOR_OMR_GPU_PROGRAM_H
#define OUTDOOR_OMR_GPU_PROGRAM_H

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "opencl.h"

namespace omr
{
/** Number of work-groups of a launch. */
struct Groups
{
  std::size_t x = 1;
  std::size_t y = 1;
};

/** The kernels of kernels/, built for one device. */
class Program
{
 public:
  /**
   * @param lanes work-items of a group, see kernels/geometry.cl.
   * @throws DeviceError with the build log if the device's compiler refuses the sources; cl::Error otherwise.
   */
  Program(const cl::Context& context, const cl::Device& device, int lanes);

  /** The groups that make at least so many work-items. */
  Groups groupsOf(std::size_t items) const
  {
    return {(items + lanes_ - 1) / lanes_, 1};
  }

  /** Enqueues the kernel called name; the event is its own. */
  template <typename... Arguments>
  cl::Event launch(const cl::CommandQueue& queue, const char* name, const Groups& groups, const Arguments&... arguments)
  {
    cl::Kernel& kernel = kernels_.find(name)->second;
    cl_uint index = 0;
    (kernel.setArg(index++, arguments), ...);
    cl::Event event;
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(groups.x * lanes_, groups.y), cl::NDRange(lanes_, 1),
                               nullptr, &event);
    return event;
  }

 private:
  std::size_t lanes_;
  std::map<std::string, cl::Kernel, std::less<>> kernels_;  // found without a copy of the name
};

}  // namespace omr

#endif
