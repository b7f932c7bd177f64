#ifndef OUTDOOR_OMR_TOOLS_DETECTOR_OPTIONS_H
#define OUTDOOR_OMR_TOOLS_DETECTOR_OPTIONS_H

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "outdoor_omr/settings.h"

namespace omr
{
/** The command line of a program that detects: device and tunables. */
struct DetectorOptions
{
  std::string config;
  std::string filter;
  std::vector<std::string> set;
  std::string device = "auto";

  void addTo(CLI::App& app);

  /** @throws as loadSettings() and setParameter(). */
  Settings settings() const;
};

}  // namespace omr

#endif
