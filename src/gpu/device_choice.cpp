#include "device_choice.h"

#include <utility>

#include "kernel_cache.h"

namespace omr
{
DeviceChoice::DeviceChoice(const std::string& device) : is_auto_(device == "auto")
{
  if (device != "reference")
  {
    devices_ = selectDevices(device);
    if (devices_.empty())
    {
      failures_ = "no OpenCL device is present";
    }
  }
  if (!open() && !devices_.empty() && !is_auto_)
  {
    throw DeviceError(failures_);
  }
  describe();
}

bool DeviceChoice::run(const std::function<void(DeviceFill&)>& work)
{
  if (current_ == 0 && fill_)
  {
    failures_.clear();
  }
  bool is_new = false;
  while (fill_ || open())
  {
    try
    {
      work(*fill_);
      if (is_new)
      {
        describe();
      }
      return true;
    }
    catch (const cl::Error& error)
    {
      state_.failures += 1;
      state_.last_failure = describeError(error, devices_[current_].description);
      note(state_.last_failure);
      fill_->abandon();
      fill_.reset();
      current_ += is_new ? 1 : 0;  // it had its second chance
      is_new = true;
    }
    catch (...)
    {
      fill_->abandon();
      throw;
    }
  }
  if (!devices_.empty() && !is_auto_)
  {
    current_ = 0;
    throw DeviceError(std::exchange(failures_, ""));
  }
  describe();
  return false;
}

/** The current device or the first one after it that works. */
bool DeviceChoice::open()
{
  for (; current_ < devices_.size(); ++current_)
  {
    const Device& device = devices_[current_];
    try
    {
      fillKernelCache(device);
      fill_ = std::make_unique<DeviceFill>(device, device.isCpu() ? Geometry::strips : Geometry::words);
      return true;
    }
    catch (const cl::Error& error)
    {
      note(describeError(error, device.description));
    }
    catch (const DeviceError& error)
    {
      note(error.what());
    }
  }
  return false;
}

void DeviceChoice::note(const std::string& failure)
{
  failures_ += (failures_.empty() ? "" : "\n") + failure;
}

void DeviceChoice::describe()
{
  state_.name = fill_ ? devices_[current_].description : "reference (no OpenCL)";
  state_.fallback_reason = fill_ && current_ == 0 ? "" : failures_;
}

}  // namespace omr
