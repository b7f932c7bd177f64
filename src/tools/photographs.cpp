#include "photographs.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <opencv2/imgproc.hpp>

#include "image_files.h"

namespace omr
{
namespace
{
/** Larger photographs are shrunk to this: their finest detail is blur. */
constexpr double MAX_SIDE = 1200;
constexpr int MIN_SIDE = 100;
}  // namespace

std::vector<cv::Mat> readPhotographs(const std::vector<std::string>& folders)
{
  std::vector<std::string> names;
  for (const std::string& folder : folders)
  {
    if (!std::filesystem::is_directory(folder))
    {
      throw std::runtime_error("'" + folder + "' is not a folder");
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    {
      if (entry.is_regular_file())
      {
        names.push_back(entry.path());
      }
    }
  }
  std::sort(names.begin(), names.end());
  std::vector<cv::Mat> photographs;
  for (const std::string& name : names)
  {
    try
    {
      cv::Mat image = readImage(name);
      const double shrink = MAX_SIDE / std::max(image.cols, image.rows);
      if (shrink < 1)
      {
        cv::resize(image, image, {}, shrink, shrink, cv::INTER_AREA);
      }
      if (std::min(image.cols, image.rows) < MIN_SIDE)
      {
        throw std::invalid_argument("narrower than " + std::to_string(MIN_SIDE) + " px");
      }
      photographs.push_back(image);
    }
    catch (const std::invalid_argument& error)
    {
      std::cerr << "omr_train: left out: " << name << ": " << error.what() << "\n";
    }
  }
  return photographs;
}

std::vector<cv::Mat> part(const std::vector<cv::Mat>& photographs, int held_out, bool held)
{
  std::vector<cv::Mat> chosen;
  for (std::size_t i = 0; i < photographs.size(); ++i)
  {
    if ((i % held_out == held_out - 1U) == held)
    {
      chosen.push_back(photographs[i]);
    }
  }
  return chosen;
}

}  // namespace omr
