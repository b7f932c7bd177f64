#include <exception>

#include "device_fill.h"

/**
 * Builds the kernels for the CPU device of this description, so that the driver has them on the disk; run by the
 * library (src/gpu/kernel_cache.h). Says nothing: what goes wrong, the library meets again and reports.
 */
int main(int argc, char** argv)
{
  try
  {
    for (const omr::Device& device : omr::findDevices())
    {
      if (argc == 2 && device.isCpu() && device.description == argv[1])
      {
        const omr::DeviceFill fill(device, omr::Geometry::strips);
        return 0;
      }
    }
  }
  catch (const std::exception&)
  {
  }
  return 1;
}
