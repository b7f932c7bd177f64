#include "detector_options.h"

#include <stdexcept>

namespace omr
{
void DetectorOptions::addTo(CLI::App& app)
{
  app.add_option("--config", config, "yaml file of parameters");
  app.add_option("--filter", filter, "prefilter: none, gaussian or median");
  app.add_option("--set", set, "name=value of one parameter; may be repeated")->allow_extra_args(false);
  app.add_option("--device", device, "auto, gpu, cpu, reference or part of a device's name");
}

Settings DetectorOptions::settings() const
{
  Settings settings;
  if (!config.empty())
  {
    loadSettings(settings, config);
  }
  if (!filter.empty())
  {
    setParameter(settings, "filter", filter);
  }
  for (const std::string& assignment : set)
  {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos)
    {
      throw std::invalid_argument("--set expects name=value, not '" + assignment + "'");
    }
    setParameter(settings, assignment.substr(0, equals), assignment.substr(equals + 1));
  }
  return settings;
}

}  // namespace omr
