#include "round_windows.h"

#include <algorithm>
#include <cstdint>

#include "targets/edges/pixel_gradients.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int CELL = PixelGradients::COUNT;  // [px]
constexpr int CELL_ROW_STEP = 4;             // of the rows whose gradients stand for a cell
constexpr int FRAME = 2;                     // [cells]
// The weakest of 188 small targets has 15 within 11 px of its centre.
constexpr double MIN_GRADIENT = 12;  // of a window, root mean square [grey levels over two pixels]
constexpr float MIN_ISOTROPY = .4F;  // 4 det / trace^2 of the tensor: circles tilted by 60 degrees have .64

OMR_VECTORIZED void addTo(float* __restrict sums, const float* __restrict row, int count)
{
  for (int i = 0; i < count; ++i)
  {
    sums[i] += row[i];
  }
}

/** @param xx, xy, yy the windows' tensors. */
OMR_VECTORIZED void markWindows(const float* __restrict xx, const float* __restrict xy, const float* __restrict yy,
                                int count, float least, float* __restrict marks)
{
  for (int i = 0; i < count; ++i)
  {
    const float trace = xx[i] + yy[i];
    const float determinant = 4 * (xx[i] * yy[i] - xy[i] * xy[i]);
    const float mark = determinant / std::max(trace, least);
    marks[i] = trace > least && determinant > MIN_ISOTROPY * trace * trace ? mark : 0.F;
  }
}

/** Which marks of a row no neighbour exceeds; not the first and the last. */
OMR_VECTORIZED void findBest(const float* __restrict above, const float* __restrict row, const float* __restrict below,
                             int count, std::int32_t* __restrict is_best)
{
  const auto larger = [](float a, float b) { return a > b ? a : b; };
  for (int i = 1; i + 1 < count; ++i)
  {
    const float before = larger(larger(above[i - 1], row[i - 1]), below[i - 1]);
    const float after = larger(larger(above[i + 1], row[i + 1]), below[i + 1]);
    const float beside = larger(larger(above[i], below[i]), larger(before, after));
    is_best[i] = (row[i] > 0) & (row[i] >= beside) ? 1 : 0;
  }
}
}  // namespace

RoundWindows::RoundWindows(const cv::Mat& grey)
{
  const cv::Size size(grey.cols / CELL, grey.rows / CELL);
  for (cv::Mat1f& tensor : tensors_)
  {
    tensor = cv::Mat1f::zeros(size + cv::Size(2 * FRAME, 2 * FRAME));
  }
  const cv::v_int16x8 all = cv::v_setall_s16(-1);
  const cv::v_int16x8 all_but_first(0, -1, -1, -1, -1, -1, -1, -1);  // the pixels at the image's edge have no gradient
  const cv::v_int16x8 all_but_last(-1, -1, -1, -1, -1, -1, -1, 0);
  for (int row = 0; row < size.height; ++row)
  {
    float* xx = tensors_[0][row + FRAME] + FRAME;
    float* xy = tensors_[1][row + FRAME] + FRAME;
    float* yy = tensors_[2][row + FRAME] + FRAME;
    for (int col = 0; col < size.width; ++col)
    {
      const cv::v_int16x8 inside = col == 0 ? all_but_first : (col + 1) * CELL == grey.cols ? all_but_last : all;
      cv::v_int32x4 sum_xx = cv::v_setzero_s32();
      cv::v_int32x4 sum_xy = sum_xx;
      cv::v_int32x4 sum_yy = sum_xx;
      for (int y = row * CELL + 1; y < (row + 1) * CELL; y += CELL_ROW_STEP)
      {
        const PixelGradients gradients(grey.ptr(y) + col * CELL, grey.step);
        const cv::v_int16x8 x = gradients.x & inside;
        const cv::v_int16x8 y_inside = gradients.y & inside;
        sum_xx += cv::v_dotprod(x, x);
        sum_xy += cv::v_dotprod(x, y_inside);
        sum_yy += cv::v_dotprod(y_inside, y_inside);
      }
      xx[col] = static_cast<float>(cv::v_reduce_sum(sum_xx));
      xy[col] = static_cast<float>(cv::v_reduce_sum(sum_xy));
      yy[col] = static_cast<float>(cv::v_reduce_sum(sum_yy));
    }
  }
}

cv::Mat1f RoundWindows::marks(int reach) const
{
  const int side = 2 * reach + 1;
  const auto least = static_cast<float>(MIN_GRADIENT * MIN_GRADIENT * (side * CELL) * (side * CELL) / CELL_ROW_STEP);
  cv::Mat1f marks(tensors_[0].rows - 2 * FRAME, tensors_[0].cols - 2 * FRAME);
  std::array<std::vector<float>, 3> windows;
  std::vector<float> columns;
  for (int row = 0; row < marks.rows; ++row)
  {
    for (std::size_t k = 0; k < tensors_.size(); ++k)
    {
      columns.assign(tensors_[k].cols, 0.F);
      for (int y = 0; y < side; ++y)
      {
        addTo(columns.data(), tensors_[k][row + FRAME - reach + y], tensors_[k].cols);
      }
      windows[k].assign(marks.cols, 0.F);
      for (int x = 0; x < side; ++x)
      {
        addTo(windows[k].data(), columns.data() + FRAME - reach + x, marks.cols);
      }
    }
    markWindows(windows[0].data(), windows[1].data(), windows[2].data(), marks.cols, least, marks[row]);
  }
  return marks;
}

std::vector<cv::Point2d> RoundWindows::strongest(int reach) const
{
  const cv::Mat1f marks = this->marks(reach);
  std::vector<cv::Point2d> middles;
  std::vector<std::int32_t> is_best(marks.cols);
  std::vector<int> cols(marks.cols);
  for (int row = 1; row + 1 < marks.rows; ++row)
  {
    findBest(marks[row - 1], marks[row], marks[row + 1], marks.cols, is_best.data());
    // Listed without a branch: which they are cannot be foreseen.
    std::size_t count = 0;
    for (int col = 1; col + 1 < marks.cols; ++col)
    {
      cols[count] = col;
      count += is_best[col] != 0 ? 1 : 0;
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      middles.emplace_back((cols[k] + .5) * CELL - .5, (row + .5) * CELL - .5);
    }
  }
  return middles;
}

}  // namespace omr
