#ifndef OUTDOOR_OMR_TEST_DEVICE_FIXTURE_H
#define OUTDOOR_OMR_TEST_DEVICE_FIXTURE_H

#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "device_fill.h"

namespace omr::test
{
/** The kernels of either geometry, on the device that the detector would choose. */
class DeviceTest : public testing::TestWithParam<Geometry>
{
 protected:
  void SetUp() override
  {
    const std::vector<Device> devices = selectDevices("auto");
    ASSERT_FALSE(devices.empty()) << "no OpenCL device: scripts/setup installs pocl-opencl-icd, which is one";
    static std::map<Geometry, std::unique_ptr<DeviceFill>> all;
    std::unique_ptr<DeviceFill>& fill = all[GetParam()];  // built once: the kernels take seconds to compile
    if (!fill)
    {
      fill = std::make_unique<DeviceFill>(devices.front(), GetParam());
    }
    fill_ = fill.get();
  }

  DeviceFill* fill_ = nullptr;
};

inline std::string geometryName(const testing::TestParamInfo<Geometry>& info)
{
  return info.param == Geometry::strips ? "strips" : "words";
}

}  // namespace omr::test

#endif
