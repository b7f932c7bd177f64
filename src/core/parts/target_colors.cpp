#include "target_colors.h"

#include <algorithm>

namespace omr
{
namespace
{
bool agree(std::string_view seen, std::string_view expected)
{
  return std::equal(seen.begin(), seen.end(), expected.begin(), expected.end(),
                    [](char a, char b) { return a == b || a == '?'; });
}
}  // namespace

ColorMatch compareColors(std::string_view seen, std::string_view expected)
{
  if (agree(seen, expected))
  {
    return ColorMatch::agree;
  }
  if (seen.size() > expected.size())
  {
    const bool is_inner = agree(seen.substr(0, expected.size()), expected);
    const bool is_outer = agree(seen.substr(seen.size() - expected.size()), expected);
    return is_inner || is_outer ? ColorMatch::unclear : ColorMatch::contradict;
  }
  // An outermost ring that is hidden.
  if (seen.size() > 2 && agree(seen, expected.substr(0, seen.size())))
  {
    return ColorMatch::unclear;
  }
  // Of rings that run together the innermost letter is a mixture.
  const bool outer_agree = seen.size() > 2 && seen.size() < expected.size() &&
                           agree(seen.substr(1), expected.substr(expected.size() - seen.size() + 1));
  return outer_agree ? ColorMatch::unclear : ColorMatch::contradict;
}

}  // namespace omr
