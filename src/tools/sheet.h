#ifndef OUTDOOR_OMR_TOOLS_SHEET_H
#define OUTDOOR_OMR_TOOLS_SHEET_H

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace omr
{
/** A filled shape or a line of text. All lengths in mm; x to the right, y down, origin at the page's top left corner.
 */
struct Shape
{
  enum class Kind
  {
    rectangle,
    circle,
    text
  };
  Kind kind;
  cv::Vec3b color;       ///< B, G, R
  cv::Point2d position;  ///< rectangle: top left corner; circle: centre; text: left end of the base line
  cv::Size2d size;       ///< rectangle: sides; circle: radius as width; text: font size as height
  std::string text;
};

/** A page of markers, to be drawn in the order of its shapes. */
struct Sheet
{
  cv::Size2d page;  ///< [mm]
  std::vector<Shape> shapes;
};

/** What to put on a page. */
struct SheetContent
{
  std::vector<cv::Size> checkerboards;  ///< squares: height = rows, width = cols
  double square = 30;                   ///< side of a square [mm]
  std::vector<std::string> targets;     ///< ring colours from the inner disk outwards, of W P R G B
  double ring = 15;                     ///< width of a ring, radius of the inner disk [mm]
};

/** "7x10" as rows x cols. @throws std::invalid_argument for other text or a size outside 5x7 to 21x21 squares. */
cv::Size parseCheckerboard(const std::string& text);

/** "A4", "A3", "A2" (upright) or "WxH" in mm. @throws std::invalid_argument for other text. */
cv::Size2d parsePage(const std::string& text);

/**
 * Arranges markers on a white page, row by row, at true scale.
 *
 * Each marker keeps a white margin of one square or ring, at least 8 mm, on every side and says below what it is. A
 * ruler of 100 mm at the foot of the page shows whether the printer kept the scale.
 *
 * @throws std::invalid_argument when nothing is asked for, a length is not positive, a target has fewer than two
 *         rings, a letter other than W P R G B, two like neighbours or a white outer ring (paper has no edge there),
 *         or when the page is too small; the message then names the sizes.
 */
Sheet arrangeSheet(const SheetContent& content, const cv::Size2d& page);

/** What a person should know of these markers before printing them; empty when there is nothing. */
std::vector<std::string> adviceFor(const SheetContent& content);

}  // namespace omr

#endif
