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
std::ofstream openOutput(const std::string& name);

/** One object a line. @throws std::runtime_error if it cannot be written. */
void writeJson(std::ostream& stream, const nlohmann::ordered_json& json);

}  // namespace omr

#endif
