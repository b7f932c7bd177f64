#ifndef OUTDOOR_OMR_CORE_ERODED_SQUARES_H
#define OUTDOOR_OMR_CORE_ERODED_SQUARES_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/frame.h"
#include "search_map.h"

namespace omr
{
/** A part of the image where too much light has shrunk dark squares, so that diagonal neighbours have parted. */
struct ErodedPart
{
  cv::Rect area;     ///< the squares, and a few more around [px]
  cv::Point2f u, v;  ///< sides of a square in their middle, as printed [px]
  float width = 0;   ///< of the dark squares, as seen [squares as printed]
};

/**
 * Finds islands in white that lie as the dark squares of a board do and have their shape: sharp squares reach as large
 * a share of the way towards their neighbours as of the way towards the white between them, dots 0.71 times as large a
 * one. Spilling light rounds corners: squares of 67 boards drawn so reach 0.73 to 0.91 times.
 *
 * @param open where there is no board yet.
 * @return     those with most squares first.
 */
std::vector<ErodedPart> findErodedParts(const Frame& frame, const SearchMap& open);

}  // namespace omr

#endif
