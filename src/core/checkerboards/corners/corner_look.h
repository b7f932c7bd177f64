#ifndef OUTDOOR_OMR_CORE_CORNER_LOOK_H
#define OUTDOOR_OMR_CORE_CORNER_LOOK_H

#include <opencv2/core.hpp>

#include "local_frame.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/** What the image shows where a corner of squares was predicted. */
struct CornerLook
{
  bool found = false;
  cv::Point2f position;   ///< saddle point [px]
  int sign = 0;           ///< +1: the squares towards +u+v and -u-v are the light ones; -1: the dark ones
  float contrast = 0;     ///< light minus dark squares [grey levels]
  float correlation = 0;  ///< of the ring with four alternating quadrants [0, 1], in grey levels or their logarithm
};

/** What is asked of a corner. */
struct CornerQuery
{
  int sign = 0;               ///< expected sign; 0: any
  float tolerance = 0.25F;    ///< largest deviation from the prediction [squares]
  float contrast = 0;         ///< of the known neighbours [grey levels]; 0: unknown
  float correlation = 0.85F;  ///< the least that is accepted
  bool search = true;         ///< whether to search around a prediction from which no saddle point is reached
};

/**
 * Looks for the common corner of four squares where a lattice predicts it.
 *
 * The saddle point of the grey values is fitted around the prediction, then a ring of 24 samples in the lattice's own
 * frame says whether four alternating squares meet there. The correlation is also taken on logarithms: the edge of a
 * hard shadow multiplies grey values and does not add to them. Every threshold on contrast is relative to the known
 * neighbours, so no grey value is black or white by itself.
 *
 * The looks of one image are counted, because their number bounds the time on clutter.
 */
class CornerLooker
{
 public:
  /** @param frame must outlive this. @param budget largest number of looks. */
  CornerLooker(const Frame& frame, int budget);

  /** Not found, without a look at the image, when the budget is spent. */
  CornerLook look(const LocalFrame& predicted, const CornerQuery& query);

  int looksLeft() const
  {
    return budget_;
  }
  void setLooksLeft(int looks)
  {
    budget_ = looks;
  }
  const Frame& frame() const
  {
    return frame_;
  }

 private:
  const Frame& frame_;
  int budget_;
};

}  // namespace omr

#endif
