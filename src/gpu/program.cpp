#include "program.h"

#include <vector>

#include "kernel_sources.h"
#include "outdoor_omr/fill_pipeline.h"

namespace omr
{
namespace
{
cl::Program build(const cl::Context& context, const cl::Device& device, int lanes)
{
  const cl::Program::Sources sources(KERNEL_SOURCES, KERNEL_SOURCES + KERNEL_SOURCE_COUNT);
  cl::Program program(context, sources);
  try
  {
    program.build({device}, ("-cl-std=CL1.2 -D LANES=" + std::to_string(lanes)).c_str());
  }
  catch (const cl::Error& error)
  {
    throw DeviceError("the kernels do not build on " + device.getInfo<CL_DEVICE_NAME>() + " (" +
                      std::to_string(error.err()) + "):\n" + program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device));
  }
  return program;
}
}  // namespace

Program::Program(const cl::Context& context, const cl::Device& device, int lanes) : lanes_(lanes)
{
  cl::Program program = build(context, device, lanes);
  std::vector<cl::Kernel> kernels;
  program.createKernels(&kernels);
  for (const cl::Kernel& kernel : kernels)
  {
    // Some drivers count the terminating zero into the name.
    kernels_.emplace(kernel.getInfo<CL_KERNEL_FUNCTION_NAME>().c_str(), kernel);
  }
}

}  // namespace omr
