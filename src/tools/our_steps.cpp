#include "our_steps.h"

#include <limits>

#include "device_fill.h"
#include "outdoor_omr/detector.h"

namespace omr
{
namespace
{
std::shared_ptr<DeviceFill> openFill(const std::string& name)
{
  const std::vector<Device> devices = selectDevices(name);
  if (devices.empty())
  {
    throw DeviceError("no OpenCL device is present");
  }
  return std::make_shared<DeviceFill>(devices.front(), devices.front().isCpu() ? Geometry::strips : Geometry::words);
}

std::string suffixOf(FillMethod method)
{
  return method == FillMethod::runs ? "" : " by sweeps";
}
}  // namespace

std::string nameOf(Filter filter)
{
  return filter == Filter::none ? "no filter" : filter == Filter::gaussian ? "gaussian" : "median";
}

OurSteps::OurSteps(const std::string& device)
    : fill_(openFill(device)),
      pipeline_(std::make_shared<FillPipeline>(device)),
      detector_(std::make_shared<Detector>(device))
{
}

const std::string& OurSteps::deviceName() const
{
  return pipeline_->device().name;
}

Contestant OurSteps::filter(Filter filter, int size) const
{
  return {nameOf(filter) + " " + std::to_string(size), [=, fill = fill_](const cv::Mat& image) {
            return [=] {
              fill->loadImage(image);
              fill->filter(filter, size);
              fill->finish();
            };
          }};
}

Contestant OurSteps::edges() const
{
  return {"edges", [fill = fill_](const cv::Mat& image) {
            return [=] {
              fill->loadImage(image);
              fill->findEdges(edgeThreshold(Settings()));
              fill->finish();
            };
          }};
}

Contestant OurSteps::labels(const EdgesOf& edges_of, FillMethod method) const
{
  return {"labels" + suffixOf(method), [=, fill = fill_](const cv::Mat& image) {
            return [=, loaded = false, labels = cv::Mat()]() mutable {
              if (!loaded)
              {
                fill->loadImage(image);
                fill->loadEdges(edges_of(image));
                loaded = true;
              }
              fill->labelRegions(method, std::numeric_limits<int>::max());  // sweeps: until they settle
              fill->readLabels(labels);
              fill->finish();
            };
          }};
}

Contestant OurSteps::labelsAndRegionData(const EdgesOf& edges_of, FillMethod method) const
{
  return {"labels and region data" + suffixOf(method), [=, fill = fill_](const cv::Mat& image) {
            return [=, loaded = false, labels = cv::Mat(), sums = std::vector<RegionSums>()]() mutable {
              fill->loadImage(image);
              if (!loaded)
              {
                fill->loadEdges(edges_of(image));  // they stay on the device
                loaded = true;
              }
              fill->labelRegions(method, std::numeric_limits<int>::max());
              fill->readLabels(labels);
              fill->sumRegions(AreaWindow());
              fill->readSums(sums);
              fill->finish();
            };
          }};
}

Contestant OurSteps::pipeline(const Settings& settings, bool labels) const
{
  const std::string name = "pipeline, " + nameOf(settings.filter) + suffixOf(settings.fill_method);
  return {name + (labels ? ", label image" : ""), [=, pipeline = pipeline_](const cv::Mat& image) {
            return [=, map = RegionMap()]() mutable {
              FillPipeline::Outputs outputs;
              outputs.labels = labels;
              pipeline->run(image, settings, outputs, map);
            };
          }};
}

Contestant OurSteps::detector(const Settings& settings) const
{
  return {"detector, " + nameOf(settings.filter),
          [=, detector = detector_](const cv::Mat& image) { return [=] { detector->detect(image, settings); }; }};
}

}  // namespace omr
