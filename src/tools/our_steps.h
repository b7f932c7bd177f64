#ifndef OUTDOOR_OMR_TOOLS_OUR_STEPS_H
#define OUTDOOR_OMR_TOOLS_OUR_STEPS_H

#include <memory>
#include <string>

#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/settings.h"
#include "peers.h"
#include "race.h"

namespace omr
{
class Detector;
class DeviceFill;

/** What this package does, as contestants: the steps of the fill pipeline one by one, and the whole, on one device. */
class OurSteps
{
 public:
  /** @param device as FillPipeline takes it. @throws DeviceError if no OpenCL device fits. */
  explicit OurSteps(const std::string& device);

  const std::string& deviceName() const;

  Contestant filter(Filter filter, int size) const;
  Contestant edges() const;

  /** Label image of a mask. @param method of which the name tells. */
  Contestant labels(const EdgesOf& edges_of, FillMethod method) const;

  /** Label image and all region data of all regions. */
  Contestant labelsAndRegionData(const EdgesOf& edges_of, FillMethod method) const;

  /** Image in, region data out. @param labels whether with the label image. */
  Contestant pipeline(const Settings& settings, bool labels = false) const;

  /** Image in, markers out. */
  Contestant detector(const Settings& settings) const;

 private:
  std::shared_ptr<DeviceFill> fill_;
  std::shared_ptr<FillPipeline> pipeline_;
  std::shared_ptr<Detector> detector_;
};

/** "no filter", "gaussian", "median". */
std::string nameOf(Filter filter);

}  // namespace omr

#endif
