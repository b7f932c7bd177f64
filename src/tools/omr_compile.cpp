#include <exception>
#include <iostream>

#include "device_fill.h"

/**
 * Builds the kernels for the CPU device of this description, so that the driver has them on the disk; run by the
 * library (src/gpu/kernel_cache.h). What goes wrong with the device it does not say: the library meets it again and
 * reports.
 */
int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::cerr << "omr_compile: run by the library with a device's description; there is no other use for it\n";
    return 2;
  }
  try
  {
    for (const omr::Device& device : omr::findDevices())
    {
      if (device.isCpu() && device.description == argv[1])
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
