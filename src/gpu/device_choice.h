#ifndef OUTDOOR_OMR_GPU_DEVICE_CHOICE_H
#define OUTDOOR_OMR_GPU_DEVICE_CHOICE_H

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "device.h"
#include "device_fill.h"
#include "outdoor_omr/fill_pipeline.h"

namespace omr
{
/**
 * The device at work, of those that may be, in their order. One that fails is opened anew once, since a driver that was
 * reset leaves a context of which nothing can be used; one that fails again gives way to the next.
 */
class DeviceChoice
{
 public:
  /** Opens the first that works. @param device, errors: see FillPipeline::FillPipeline(). */
  explicit DeviceChoice(const std::string& device);

  /**
   * Has a device do the work on an image, and the next one if it fails. After an exception no device reads or writes
   * the caller's memory any more.
   *
   * @return false where "auto" has no device left, or "reference" was asked for: the reference has to do it.
   * @throws DeviceError if every device failed that was asked for: the next image begins with the first of them again;
   *         whatever work throws beside cl::Error.
   */
  bool run(const std::function<void(DeviceFill&)>& work);

  /** Null: the reference. */
  const DeviceFill* fill() const
  {
    return fill_.get();
  }

  const DeviceState& state() const
  {
    return state_;
  }

 private:
  bool open();
  void note(const std::string& failure);
  void describe();

  std::vector<Device> devices_;
  bool is_auto_;
  std::size_t current_ = 0;  // which of the devices is at work, or to be opened
  std::unique_ptr<DeviceFill> fill_;
  std::string failures_;  // of the devices before
  DeviceState state_;
};

}  // namespace omr

#endif
