#ifndef OUTDOOR_OMR_CORE_BLURRED_DISK_H
#define OUTDOOR_OMR_CORE_BLURRED_DISK_H

namespace omr
{
/**
 * Share of the light of a disk that a point receives through a Gaussian blur.
 *
 * @param r         distance of the point to the disk's centre [px].
 * @param radius    of the disk [px].
 * @param deviation of the blur [px].
 */
double blurredDisk(double r, double radius, double deviation);

}  // namespace omr

#endif
