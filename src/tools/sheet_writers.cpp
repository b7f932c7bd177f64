#include "sheet_writers.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace omr
{
namespace
{
constexpr double MM_PER_INCH = 25.4;
constexpr double POINTS_PER_MM = 72 / MM_PER_INCH;

/** Control points of a quarter circle lie this share of the radius from its ends; the curve is 0.03 % off. */
constexpr double BEZIER_QUARTER = 0.5522847498;

/** Text with the given characters escaped. */
std::string escaped(const std::string& text, const std::function<std::string(char)>& escape)
{
  std::string result;
  for (const char letter : text)
  {
    result += escape(letter);
  }
  return result;
}

std::string escapedForXml(const std::string& text)
{
  return escaped(text, [](char letter) -> std::string {
    return letter == '<' ? "&lt;" : letter == '&' ? "&amp;" : std::string(1, letter);
  });
}

std::string escapedForPdf(const std::string& text)
{
  return escaped(text, [](char letter) {
    return letter == '(' || letter == ')' || letter == '\\' ? std::string("\\") + letter : std::string(1, letter);
  });
}

template <typename Value>
std::string attribute(const std::string& name, const Value& value)
{
  std::ostringstream text;
  text << ' ' << name << "=\"" << value << '"';
  return text.str();
}

std::string svgShape(const Shape& shape)
{
  std::ostringstream color;
  color << "rgb(" << int{shape.color[2]} << ',' << int{shape.color[1]} << ',' << int{shape.color[0]} << ')';
  const std::string fill = attribute("fill", color.str());
  const std::string position = attribute("x", shape.position.x) + attribute("y", shape.position.y);
  switch (shape.kind)
  {
    case Shape::Kind::rectangle:
      return "<rect" + fill + position + attribute("width", shape.size.width) + attribute("height", shape.size.height) +
             "/>\n";
    case Shape::Kind::circle:
      return "<circle" + fill + attribute("cx", shape.position.x) + attribute("cy", shape.position.y) +
             attribute("r", shape.size.width) + "/>\n";
    case Shape::Kind::text:
      return "<text" + fill + position + attribute("font-size", shape.size.height) +
             attribute("font-family", "Helvetica, Arial, sans-serif") + ">" + escapedForXml(shape.text) + "</text>\n";
  }
  throw std::logic_error("a shape without a kind");
}

/** The operators of one shape; PDF counts y upwards, so the page is turned once by its transformation. */
std::string pdfShape(const Shape& shape)
{
  std::ostringstream text;
  text << std::setprecision(8) << shape.color[2] / 255. << ' ' << shape.color[1] / 255. << ' ' << shape.color[0] / 255.
       << " rg ";
  const double x = shape.position.x;
  const double y = shape.position.y;
  switch (shape.kind)
  {
    case Shape::Kind::rectangle:
      text << x << ' ' << y << ' ' << shape.size.width << ' ' << shape.size.height << " re f\n";
      break;
    case Shape::Kind::circle: {
      const double r = shape.size.width;
      const double k = BEZIER_QUARTER * r;
      text << x + r << ' ' << y << " m " << x + r << ' ' << y + k << ' ' << x + k << ' ' << y + r << ' ' << x << ' '
           << y + r << " c " << x - k << ' ' << y + r << ' ' << x - r << ' ' << y + k << ' ' << x - r << ' ' << y
           << " c " << x - r << ' ' << y - k << ' ' << x - k << ' ' << y - r << ' ' << x << ' ' << y - r << " c "
           << x + k << ' ' << y - r << ' ' << x + r << ' ' << y - k << ' ' << x + r << ' ' << y << " c f\n";
      break;
    }
    case Shape::Kind::text:
      text << "BT /F1 " << shape.size.height << " Tf 1 0 0 -1 " << x << ' ' << y << " Tm (" << escapedForPdf(shape.text)
           << ") Tj ET\n";
      break;
  }
  return text.str();
}

/** Blends a colour into the image by the share of each pixel that a shape covers [0, 1]. */
template <typename Coverage>
void paint(cv::Mat& image, const cv::Rect2d& bounds, const cv::Vec3b& color, const Coverage& coverage)
{
  const int left = std::max(0, static_cast<int>(std::floor(bounds.x)));
  const int top = std::max(0, static_cast<int>(std::floor(bounds.y)));
  const int right = std::min(image.cols, static_cast<int>(std::ceil(bounds.br().x)));
  const int bottom = std::min(image.rows, static_cast<int>(std::ceil(bounds.br().y)));
  for (int y = top; y < bottom; ++y)
  {
    for (int x = left; x < right; ++x)
    {
      auto& pixel = image.at<cv::Vec3b>(y, x);
      const double share = coverage(x, y);
      pixel = cv::Vec3b(cv::Vec3d(pixel) * (1 - share) + cv::Vec3d(color) * share);
    }
  }
}

double overlap(double from, double to, int pixel)
{
  return std::max(0., std::min(to, pixel + 1.) - std::max<double>(from, pixel));
}

void paintRectangle(cv::Mat& image, const Shape& shape, double scale)
{
  const cv::Rect2d box(scale * shape.position, scale * (shape.position + cv::Point2d(shape.size)));
  paint(image, box, shape.color,
        [&](int x, int y) { return overlap(box.x, box.br().x, x) * overlap(box.y, box.br().y, y); });
}

void paintCircle(cv::Mat& image, const Shape& shape, double scale)
{
  const cv::Point2d center = scale * shape.position;
  const double radius = scale * shape.size.width;
  const cv::Point2d reach(radius + 1, radius + 1);
  paint(image, cv::Rect2d(center - reach, center + reach), shape.color, [&](int x, int y) {
    const double distance = std::hypot(x + 0.5 - center.x, y + 0.5 - center.y);
    return std::min(1., std::max(0., radius - distance + 0.5));
  });
}

void paintText(cv::Mat& image, const Shape& shape, double scale)
{
  const int font = cv::FONT_HERSHEY_SIMPLEX;
  const int thickness = std::max(1, cvRound(0.1 * scale * shape.size.height));
  const double font_scale = cv::getFontScaleFromHeight(font, cvRound(0.72 * scale * shape.size.height), thickness);
  cv::putText(image, shape.text, scale * shape.position, font, font_scale, cv::Scalar(shape.color), thickness,
              cv::LINE_AA);
}

/** A PDF file of the given objects, the first of which is the catalogue; the table gives each object's offset. */
std::string pdfFile(const std::vector<std::string>& objects)
{
  std::ostringstream file;
  std::ostringstream table;
  file << "%PDF-1.4\n";
  table << "xref\n0 " << objects.size() + 1 << "\n0000000000 65535 f \n";
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    table << std::setw(10) << std::setfill('0') << file.tellp() << " 00000 n \n";
    file << i + 1 << " 0 obj\n" << objects[i] << "\nendobj\n";
  }
  const auto table_offset = file.tellp();
  file << table.str() << "trailer\n<< /Size " << objects.size() + 1 << " /Root 1 0 R >>\nstartxref\n"
       << table_offset << "\n%%EOF\n";
  return file.str();
}
}  // namespace

std::string toSvg(const Sheet& sheet)
{
  const cv::Size2d& page = sheet.page;
  std::ostringstream view;
  view << "0 0 " << page.width << ' ' << page.height;
  std::ostringstream text;
  text << "<svg" << attribute("xmlns", "http://www.w3.org/2000/svg") << " width=\"" << page.width << "mm\" height=\""
       << page.height << "mm\"" << attribute("viewBox", view.str()) << ">\n"
       << svgShape({Shape::Kind::rectangle, {255, 255, 255}, {0, 0}, page, ""});
  for (const Shape& shape : sheet.shapes)
  {
    text << svgShape(shape);
  }
  text << "</svg>\n";
  return text.str();
}

std::string toPdf(const Sheet& sheet)
{
  const double width = POINTS_PER_MM * sheet.page.width;
  const double height = POINTS_PER_MM * sheet.page.height;
  std::ostringstream stream;
  stream << std::setprecision(8) << POINTS_PER_MM << " 0 0 " << -POINTS_PER_MM << " 0 " << height << " cm\n";
  for (const Shape& shape : sheet.shapes)
  {
    stream << pdfShape(shape);
  }
  std::ostringstream page;
  page << std::setprecision(8) << "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " << width << ' ' << height
       << "] /Contents 4 0 R /Resources << /Font << /F1 5 0 R >> >> >>";
  const std::string content = stream.str();
  return pdfFile({"<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>",
                  "<< /Type /Pages /Kids [3 0 R] /Count 1 >>", page.str(),
                  "<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content + "endstream",
                  "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"});
}

cv::Mat toImage(const Sheet& sheet, double dpi)
{
  if (!(dpi >= 20 && dpi <= 1200))
  {
    throw std::invalid_argument("the resolution is 20 to 1200 dpi");
  }
  const double scale = dpi / MM_PER_INCH;
  constexpr double MOST_PIXELS = 1e9;
  if (scale * scale * sheet.page.area() > MOST_PIXELS)
  {
    throw std::invalid_argument("the picture would have more than 1e9 pixels: lower --dpi, or write .svg or .pdf");
  }
  cv::Mat image(cvRound(scale * sheet.page.height), cvRound(scale * sheet.page.width), CV_8UC3, cv::Scalar::all(255));
  for (const Shape& shape : sheet.shapes)
  {
    switch (shape.kind)
    {
      case Shape::Kind::rectangle:
        paintRectangle(image, shape, scale);
        break;
      case Shape::Kind::circle:
        paintCircle(image, shape, scale);
        break;
      case Shape::Kind::text:
        paintText(image, shape, scale);
        break;
    }
  }
  return image;
}

}  // namespace omr
