#include "device.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>

#include "outdoor_omr/fill_pipeline.h"

namespace omr
{
namespace
{
std::string lowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string typeName(cl_device_type type)
{
  return (type & CL_DEVICE_TYPE_GPU) ? "GPU" : (type & CL_DEVICE_TYPE_CPU) ? "CPU" : "accelerator";
}

bool usable(const cl::Device& device)
{
  // The kernels add 64-bit sums in two halves and count on the lower one coming first.
  return device.getInfo<CL_DEVICE_AVAILABLE>() && device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() &&
         device.getInfo<CL_DEVICE_ENDIAN_LITTLE>();
}

std::vector<cl::Device> devicesOf(const cl::Platform& platform)
{
  std::vector<cl::Device> devices;
  try
  {
    platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
  }
  catch (const cl::Error&)
  {
    devices.clear();  // a platform without devices, or with a broken driver: the others still count
  }
  return devices;
}

bool matches(const Device& device, const std::string& name)
{
  if (name == "gpu")
  {
    return device.isGpu();
  }
  if (name == "cpu")
  {
    return device.isCpu();
  }
  return lowerCase(device.description).find(name) != std::string::npos;
}
}  // namespace

std::vector<Device> findDevices()
{
  std::vector<Device> found;
  std::vector<cl::Platform> platforms;
  try
  {
    cl::Platform::get(&platforms);
  }
  catch (const cl::Error&)  // the loader's way to say that no driver is installed
  {
    return found;
  }
  for (const cl::Platform& platform : platforms)
  {
    for (const cl::Device& device : devicesOf(platform))
    {
      try
      {
        if (usable(device))
        {
          const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
          const std::string name = platform.getInfo<CL_PLATFORM_NAME>() + ": " + device.getInfo<CL_DEVICE_NAME>();
          found.push_back({device, type, name + " (" + typeName(type) + ")"});
        }
      }
      catch (const cl::Error&)
      {
        continue;  // a broken device: the others still count
      }
    }
  }
  return found;
}

std::vector<Device> selectDevices(const std::string& name)
{
  const std::vector<Device> present = findDevices();
  std::vector<Device> selected;
  if (name == "auto")
  {
    const auto append = [&](const auto& fits) {
      std::copy_if(present.begin(), present.end(), std::back_inserter(selected), fits);
    };
    append([](const Device& device) { return device.isGpu(); });
    append([](const Device& device) { return device.isCpu(); });
    append([](const Device& device) { return !device.isGpu() && !device.isCpu(); });
    return selected;
  }
  std::copy_if(present.begin(), present.end(), std::back_inserter(selected),
               [key = lowerCase(name)](const Device& device) { return matches(device, key); });
  if (name.empty() || selected.empty())
  {
    std::string message = "no OpenCL device fits '" + name + "'; present: ";
    for (const Device& device : present)
    {
      message += (&device == present.data() ? "" : ", ") + device.description;
    }
    throw DeviceError(message + (present.empty() ? "none" : ""));
  }
  return selected;
}

std::string describeError(const cl::Error& error, const std::string& device)
{
  static const std::map<cl_int, std::string> NAMES = {
      {CL_DEVICE_NOT_AVAILABLE, "CL_DEVICE_NOT_AVAILABLE"},
      {CL_COMPILER_NOT_AVAILABLE, "CL_COMPILER_NOT_AVAILABLE"},
      {CL_MEM_OBJECT_ALLOCATION_FAILURE, "CL_MEM_OBJECT_ALLOCATION_FAILURE"},
      {CL_OUT_OF_RESOURCES, "CL_OUT_OF_RESOURCES"},
      {CL_OUT_OF_HOST_MEMORY, "CL_OUT_OF_HOST_MEMORY"},
      {CL_BUILD_PROGRAM_FAILURE, "CL_BUILD_PROGRAM_FAILURE"},
      {CL_INVALID_BUFFER_SIZE, "CL_INVALID_BUFFER_SIZE"},
      {CL_INVALID_WORK_GROUP_SIZE, "CL_INVALID_WORK_GROUP_SIZE"},
      {CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST, "CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST"}};
  const auto name = NAMES.find(error.err());
  return std::string(error.what()) + " failed on " + device + ": " +
         (name == NAMES.end() ? "OpenCL error" : name->second) + " (" + std::to_string(error.err()) + ")";
}

}  // namespace omr
