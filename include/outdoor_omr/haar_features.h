#ifndef OUTDOOR_OMR_HAAR_FEATURES_H
#define OUTDOOR_OMR_HAAR_FEATURES_H

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/**
 * Colour Haar features of sliding windows at several scales, from box sums of integral images (paper, section 4.5,
 * Figs. 24 and 25; Viola and Jones 2001). Plain C++: the oracle of kernels/haar.cl, and its place where no OpenCL
 * device is.
 *
 * A window is a square of 8 x 8 cells; at level k a cell has 2^(k+1) px. Windows lie 2 cells apart. A window suits
 * squares of 1.45 to 3.1 cells and rings of 0.9 to 1.9 cells, so that every size has its level.
 */
constexpr int WINDOW_CELLS = 8;
constexpr int WINDOW_STRIDE = 2;  ///< [cells]
constexpr int HAAR_LEVELS = 6;

constexpr int HAAR_SHIFTS =
    40;  ///< ways from a cell to another one: dx in 0 .. 4, dy in -4 .. 4, one of each two opposite
constexpr int HAAR_BLOCKS = 16;  ///< blocks of 2 x 2 cells
constexpr int BLOCK_FEATURES = 6;
constexpr int FIRST_BLOCK_FEATURE = HAAR_SHIFTS + 12;
constexpr int FIRST_CELL_FEATURE = FIRST_BLOCK_FEATURE + HAAR_BLOCKS * BLOCK_FEATURES;
constexpr int HAAR_FEATURES = FIRST_CELL_FEATURE + WINDOW_CELLS * WINDOW_CELLS;

/** Side of a cell [px]. */
constexpr int cellSize(int level)
{
  return 2 << level;
}

/** Columns and rows of windows; empty where the image is smaller than one. @param size of the image [px]. */
cv::Size windowGrid(const cv::Size& size, int level);

/** The pixels of a window. @param index column and row in windowGrid(). */
cv::Rect windowRect(const cv::Point& index, int level);

/** What kernels and plain C++ look up. */
struct HaarTables
{
  /** Brightness in 1/256 octaves over the mean of a cell [quarters of a grey level]: log2(1 + mean / 96). */
  std::array<std::int16_t, 1021> logarithm;

  /** The shifts ordered by length. Those of a band have about the same length. */
  std::array<std::uint8_t, HAAR_SHIFTS> by_length;
  std::array<std::uint8_t, 6> bands;  ///< first of each band in by_length, and the end

  /** Two shifts that cross each other, their sum and their difference. */
  struct Crossing
  {
    std::uint8_t first, second, sum, difference;
  };
  std::vector<Crossing> crossings;
};

const HaarTables& haarTables();

/**
 * The brightness of all whole cells of a level, from the top left; in a logarithmic scale, so that light and shadow add
 * a constant.
 *
 * @param integral  of an image of H x W px: (H + 1) x (W + 1), CV_32SC3 modulo 2^32, as cv::integral() gives it.
 * @return          CV_16SC3: b + g + r, r - g and b - g, each a HaarTables::logarithm.
 */
cv::Mat haarCells(const cv::Mat& integral, int level);

/**
 * The features of one window. Its main plane is that of the three in which neighbours differ most: brightness, but of
 * pale rings a colour difference. All are relative to the window's contrast, the mean of the 40 differences, unless
 * noted:
 *   - 40 mean differences |main plane at a cell - at the cell at a shift|, ascending within a band of shifts, so
 *     that a turn of the marker drops out: squares and rings repeat, clutter does not;
 *   - how much two shifts that cross differ from their sum and difference: 1 for a checkerboard of any turn and tilt;
 *   - the contrast itself [octaves]; the first two moments of the main plane;
 *   - three of the smallest mean differences from the window turned by 180 degrees about one of 25 points near its
 *     centre, and three from the negative of it: rings have the one symmetry, checkerboards have both;
 *   - of either colour difference the mean deviation;
 *   - of each block the mean of the main plane, the two colour differences [octaves], and the Haar responses across,
 *     down, and in colour;
 *   - of each cell the main plane, from its mean.
 *
 * @param cells    as haarCells() gives them.
 * @param first    the window's first cell.
 * @param features receives HAAR_FEATURES values of the order of 1.
 * @return         whether there is enough contrast for a marker in all four quarters, in brightness and colour; if not,
 * features is not written.
 */
bool haarFeatures(const cv::Mat& cells, const cv::Point& first, float* features);

/** Inputs of the first look: of each block, the six block features above without what is costly. */
constexpr int GATE_INPUTS = HAAR_BLOCKS * BLOCK_FEATURES;

/**
 * What decides at a first look whether a window is worth its features: of each block its mean brightness, the two
 * colour differences, and the Haar responses across, down, and in colour; all relative to the contrast within and
 * between the blocks. Neighbouring windows share blocks, so kernels compute them once.
 *
 * @param inputs receives GATE_INPUTS values of the order of 1.
 * @return       false where there is so little contrast that haarFeatures() gives none; inputs is not written then.
 */
bool gateInputs(const cv::Mat& cells, const cv::Point& first, float* inputs);

}  // namespace omr

#endif
