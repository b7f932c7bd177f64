#include "outdoor_omr/settings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

#include "yaml_file.h"

namespace omr
{
namespace
{
std::vector<std::string> split(const std::string& words)
{
  std::istringstream stream(words);
  std::vector<std::string> result;
  for (std::string word; stream >> word;)
  {
    result.push_back(word);
  }
  return result;
}

std::string join(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::string text(bool value)
{
  return value ? "true" : "false";
}

template <typename Number>
std::string text(Number value)
{
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

/** The whole of the text as a number, or the reason why it is none. */
template <typename Number>
Number parse(const std::string& name, const std::string& value, const char* expected)
{
  std::istringstream stream(value);
  Number number;
  char rest = 0;
  if (!(stream >> number) || stream >> rest || !std::isfinite(static_cast<double>(number)))
  {
    throw std::invalid_argument("'" + name + "' is " + expected + ", not '" + value + "'");
  }
  return number;
}

template <typename Number>
void checkBounds(const std::string& name, Number value, Number min, Number max, const std::string& unit)
{
  if (!(value >= min && value <= max))
  {
    throw std::invalid_argument("'" + name + "' = " + text(value) + " is out of bounds: " + text(min) + " to " +
                                text(max) + " " + unit);
  }
}

/** Number of letters to insert, delete or replace to turn a into b; finds the name that was meant. */
std::size_t editDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
  {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

const Parameter& find(const std::string& name)
{
  const std::vector<Parameter>& all = parameters();
  const auto known =
      std::find_if(all.begin(), all.end(), [&](const Parameter& parameter) { return parameter.name == name; });
  if (known != all.end())
  {
    return *known;
  }
  std::vector<std::string> names(all.size());
  std::transform(all.begin(), all.end(), names.begin(), [](const Parameter& parameter) { return parameter.name; });
  throw std::invalid_argument("there is no parameter '" + name + "'; the nearest name is '" + nearestName(name, names) +
                              "'");
}

int choiceIndex(const Parameter& parameter, const std::string& value)
{
  const auto choice = std::find(parameter.choices.begin(), parameter.choices.end(), value);
  if (choice == parameter.choices.end())
  {
    throw std::invalid_argument("'" + parameter.name + "' is one of " + join(parameter.choices) + ", not '" + value +
                                "'");
  }
  return static_cast<int>(choice - parameter.choices.begin());
}

bool parseBool(const std::string& name, const std::string& value)
{
  if (value != "true" && value != "false")
  {
    throw std::invalid_argument("'" + name + "' is true or false, not '" + value + "'");
  }
  return value == "true";
}
}  // namespace

void Settings::check() const
{
#define OMR_BOOL(name, value, group, description)
#define OMR_INT(name, value, min, max, group, unit, description) checkBounds<int>(#name, name, min, max, unit);
#define OMR_DOUBLE(name, value, min, max, group, unit, description) checkBounds<double>(#name, name, min, max, unit);
#define OMR_CHOICE(name, type, value, values, group, description) \
  checkBounds<int>(#name, static_cast<int>(name), 0, static_cast<int>(split(values).size()) - 1, "");
#include "outdoor_omr/settings.def"
#undef OMR_BOOL
#undef OMR_INT
#undef OMR_DOUBLE
#undef OMR_CHOICE
  if (filter_size % 2 == 0)
  {
    throw std::invalid_argument("'filter_size' = " + text(filter_size) + " has no centre pixel: choose 3 or 5");
  }
}

const std::vector<Parameter>& parameters()
{
  static const std::vector<Parameter> PARAMETERS = {
#define OMR_BOOL(name, value, group, description) {#name, "bool", #group, "", description, 0, 0, {}},
#define OMR_INT(name, value, min, max, group, unit, description) \
  {#name, "int", #group, unit, description, min, max, {}},
#define OMR_DOUBLE(name, value, min, max, group, unit, description) \
  {#name, "double", #group, unit, description, min, max, {}},
#define OMR_CHOICE(name, type, value, values, group, description) \
  {#name, "choice", #group, "", description, 0, 0, split(values)},
#include "outdoor_omr/settings.def"
#undef OMR_BOOL
#undef OMR_INT
#undef OMR_DOUBLE
#undef OMR_CHOICE
  };
  return PARAMETERS;
}

std::string nearestName(const std::string& name, const std::vector<std::string>& known)
{
  return *std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return editDistance(a, name) < editDistance(b, name);
  });
}

void setParameter(Settings& settings, const std::string& name, const std::string& value)
{
  const Parameter& parameter = find(name);
  Settings changed = settings;
#define OMR_BOOL(field, value_, group, description) \
  if (name == #field)                               \
  {                                                 \
    changed.field = parseBool(name, value);         \
  }
#define OMR_INT(field, value_, min, max, group, unit, description) \
  if (name == #field)                                              \
  {                                                                \
    changed.field = parse<int>(name, value, "a whole number");     \
  }
#define OMR_DOUBLE(field, value_, min, max, group, unit, description) \
  if (name == #field)                                                 \
  {                                                                   \
    changed.field = parse<double>(name, value, "a number");           \
  }
#define OMR_CHOICE(field, type, value_, values, group, description)   \
  if (name == #field)                                                 \
  {                                                                   \
    changed.field = static_cast<type>(choiceIndex(parameter, value)); \
  }
#include "outdoor_omr/settings.def"
#undef OMR_BOOL
#undef OMR_INT
#undef OMR_DOUBLE
#undef OMR_CHOICE
  changed.check();
  settings = changed;
}

std::string getParameter(const Settings& settings, const std::string& name)
{
  const Parameter& parameter = find(name);
#define OMR_BOOL(field, value, group, description) \
  if (name == #field)                              \
  {                                                \
    return text(settings.field);                   \
  }
#define OMR_INT(field, value, min, max, group, unit, description) OMR_BOOL(field, value, group, description)
#define OMR_DOUBLE(field, value, min, max, group, unit, description) OMR_BOOL(field, value, group, description)
#define OMR_CHOICE(field, type, value, values, group, description)         \
  if (name == #field)                                                      \
  {                                                                        \
    return parameter.choices.at(static_cast<std::size_t>(settings.field)); \
  }
#include "outdoor_omr/settings.def"
#undef OMR_BOOL
#undef OMR_INT
#undef OMR_DOUBLE
#undef OMR_CHOICE
  return "";
}

void loadSettings(Settings& settings, const std::string& file)
{
  Settings changed = settings;
  const auto set = [&](const std::string& name, const YamlFile& value) {
    const std::string text = value.text("a single value of '" + name + "'");
    try
    {
      setParameter(changed, name, text);
    }
    catch (const std::invalid_argument& error)
    {
      value.fail(error.what());
    }
  };
  YamlFile::load(file).forEach("a map of 'name: value'", set);
  settings = changed;
}

}  // namespace omr
