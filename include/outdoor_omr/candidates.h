#ifndef OUTDOOR_OMR_CANDIDATES_H
#define OUTDOOR_OMR_CANDIDATES_H

#include <array>
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
  cv::Rect box;  ///< covers most of the marker, inside the image [px]
  MarkerKind kind = MarkerKind::checkerboard;
  float score = -1;    ///< largest of its windows, threshold of the network to 1; -1: read, though no window shows it
  int cell = 0;        ///< size of a cell of its windows [px]: squares are 1.5 to 3 cells, rings 1 to 2
  int windows = 0;     ///< number of its windows
  float evidence = 0;  ///< log of the odds that a marker is there, by its windows
  bool read = false;   ///< a checkerboard or target was found there
};

/**
 * What the windows of a candidate tell about it. A marker has windows of a clear score, and they fill its box; texture
 * has weaker ones here and there.
 *   - artanh of the best score;
 *   - log2 of the number of windows;
 *   - log2 of their number in relation to the places for windows in the box.
 */
std::array<float, BOX_FEATURES> boxFeatures(const Candidate& candidate);

/** The evidence that features give for a marker. */
float evidenceOf(const std::array<float, BOX_FEATURES>& features, const BoxEvidence& model);

/**
 * Merges the windows that show a marker into boxes, the best supported first.
 *
 * @param size   of the image [px].
 * @param scores windowScores() of it.
 */
std::vector<Candidate> findCandidates(const cv::Size& size, const std::vector<MarkerScores>& scores,
                                      const MarkerNetwork& network);

/** Removes the candidates that were not read and whose windows give less evidence than the network asks for. */
void removeDoubtful(const MarkerNetwork& network, float BoxEvidence::*least, std::vector<Candidate>& candidates);

/**
 * Marks the candidates that show one of the markers as read. What the image shows of each marker is covered by one
 * then: windows see no more than a part of many a large or shadowed marker that is read, and nothing of some.
 *
 * @param size of the image [px].
 */
void markRead(const cv::Size& size, const std::vector<Checkerboard>& checkerboards, const std::vector<Target>& targets,
              std::vector<Candidate>& candidates);

}  // namespace omr

#endif
