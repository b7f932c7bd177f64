#ifndef OUTDOOR_OMR_CORE_MEDIAN_H
#define OUTDOOR_OMR_CORE_MEDIAN_H

#include <algorithm>
#include <cstddef>

namespace omr
{
/** The middle one of the values, of an even number the larger. @param values in any order, at least one. */
template <typename Values>
auto median(Values values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** The same of the first `count` values, which it sorts in part. */
template <typename Values>
auto median(Values& values, int count)
{
  std::nth_element(values.begin(), values.begin() + count / 2, values.begin() + count);
  return values[count / 2];
}

}  // namespace omr

#endif
