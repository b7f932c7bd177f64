#ifndef OUTDOOR_OMR_CANDIDATES_H
#define OUTDOOR_OMR_CANDIDATES_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/marker_network.h"
#include "outdoor_omr/target.h"

namespace omr
{
/** A place where a marker probably is (paper, section 4.5). */
struct Candidate
{
  cv::Rect box;  ///< covers most of the marker [px]
  MarkerKind kind = MarkerKind::checkerboard;
  float score = -1;   ///< largest of its windows, threshold of the network to 1
  int cell = 0;       ///< size of a cell of its windows [px]: squares are 1.5 to 3 cells, rings 1 to 2
  int windows = 0;    ///< number of its windows
  bool read = false;  ///< a checkerboard or target was found there
};

/**
 * Merges the windows that show a marker into boxes, the best first.
 *
 * @param size   of the image [px].
 * @param scores windowScores() of it.
 */
std::vector<Candidate> findCandidates(const cv::Size& size, const std::vector<MarkerScores>& scores,
                                      const MarkerNetwork& network);

/** Marks the candidates that show one of the markers as read. */
void markRead(std::vector<Candidate>& candidates, const std::vector<Checkerboard>& checkerboards,
              const std::vector<Target>& targets);

}  // namespace omr

#endif
