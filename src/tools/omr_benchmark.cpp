// Times the steps of the fill pipeline beside what OpenCV offers for the same job, in one run, on drawn scenes or on
// image files. Google Benchmark's own options apply; compare the columns CPU (of all threads) on a busy machine.

#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "device_fill.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/reference_fill.h"
#include "scene.h"

using omr::AreaWindow;
using omr::DeviceFill;
using omr::FillMethod;
using omr::FillPipeline;
using omr::Filter;
using omr::Settings;

namespace
{
const cv::Size SCENE_SIZES[] = {{512, 512}, {1280, 720}, {1920, 1080}, {3840, 2160}};

struct Picture
{
  std::string name;
  cv::Mat bgr;
};

void add(const Picture& picture, const std::string& name, const std::function<void()>& action)
{
  benchmark::RegisterBenchmark((picture.name + "/" + name).c_str(),
                               [action](benchmark::State& state) {
                                 action();  // the first run grows the buffers
                                 for (auto _ : state)
                                 {
                                   action();
                                 }
                               })
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

void addFilters(const Picture& picture, const std::shared_ptr<DeviceFill>& fill)
{
  for (const int size : {3, 5})
  {
    const std::string suffix = " " + std::to_string(size);
    for (const Filter filter : {Filter::gaussian, Filter::median})
    {
      add(picture, (filter == Filter::gaussian ? "gaussian" : "median") + suffix, [=] {
        fill->loadImage(picture.bgr);
        fill->filter(filter, size);
        fill->finish();
      });
    }
    add(picture, "cv::GaussianBlur" + suffix, [=, blurred = cv::Mat()]() mutable {
      cv::GaussianBlur(picture.bgr, blurred, {size, size}, 0, 0, cv::BORDER_REPLICATE);
    });
    add(picture, "cv::medianBlur" + suffix,
        [=, blurred = cv::Mat()]() mutable { cv::medianBlur(picture.bgr, blurred, size); });
  }
}

void addEdges(const Picture& picture, const std::shared_ptr<DeviceFill>& fill, int threshold)
{
  add(picture, "edges", [=] {
    fill->loadImage(picture.bgr);
    fill->findEdges(threshold);
    fill->finish();
  });
  add(picture, "cv::Sobel twice", [=, gx = cv::Mat(), gy = cv::Mat()]() mutable {
    cv::Sobel(picture.bgr, gx, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
    cv::Sobel(picture.bgr, gy, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
  });
}

void addRegions(const Picture& picture, const std::shared_ptr<DeviceFill>& fill, const Settings& settings)
{
  const cv::Mat edges = omr::edgeMask(picture.bgr, settings.sobel_threshold);
  const cv::Mat open = edges == 0;
  const auto label = [=](FillMethod method, cv::Mat& labels) {
    fill->labelRegions(method, std::numeric_limits<int>::max());  // sweeps: until they settle
    fill->readLabels(labels);
  };
  const auto prepared = [=](const std::function<void()>& action) {
    return [=, ready = false]() mutable {
      if (!ready)
      {
        fill->loadImage(picture.bgr);
        fill->loadEdges(edges);
        ready = true;
      }
      action();
    };
  };
  add(picture, "labels", prepared([=, labels = cv::Mat()]() mutable {
        label(FillMethod::runs, labels);
        fill->finish();
      }));
  add(picture, "cv::connectedComponents",
      [=, labels = cv::Mat()]() mutable { cv::connectedComponents(open, labels, 4); });
  add(picture, "labels and region data", [=, labels = cv::Mat(), sums = std::vector<omr::RegionSums>()]() mutable {
    fill->loadImage(picture.bgr);
    label(FillMethod::runs, labels);
    fill->sumRegions(AreaWindow());
    fill->readSums(sums);
    fill->finish();
  });
  add(picture, "cv::connectedComponentsWithStats",
      [=, labels = cv::Mat(), stats = cv::Mat(), centers = cv::Mat()]() mutable {
        cv::connectedComponentsWithStats(open, labels, stats, centers, 4);
      });
  if (picture.bgr.total() <= 512 * 512)  // the sweeps take seconds on larger images
  {
    add(picture, "labels by sweeps", prepared([=, labels = cv::Mat()]() mutable {
          label(FillMethod::sweep, labels);
          fill->finish();
        }));
  }
}

void addWhole(const Picture& picture, const std::shared_ptr<FillPipeline>& pipeline, const Settings& settings)
{
  for (const bool labels : {false, true})
  {
    add(picture, labels ? "whole with label image" : "whole", [=, map = omr::RegionMap()]() mutable {
      FillPipeline::Outputs outputs;
      outputs.labels = labels;
      pipeline->run(picture.bgr, settings, outputs, map);
    });
  }
  add(picture, "memcpy of the image", [=, copy = picture.bgr.clone()]() mutable {
    std::memcpy(copy.data, picture.bgr.data, copy.total() * copy.elemSize());
    benchmark::ClobberMemory();
  });
}

std::vector<Picture> pictures(const std::vector<std::string>& files)
{
  std::vector<Picture> all;
  for (const std::string& file : files)
  {
    const cv::Mat bgr = cv::imread(file, cv::IMREAD_COLOR);
    if (bgr.empty())
    {
      throw std::runtime_error("cannot read the image " + file);
    }
    all.push_back({file.substr(file.find_last_of('/') + 1), bgr});
  }
  for (const cv::Size& size : SCENE_SIZES)
  {
    if (files.empty())
    {
      all.push_back({std::to_string(size.width) + "x" + std::to_string(size.height), omr::drawScene(size)});
    }
  }
  return all;
}

int run(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  CLI::App app{"Times the fill pipeline and OpenCV's functions for the same job."};
  std::string name = "auto";
  std::vector<std::string> files;
  app.add_option("--device", name, "OpenCL device: auto, gpu, cpu or a part of its name");
  app.add_option("images", files, "image files (default: drawn scenes of several sizes)");
  CLI11_PARSE(app, argc, argv);
  const std::vector<omr::Device> devices = omr::selectDevices(name);
  if (devices.empty())
  {
    throw omr::DeviceError("no OpenCL device is present");
  }
  const auto pipeline = std::make_shared<FillPipeline>(name);
  const auto fill = std::make_shared<DeviceFill>(
      devices.front(), devices.front().isCpu() ? omr::Geometry::strips : omr::Geometry::words);
  std::cerr << "device: " << pipeline->deviceName() << "\n";
  for (const Picture& picture : pictures(files))
  {
    addWhole(picture, pipeline, Settings());
    addFilters(picture, fill);
    addEdges(picture, fill, Settings().sobel_threshold);
    addRegions(picture, fill, Settings());
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
}  // namespace

int main(int argc, char** argv)
{
  try
  {
    return run(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::cerr << "omr_benchmark: " << error.what() << "\n";
    return 2;
  }
}
