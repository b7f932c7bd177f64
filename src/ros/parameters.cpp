#include "parameters.h"

#include <XmlRpcValue.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

#include "caught.h"

namespace omr
{
namespace
{
/** What others read in the same namespace: this nodelet, image_transport, diagnostic_updater and the nodelet loader. */
const std::array<const char*, 6> OTHER_PARAMETERS = {"device",          "candidate_network", "overlay",
                                                     "image_transport", "diagnostic_period", "num_worker_threads"};

/** The value as setParameter() reads it. */
std::string text(const XmlRpc::XmlRpcValue& value)
{
  XmlRpc::XmlRpcValue copy = value;  // its conversions are not const
  switch (copy.getType())
  {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return static_cast<bool>(copy) ? "true" : "false";
    case XmlRpc::XmlRpcValue::TypeString:
      return static_cast<std::string&>(copy);
    case XmlRpc::XmlRpcValue::TypeInt:
    case XmlRpc::XmlRpcValue::TypeDouble: {
      std::ostringstream stream;
      copy.write(stream);
      return stream.str();
    }
    default:
      throw std::invalid_argument("it is not a single value");
  }
}

/** Numbers and truth values that a yaml file has as text, as "60" and 1e-3, are ignored by dynamic_reconfigure. */
void setTyped(const ros::NodeHandle& private_nh, const std::string& name, const Settings& settings)
{
#define OMR_BOOL(known, value, group, description) \
  if (name == #known)                              \
    private_nh.setParam(name, settings.known);
#define OMR_INT(known, value, min, max, group, unit, description) \
  if (name == #known)                                             \
    private_nh.setParam(name, settings.known);
#define OMR_DOUBLE(known, value, min, max, group, unit, description) \
  if (name == #known)                                                \
    private_nh.setParam(name, settings.known);
#define OMR_CHOICE(known, type, value, values, group, description)
#include "outdoor_omr/settings.def"
#undef OMR_BOOL
#undef OMR_INT
#undef OMR_DOUBLE
#undef OMR_CHOICE
}

std::vector<std::string> tunables()
{
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters())
  {
    names.push_back(parameter.name);
  }
  return names;
}

template <typename Names>
bool contains(const Names& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}
}  // namespace

Settings toSettings(const outdoor_omr::OmrConfig& config)
{
  Settings settings;
#define OMR_BOOL(name, value, group, description) settings.name = config.name;
#define OMR_INT(name, value, min, max, group, unit, description) settings.name = config.name;
#define OMR_DOUBLE(name, value, min, max, group, unit, description) settings.name = config.name;
#define OMR_CHOICE(name, type, value, values, group, description) setParameter(settings, #name, config.name);
#include "outdoor_omr/settings.def"
#undef OMR_BOOL
#undef OMR_INT
#undef OMR_DOUBLE
#undef OMR_CHOICE
  settings.check();
  return settings;
}

std::vector<std::string> checkParameters(const ros::NodeHandle& private_nh)
{
  std::vector<std::string> complaints;
  XmlRpc::XmlRpcValue found;
  if (!private_nh.getParam("", found) || found.getType() != XmlRpc::XmlRpcValue::TypeStruct)
  {
    return complaints;
  }
  std::vector<std::string> known = tunables();
  known.insert(known.end(), OTHER_PARAMETERS.begin(), OTHER_PARAMETERS.end());
  for (const auto& entry : found)
  {
    const std::string& name = entry.first;
    if (!contains(known, name))
    {
      complaints.push_back("there is no parameter '" + private_nh.resolveName(name) + "'; the nearest name is '" +
                           nearestName(name, known) + "'");
    }
    else if (!contains(OTHER_PARAMETERS, name))
    {
      Settings settings;
      const std::string error = caught([&] {
        setParameter(settings, name, text(entry.second));
        setTyped(private_nh, name, settings);
      });
      if (!error.empty())
      {
        complaints.push_back(private_nh.resolveName(name) + ": " + error + "; the default " +
                             getParameter(Settings(), name) + " stays");
        private_nh.deleteParam(name);
      }
    }
  }
  return complaints;
}

}  // namespace omr
