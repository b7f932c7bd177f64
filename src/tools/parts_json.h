#ifndef OUTDOOR_OMR_TOOLS_PARTS_JSON_H
#define OUTDOOR_OMR_TOOLS_PARTS_JSON_H

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "outdoor_omr/locate.h"

namespace omr
{
/**
 * One image's parts as the JSON object that omr_position writes on a line of its own: `parts` holds the poses that are
 * certain, `ambiguous` a list of candidates for each group of markers that leaves several (docs/position.md).
 *
 * @param image        the file's name as the caller gave it.
 * @param size         of the image [px].
 * @param milliseconds that detection and location took, without reading the file.
 */
nlohmann::ordered_json toJson(const std::string& image, const cv::Size& size, double milliseconds,
                              const std::vector<Sighting>& sightings);

}  // namespace omr

#endif
