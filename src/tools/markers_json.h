#ifndef OUTDOOR_OMR_TOOLS_MARKERS_JSON_H
#define OUTDOOR_OMR_TOOLS_MARKERS_JSON_H

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>

#include "outdoor_omr/detector.h"

namespace omr
{
/**
 * One image's markers as the JSON object that omr_detect writes on a line of its own (README, "Command line").
 *
 * @param image        the file's name as the caller gave it.
 * @param size         of the image [px].
 * @param milliseconds that the detection took, without reading the file.
 */
nlohmann::ordered_json toJson(const std::string& image, const cv::Size& size, double milliseconds,
                              const Markers& markers);

}  // namespace omr

#endif
