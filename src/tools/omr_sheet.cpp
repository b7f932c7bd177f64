#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "program.h"
#include "sheet.h"
#include "sheet_writers.h"

namespace
{
struct Options
{
  std::vector<std::string> checkerboards;
  omr::SheetContent content;
  std::string page = "A4";
  bool landscape = false;
  double dpi = 300;
  std::vector<std::string> files;
};

/** The bytes of the sheet in the format that the file's extension names. */
std::string encode(const omr::Sheet& sheet, const std::string& file, double dpi)
{
  const std::string extension = std::filesystem::path(file).extension();
  if (extension == ".svg")
  {
    return omr::toSvg(sheet);
  }
  if (extension == ".pdf")
  {
    return omr::toPdf(sheet);
  }
  if (extension == ".png")
  {
    std::vector<unsigned char> bytes;
    cv::imencode(extension, omr::toImage(sheet, dpi), bytes);
    return {bytes.begin(), bytes.end()};
  }
  throw std::invalid_argument("the output is a file .svg, .pdf or .png, not '" + file + "'");
}

void writeFile(const std::string& name, const std::string& bytes)
{
  std::ofstream file(name, std::ios::binary);
  file << bytes << std::flush;
  if (!file)
  {
    throw std::runtime_error("cannot write '" + name + "'");
  }
}

omr::ExitCode run(Options options)
{
  for (const std::string& text : options.checkerboards)
  {
    options.content.checkerboards.push_back(omr::parseCheckerboard(text));
  }
  cv::Size2d page = omr::parsePage(options.page);
  if (options.landscape)
  {
    std::swap(page.width, page.height);
  }
  const omr::Sheet sheet = omr::arrangeSheet(options.content, page);
  for (const std::string& file : options.files)
  {
    writeFile(file, encode(sheet, file, options.dpi));
  }
  for (const std::string& advice : omr::adviceFor(options.content))
  {
    std::cerr << "omr_sheet: note: " << advice << "\n";
  }
  return omr::SUCCESS;
}

void declare(CLI::App& app, Options& options)
{
  app.description("Draws checkerboards and targets at true scale, to be printed.");
  app.add_option("--checkerboard", options.checkerboards, "ROWSxCOLS squares, 5x7 to 21x21; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--square", options.content.square, "side of a square [mm]")->capture_default_str();
  app.add_option("--target", options.content.targets,
                 "ring colours from the inner disk outwards (W white, P black, R red, G green, B blue), for example "
                 "RWPGB; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--ring", options.content.ring, "width of a ring and radius of the inner disk [mm]")
      ->capture_default_str();
  app.add_option("--page", options.page, "A4, A3, A2 or WIDTHxHEIGHT [mm]")->capture_default_str();
  app.add_flag("--landscape", options.landscape, "turns the page by 90 degrees");
  app.add_option("--dpi", options.dpi, "resolution of a PNG")->capture_default_str();
  app.add_option("files", options.files, "files to write: .svg, .pdf or .png")->required();
}
}  // namespace

int main(int argc, char** argv)
{
  return omr::runProgram<Options>("omr_sheet", argc, argv, declare, run);
}
