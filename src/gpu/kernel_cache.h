#ifndef OUTDOOR_OMR_GPU_KERNEL_CACHE_H
#define OUTDOOR_OMR_GPU_KERNEL_CACHE_H

#include "device.h"

namespace omr
{
/**
 * Has the kernels for a CPU device of PoCL built by the program omr_compile, which lies in a folder beside this
 * library, once a process: PoCL's compiler takes 150 MB and never gives them back, a process that ends does. PoCL keeps
 * what it has built on the disk, where this process finds it.
 *
 * Without the program, or if it fails, nothing is lost: this process builds the kernels itself.
 *
 * @return whether they are on the disk, as far as is known.
 */
bool fillKernelCache(const Device& device);

}  // namespace omr

#endif
