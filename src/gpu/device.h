#ifndef OUTDOOR_OMR_GPU_DEVICE_H
#define OUTDOOR_OMR_GPU_DEVICE_H

#include <string>
#include <vector>

#include "opencl.h"

namespace omr
{
/** A usable OpenCL device: available, with a compiler, little-endian. */
struct Device
{
  cl::Device device;
  cl_device_type type = 0;
  std::string description;  ///< "platform: device (type)"

  bool isGpu() const
  {
    return (type & CL_DEVICE_TYPE_GPU) != 0;
  }

  /** Whether it shares the host's memory and caches. */
  bool isCpu() const
  {
    return (type & CL_DEVICE_TYPE_CPU) != 0;
  }
};

/** Every usable OpenCL device of this machine, in the order of the platforms; empty when there is none. */
std::vector<Device> findDevices();

/**
 * The devices to try for a name as FillPipeline takes it, best first.
 *
 * @param name "auto": GPUs before CPUs before others, possibly none; "gpu", "cpu": those of the type; else those whose
 *             description contains the name, regardless of case.
 * @throws DeviceError if another name than "auto" fits no device; the message lists the devices present.
 */
std::vector<Device> selectDevices(const std::string& name);

/** "clEnqueueNDRangeKernel failed on DEVICE: CL_OUT_OF_RESOURCES (-5)" */
std::string describeError(const cl::Error& error, const std::string& device);

}  // namespace omr

#endif
