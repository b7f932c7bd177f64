#ifndef OUTDOOR_OMR_TEST_TARGET_VIEWS_H
#define OUTDOOR_OMR_TEST_TARGET_VIEWS_H

#include <string>
#include <vector>

#include "render_target.h"
#include "targets/targets.h"

namespace omr::test
{
/** Regions as the fill pipeline gives them, by its reference. */
RegionMap targetRegions(const cv::Mat& image, const Settings& settings);

/** The targets of an image without boards. */
std::vector<Target> findTargetsIn(const cv::Mat& image, const Settings& settings = Settings());

/** Expects one target with these colours, its centre right to within the tolerance [px]. */
void expectFound(const TargetScene& scene, const std::string& colors, double tolerance = .1);

/** Expects the letters of a target that was found, of which so many at most may be '?'. */
void expectLetters(const std::string& colors, int most_unknown, const std::string& found);

}  // namespace omr::test

#endif
