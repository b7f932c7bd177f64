#ifndef OUTDOOR_OMR_TOOLS_PHOTOGRAPHS_H
#define OUTDOOR_OMR_TOOLS_PHOTOGRAPHS_H

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace omr
{
/** The photographs of all folders and their subfolders, in the order of their names; those that cannot be used are
 * told. */
std::vector<cv::Mat> readPhotographs(const std::vector<std::string>& folders);

/** Of every few photographs one is held out. @param held whether those are wanted, or the others. */
std::vector<cv::Mat> part(const std::vector<cv::Mat>& photographs, int held_out, bool held);

}  // namespace omr

#endif
