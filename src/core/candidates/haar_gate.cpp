#include <algorithm>
#include <array>

#include "haar_blocks.h"
#include "outdoor_omr/haar_features.h"

namespace omr
{
namespace
{
/**
 * Least contrast of a window, the sum below. It rejects no window that has features: those need 4 * 480 from the
 * differences of neighbours in the quarters, in colour of those in a block, a sum that is three times this one at most.
 * (Neighbours of two blocks differ by no more than each differs from the mean of its block, plus what the means
 * differ.)
 */
constexpr int LEAST_BLOCK_CONTRAST = 640;

/** Inputs beyond this are cut. */
constexpr float LARGEST_INPUT = 6;

struct ColorBlock
{
  HaarBlock light;
  int red, blue, color;
};

ColorBlock colorBlock(const cv::Mat& cells, const cv::Point& at)
{
  const auto* upper = cells.ptr<cv::Vec3s>(at.y) + at.x;
  const auto* lower = cells.ptr<cv::Vec3s>(at.y + 1) + at.x;
  const auto block = [&](int k) { return haarBlock(upper[0][k], upper[1][k], lower[0][k], lower[1][k]); };
  const HaarBlock red = block(1);
  const HaarBlock blue = block(2);
  return {block(0), red.sum, blue.sum, red.across + red.down + blue.across + blue.down};
}
}  // namespace

bool gateInputs(const cv::Mat& cells, const cv::Point& first, float* inputs)
{
  std::array<ColorBlock, HAAR_BLOCKS> blocks = {};
  int sum = 0;
  for (int i = 0; i < HAAR_BLOCKS; ++i)
  {
    blocks[i] = colorBlock(cells, first + 2 * cv::Point(i % 4, i / 4));
    sum += blocks[i].light.sum;
  }
  const int mean = sum / HAAR_BLOCKS;
  int within = 0;
  int between = 0;
  for (const ColorBlock& block : blocks)
  {
    within += block.light.across + block.light.down + block.color;
    between += std::abs(block.light.sum - mean);
  }
  const int contrast = within + between / 2;
  if (contrast < LEAST_BLOCK_CONTRAST)
  {
    return false;
  }
  const float scale = HAAR_BLOCKS / static_cast<float>(contrast);
  for (const ColorBlock& block : blocks)
  {
    for (const int value :
         {block.light.sum - mean, block.red, block.blue, block.light.across, block.light.down, block.color})
    {
      *inputs++ = std::clamp(static_cast<float>(value) * scale, -LARGEST_INPUT, LARGEST_INPUT);
    }
  }
  return true;
}

}  // namespace omr
