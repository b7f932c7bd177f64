#include "parameter_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <vector>

#include "outdoor_omr/settings.h"

namespace omr
{
namespace
{
using Row = std::array<std::string, 5>;

std::string boundsText(const Parameter& parameter)
{
  if (parameter.type == "bool")
  {
    return "true, false";
  }
  std::ostringstream text;
  if (parameter.type == "choice")
  {
    for (const std::string& choice : parameter.choices)
    {
      text << (choice == parameter.choices.front() ? "" : ", ") << choice;
    }
  }
  else
  {
    text << std::setprecision(9) << parameter.min << " to " << parameter.max;
  }
  return text.str();
}

/** A bar would end the table's cell. */
std::string escaped(const std::string& text)
{
  std::string result;
  for (const char letter : text)
  {
    result += letter == '|' ? "\\|" : std::string(1, letter);
  }
  return result;
}

std::vector<Row> rows()
{
  const Settings defaults;
  std::vector<Row> rows = {{"parameter", "default", "bounds", "unit", "description"}};
  for (const Parameter& parameter : parameters())
  {
    rows.push_back({"`" + parameter.name + "`", getParameter(defaults, parameter.name), boundsText(parameter),
                    parameter.unit, escaped(parameter.description)});
  }
  return rows;
}
}  // namespace

std::string parameterTable()
{
  const std::vector<Row> table = rows();
  std::array<std::size_t, 4> widths = {};  // the description, last, needs no padding
  for (const Row& row : table)
  {
    for (std::size_t i = 0; i < widths.size(); ++i)
    {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::ostringstream text;
  for (std::size_t line = 0; line < table.size(); ++line)
  {
    const Row& row = table[line];
    for (std::size_t i = 0; i < widths.size(); ++i)
    {
      text << "| " << row[i] << std::string(widths[i] - row[i].size(), ' ') << ' ';
    }
    text << "| " << row.back() << " |\n" << (line == 0 ? "|---|---|---|---|---|\n" : "");
  }
  return text.str();
}

}  // namespace omr
