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

/** Refuses to write over an image. @param way_out what to do instead. @throws std::invalid_argument */
[[noreturn]] void refuseToOverwrite(const std::string& image, const std::string& way_out);

/** Refuses a name that an image has, for an output that is none: where the output's own name is forgotten, as in
 * "--json *.png", the first photograph stands in its place. @throws std::invalid_argument */
void refuseImage(const std::string& output);

/** For an output that is no image. @throws std::invalid_argument if an image has the name; std::runtime_error if it
 * cannot be written. */
std::ofstream openOutput(const std::string& name, std::ios::openmode mode = std::ios::out);

/** A file, no image, that has its name only once it is finished: until then what was there stays. */
class NewFile
{
 public:
  /** @throws as openOutput(). */
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
