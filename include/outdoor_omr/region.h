#ifndef OUTDOOR_OMR_REGION_H
#define OUTDOOR_OMR_REGION_H

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/**
 * Integer sums over the pixels of one contiguous region; every implementation delivers the same bits of all but the
 * distances, so the device code is compared with the reference with ==.
 *
 * The layout is shared with kernels/record.cl (104 bytes, no padding).
 */
struct RegionSums
{
  std::uint64_t x = 0, y = 0;                  ///< sums of the pixel coordinates
  std::uint64_t xx = 0, xy = 0, yy = 0;        ///< sums of their products
  std::uint64_t blue = 0, green = 0, red = 0;  ///< sums of the filtered image's channels
  std::uint64_t distance = 0;   ///< sum of the distances to the centre [1/4096 px]; not exact: relative error <= 1e-3
  std::int32_t label = 0;       ///< smallest pixel index (row * W + column) of the region
  std::uint32_t area = 0;       ///< number of pixels
  std::uint32_t perimeter = 0;  ///< pixels with an edge pixel among their four neighbours
  std::int32_t min_x = 0, min_y = 0, max_x = 0, max_y = 0;  ///< bounding box, inclusive
  std::uint32_t reserved = 0;
};

/** Region data of one contiguous colour region (paper, Table 1). Pixel (0, 0) has its centre at (0, 0). */
struct Region
{
  int label = 0;                     ///< smallest pixel index (row * W + column) of the region
  int area = 0;                      ///< [px]
  int perimeter = 0;                 ///< pixels next to an edge [px]; the image border is no edge
  cv::Vec3f color;                   ///< mean B, G, R of the filtered image [0, 255]
  cv::Point2d center;                ///< mean pixel position [px]
  double mean_distance = 0;          ///< mean distance of the pixels to the centre, the paper's "mean size" [px]
  double distance_deviation = 0;     ///< standard deviation of that distance, the paper's "mean radius" [px]
  cv::Rect box;                      ///< bounding box [px]
  double cxx = 0, cxy = 0, cyy = 0;  ///< central second moments of the pixels as unit squares [px^2]
};

/** The region data that follow from the sums. */
Region toRegion(const RegionSums& sums);

/** What the fill pipeline knows of one image. */
struct RegionMap
{
  cv::Size size;
  std::vector<Region> regions;  ///< ascending label; only those that Settings::region_min_area, _max_share admit
  int region_count = 0;         ///< all regions, reported or not
  cv::Mat edges;                ///< H x W, CV_8UC1, 255 = edge; empty unless asked for
  cv::Mat labels;               ///< H x W, CV_32SC1, see labelRegions(); empty unless asked for
};

}  // namespace omr

#endif
