#include "angle_bins.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace omr
{
double share(AngleBins bins)
{
  return countOf(bins) / static_cast<double>(ANGLE_BINS);
}

AngleBins turned(AngleBins bins, int by)
{
  return by == 0 ? bins : bins << by | bins >> (ANGLE_BINS - by);
}
double onesidedness(AngleBins bins)
{
  cv::Point2d sum;
  for (int angle = 0; angle < ANGLE_BINS; ++angle)
  {
    const double phi = 2 * CV_PI * angle / ANGLE_BINS;
    sum += (bins >> angle & 1) != 0 ? cv::Point2d(std::cos(phi), std::sin(phi)) : cv::Point2d();
  }
  return cv::norm(sum) / std::max(1, countOf(bins));
}

double widestGap(AngleBins bins)
{
  int widest = 0;
  for (; bins != 0 && ~bins != 0; ++widest)
  {
    bins |= turned(bins, 1);
  }
  return bins == 0 ? 1 : widest / static_cast<double>(ANGLE_BINS);
}

int longestRun(AngleBins bins)
{
  int longest = 0;
  int run = 0;
  int gap = 0;
  for (int i = 0; i < 2 * ANGLE_BINS; ++i)
  {
    if ((bins >> (i % ANGLE_BINS) & 1) != 0)
    {
      run += 1 + gap;
      gap = 0;
      longest = std::max(longest, run);
    }
    else if (run > 0 && gap == 0)
    {
      gap = 1;
    }
    else
    {
      run = gap = 0;
    }
  }
  return std::min(longest, ANGLE_BINS);
}

}  // namespace omr
