#ifndef OUTDOOR_OMR_CORE_TARGET_COLORS_H
#define OUTDOOR_OMR_CORE_TARGET_COLORS_H

#include <string_view>

namespace omr
{
/** What the colours of a target say of the one that the part has in its place. */
enum class ColorMatch
{
  agree,    ///< unknown letters agree with all
  unclear,  ///< a ring lost or found at the middle or the rim: PRPG for PGRPG at 4 px a ring, ?PGRPG or GRGP half
            ///< hidden
  contradict
};

/** @param seen, expected the letters from the inner disk outwards, those seen with '?'. */
ColorMatch compareColors(std::string_view seen, std::string_view expected);

}  // namespace omr

#endif
