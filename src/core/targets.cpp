#include "outdoor_omr/targets.h"

namespace outdoor_omr
{
std::vector<Target> findTargets(const Frame& /*frame*/, const RegionMap& /*regions*/, const Settings& /*settings*/)
{
  return {};
}

}  // namespace outdoor_omr
