#ifndef OUTDOOR_OMR_TOOLS_IMAGE_FILES_H
#define OUTDOOR_OMR_TOOLS_IMAGE_FILES_H

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <ostream>
#include <string>

namespace omr
{
/** An image file, BGR, turned as its EXIF data ask. @throws std::invalid_argument with the reason. */
cv::Mat readImage(const std::string& name);

/** @throws std::runtime_error if it cannot be written. */
std::ofstream openOutput(const std::string& name, std::ios::openmode mode = std::ios::out);

/** A file that has its name only once it is finished: until then what was there stays. */
class NewFile
{
 public:
  /** @throws std::runtime_error if it cannot be written. */
  explicit NewFile(const std::string& name);

  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /** Removes what is not finished. */
  ~NewFile();

  std::ostream& stream();

  /** @throws std::runtime_error if it cannot be written. */
  void finish();

 private:
  std::string name_;
  std::string unfinished_;  // the same name where that is a device, as /dev/stdout
  std::ofstream stream_;
  bool is_finished_ = false;
};

/** One object a line. @throws std::runtime_error if it cannot be written. */
void writeJson(std::ostream& stream, const nlohmann::ordered_json& json);

}  // namespace omr

#endif
