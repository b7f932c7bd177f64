#ifndef OUTDOOR_OMR_GPU_KERNEL_SOURCES_H
#define OUTDOOR_OMR_GPU_KERNEL_SOURCES_H

namespace omr
{
/** The files of kernels/, in the order of their dependence; cmake/embed_kernels.cmake writes the definition. */
extern const char* const KERNEL_SOURCES[];
extern const unsigned KERNEL_SOURCE_COUNT;

}  // namespace omr

#endif
