#ifndef OUTDOOR_OMR_TOOLS_SHEET_WRITERS_H
#define OUTDOOR_OMR_TOOLS_SHEET_WRITERS_H

#include <opencv2/core.hpp>
#include <string>

#include "sheet.h"

namespace omr
{
/** The sheet as an SVG document whose user unit is the mm. */
std::string toSvg(const Sheet& sheet);

/** The sheet as a PDF document of one page of vector graphics; text in Helvetica, which every viewer has. */
std::string toPdf(const Sheet& sheet);

/**
 * The sheet as a picture.
 *
 * @param dpi pixels an inch; 20 to 1200.
 * @return    CV_8UC3; a pixel on the rim of a shape has the share of the colour that it covers.
 * @throws std::invalid_argument for another dpi.
 */
cv::Mat toImage(const Sheet& sheet, double dpi);

}  // namespace omr

#endif
