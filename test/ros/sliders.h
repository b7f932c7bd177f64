#ifndef OUTDOOR_OMR_TEST_SLIDERS_H
#define OUTDOOR_OMR_TEST_SLIDERS_H

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/config_tools.h>

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>

#include "outdoor_omr/settings.h"

namespace ros_test
{
/** A value other than the default, as text; every tunable has one. */
inline std::string otherValue(const omr::Parameter& parameter)
{
  const std::string value = omr::getParameter(omr::Settings(), parameter.name);
  if (parameter.type == "bool")
  {
    return value == "true" ? "false" : "true";
  }
  if (parameter.type == "choice")
  {
    return parameter.choices.front() == value ? parameter.choices.back() : parameter.choices.front();
  }
  std::ostringstream bound;
  bound << std::setprecision(10) << (std::stod(value) == parameter.max ? parameter.min : parameter.max);
  return bound.str();
}

inline const omr::Parameter& parameterNamed(const std::string& name)
{
  const auto& all = omr::parameters();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  if (found == all.end())
  {
    throw std::invalid_argument("no parameter " + name);
  }
  return *found;
}

/** The request that moves one slider. */
inline dynamic_reconfigure::Config requestFor(const std::string& name, const std::string& value)
{
  using dynamic_reconfigure::ConfigTools;
  dynamic_reconfigure::Config request;
  const std::string& type = parameterNamed(name).type;
  if (type == "bool")
  {
    ConfigTools::appendParameter(request, name, value == "true");
  }
  else if (type == "int")
  {
    ConfigTools::appendParameter(request, name, std::stoi(value));
  }
  else if (type == "double")
  {
    ConfigTools::appendParameter(request, name, std::stod(value));
  }
  else
  {
    ConfigTools::appendParameter(request, name, value);
  }
  return request;
}

/** Where one slider stands, as text. */
inline std::string valueIn(const dynamic_reconfigure::Config& config, const std::string& name)
{
  using dynamic_reconfigure::ConfigTools;
  std::ostringstream text;
  text << std::boolalpha << std::setprecision(10);
  bool truth = false;
  int integer = 0;
  double number = 0;
  std::string word;
  if (ConfigTools::getParameter(config, name, truth))
  {
    text << truth;
  }
  else if (ConfigTools::getParameter(config, name, integer))
  {
    text << integer;
  }
  else if (ConfigTools::getParameter(config, name, number))
  {
    text << number;
  }
  else if (ConfigTools::getParameter(config, name, word))
  {
    text << word;
  }
  return text.str();
}

}  // namespace ros_test

#endif
