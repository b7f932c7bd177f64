#ifndef OUTDOOR_OMR_TOOLS_PARAMETER_TABLE_H
#define OUTDOOR_OMR_TOOLS_PARAMETER_TABLE_H

#include <string>

namespace omr
{
/** All parameters of settings.def with default, bounds, unit and description, as the Markdown table of the README. */
std::string parameterTable();

}  // namespace omr

#endif
