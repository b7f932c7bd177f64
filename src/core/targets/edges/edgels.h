#ifndef OUTDOOR_OMR_CORE_EDGELS_H
#define OUTDOOR_OMR_CORE_EDGELS_H

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** Edge element: a point of an edge with sub-pixel position and the direction of its gradient. */
struct Edgel
{
  float x, y;    ///< [px], pixel (0, 0) has its centre at (0, 0)
  float nx, ny;  ///< unit gradient of the strongest colour channel, towards the brighter side
};

/** Edgels of a tile, each of their values side by side: loops over them take several at once. */
class EdgelTile
{
 public:
  std::size_t size() const
  {
    return values_.size() / 4;
  }
  const float* x() const
  {
    return values_.data();
  }
  const float* y() const
  {
    return values_.data() + size();
  }
  const float* nx() const
  {
    return values_.data() + 2 * size();
  }
  const float* ny() const
  {
    return values_.data() + 3 * size();
  }
  Edgel operator[](std::size_t i) const
  {
    return {x()[i], y()[i], nx()[i], ny()[i]};
  }

  /** Writes all. @return what follows them. */
  Edgel* copyTo(Edgel* edgels) const
  {
    const std::size_t count = size();
    const float* values = values_.data();
    for (std::size_t i = 0; i < count; ++i)
    {
      edgels[i] = {values[i], values[count + i], values[2 * count + i], values[3 * count + i]};
    }
    return edgels + count;
  }

  void assign(std::size_t count, const float* x, const float* y, const float* nx, const float* ny)
  {
    values_.clear();
    values_.reserve(4 * count);
    for (const float* values : {x, y, nx, ny})
    {
      values_.insert(values_.end(), values, values + count);
    }
  }

 private:
  std::vector<float> values_;
};

/**
 * Edgels of an image, computed in tiles when they are first asked for: most of a picture never is.
 *
 * An edgel is a maximum of the gradient along its own direction, placed by a parabola. The gradient is that of the
 * strongest of B, G and R, as in the fill pipeline's edges (paper, section 3.1).
 *
 * Forks share the tiles and count their looks apart: threads work with one each.
 */
class EdgelMap
{
 public:
  /** @param bgr H x W, CV_8UC3, not empty; shared, not copied. */
  explicit EdgelMap(const cv::Mat& bgr);

  /** Weakest magnitude of an edgel [grey levels]: follows the noise of the picture. */
  float threshold() const
  {
    return threshold_;
  }

  /** Takes edgels only from this multiple of the threshold on; before the first visit. */
  void raiseThreshold(float factor)
  {
    threshold_ *= factor;
  }

  /** Edgels looked at so far, a tile's first visit counting as a hundred: the measure of the work done, whoever else
   * has visited the tile before. */
  std::size_t looks() const
  {
    return looks_;
  }

  /** A copy for work that may be thrown away, or done beside other work. */
  EdgelMap fork() const
  {
    EdgelMap copy = *this;
    copy.looks_before_ = looks_;
    return copy;
  }

  /** Counts what a fork has looked at and visited. */
  void join(const EdgelMap& fork);

  bool isSpent() const
  {
    return looks_ > max_looks_;
  }

  /** After so many the work is to end; isSpent() tells. */
  void setMaxLooks(std::size_t max_looks)
  {
    max_looks_ = max_looks;
  }

  /** Calls visitor(const Edgel&) for each edgel with left <= x <= right and top <= y <= bottom. */
  template <typename Visitor>
  void visit(double left, double top, double right, double bottom, Visitor&& visitor)
  {
    const auto visit_tile = [&](const EdgelTile& tile) {
      for (std::size_t i = 0; i < tile.size(); ++i)
      {
        const Edgel edgel = tile[i];
        if (edgel.x >= left && edgel.x <= right && edgel.y >= top && edgel.y <= bottom)
        {
          visitor(edgel);
        }
      }
    };
    visitTiles(left, top, right, bottom, visit_tile);
  }

  /** Computes all tiles, in OpenCV's threads; that counts no looks. */
  void computeAll();

  /** Calls visitor(const EdgelTile&) for the tiles that hold all edgels of an area, and others beside it. */
  template <typename Visitor>
  void visitTiles(double left, double top, double right, double bottom, Visitor&& visitor)
  {
    const auto all = [](const cv::Rect2d&) { return true; };
    visitWanted(left, top, right, bottom, all, visitor);
  }

  /** The same, without the tiles that are not wanted. @param is_wanted(const cv::Rect2d&) where a tile's edgels lie */
  template <typename IsWanted, typename Visitor>
  void visitWanted(double left, double top, double right, double bottom, const IsWanted& is_wanted, Visitor&& visitor)
  {
    const cv::Rect tiles = tilesOf(left, top, right, bottom);
    for (int row = tiles.y; row < tiles.y + tiles.height; ++row)
    {
      for (int col = tiles.x; col < tiles.x + tiles.width; ++col)
      {
        if (is_wanted(areaOf(col, row)))
        {
          visitTile(col, row, visitor);
        }
      }
    }
  }

 private:
  struct Tile
  {
    std::atomic<bool> is_computed{false};
    EdgelTile edgels;
  };

  /** What copies share. */
  struct Tiles
  {
    Tiles(cv::Mat image, const cv::Size& size);

    cv::Mat bgr;
    cv::Size grid;
    std::vector<Tile> tiles;
    std::array<std::mutex, 16> locks;  // a tile has one of them while it is computed
  };

  template <typename Visitor>
  void visitTile(int col, int row, Visitor&& visitor)
  {
    const EdgelTile& edgels = tile(col, row);
    looks_ += edgels.size();
    visitor(edgels);
  }

  cv::Rect tilesOf(double left, double top, double right, double bottom) const;
  static cv::Rect2d areaOf(int col, int row);
  const EdgelTile& tile(int col, int row);
  void compute(int col, int row, EdgelTile& edgels) const;

  std::shared_ptr<Tiles> shared_;
  std::vector<char> visited_;  // per tile
  float threshold_ = 0;
  std::size_t looks_ = 0;
  std::size_t looks_before_ = 0;  // the fork
  std::size_t max_looks_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace omr

#endif
