#ifndef OUTDOOR_OMR_CORE_DEFAULT_MARKER_NETWORK_H
#define OUTDOOR_OMR_CORE_DEFAULT_MARKER_NETWORK_H

namespace omr
{
/** The text of config/marker_network.yaml; cmake/embed_text.cmake writes the definition. */
extern const char* const DEFAULT_MARKER_NETWORK;

}  // namespace omr

#endif
