#include "image_files.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace omr
{
cv::Mat readImage(const std::string& name)
{
  std::error_code error;
  if (!std::filesystem::exists(name, error))
  {
    throw std::invalid_argument(error ? error.message() : "there is no such file");
  }
  cv::Mat image;
  try
  {
    image = cv::imread(name, cv::IMREAD_COLOR);
  }
  catch (const cv::Exception& exception)
  {
    throw std::invalid_argument(exception.err);
  }
  if (image.empty())
  {
    throw std::invalid_argument("not an image that can be read");
  }
  return image;
}

void refuseToOverwrite(const std::string& image, const std::string& way_out)
{
  throw std::invalid_argument("the output would overwrite the image '" + image + "'; " + way_out);
}

void refuseImage(const std::string& output)
{
  std::error_code ignored;  // what is not there is nothing to lose; to read from a pipe would empty it
  if (std::filesystem::is_regular_file(output, ignored) && cv::haveImageReader(output))
  {
    refuseToOverwrite(output,
                      "name another file for it: was its name, or - after --json, forgotten before the images?");
  }
}

std::ofstream openOutput(const std::string& name, std::ios::openmode mode)
{
  refuseImage(name);
  std::ofstream file(name, mode);
  if (!file)
  {
    throw std::runtime_error("cannot write '" + name + "'");
  }
  return file;
}

NewFile::NewFile(const std::string& name) : name_(name)
{
  std::error_code error;
  const bool exists = std::filesystem::exists(name, error);
  const bool is_device = exists && (!std::filesystem::is_regular_file(name, error) || name.rfind("/dev/", 0) == 0);
  if (exists && !is_device)
  {
    openOutput(name, std::ios::app);                           // what must not be written stays
    name_ = std::filesystem::canonical(name, error).string();  // a link stays one
  }
  unfinished_ = is_device ? name : name_ + ".part";
  stream_.open(unfinished_);
  if (!stream_)
  {
    throw std::runtime_error("cannot write '" + name + "'");
  }
}

NewFile::~NewFile()
{
  if (!is_finished_ && unfinished_ != name_)
  {
    std::error_code ignored;
    std::filesystem::remove(unfinished_, ignored);
  }
}

std::ostream& NewFile::stream()
{
  return stream_;
}

void NewFile::finish()
{
  stream_.close();
  if (!stream_)
  {
    throw std::runtime_error("cannot write '" + unfinished_ + "'; is the disk full?");
  }
  if (unfinished_ != name_)
  {
    std::filesystem::rename(unfinished_, name_);
  }
  is_finished_ = true;
}

void writeJson(std::ostream& stream, const nlohmann::ordered_json& json)
{
  // A file name need not be UTF-8; JSON must be.
  stream << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << std::endl;
  if (!stream)
  {
    throw std::runtime_error("cannot write the JSON output; is the disk full?");
  }
}

}  // namespace omr
