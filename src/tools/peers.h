#ifndef OUTDOOR_OMR_TOOLS_PEERS_H
#define OUTDOOR_OMR_TOOLS_PEERS_H

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "race.h"

namespace omr
{
// What others offer for the same job. Each takes the image (H x W, CV_8UC3) that ours takes.

Contestant gaussianPeer(int size);
Contestant medianPeer(int size);

/** cv::Sobel in x and in y, without what makes edges of the two. */
Contestant sobelPeer();

/** The edges (CV_8UC1, 0 = region) that an image stands for. */
using EdgesOf = std::function<cv::Mat(const cv::Mat& image)>;

/** cv::connectedComponents, 4-way, of what is no edge. */
Contestant componentsPeer(const EdgesOf& edges_of);

/** cv::connectedComponentsWithStats, 4-way: area, box and centre. */
Contestant componentsWithStatsPeer(const EdgesOf& edges_of);

/** Gaussian 3x3, Sobel twice and connectedComponentsWithStats: the pipeline but for what makes edges of the Sobels. */
Contestant chainPeer(const EdgesOf& edges_of);

/** memcpy of the image: the physical limit of whatever reads it. */
Contestant memcpyPeer();

/**
 * Detectors of whole markers: OpenCV's findChessboardCornersSB, which is told the size, and those that were installed
 * when this was compiled: mrgingham (told the longer side; it knows square boards only) and AprilTag 3 (36h11, at full
 * resolution, two threads).
 *
 * @param squares columns and rows of squares of the board that they look for.
 */
std::vector<Contestant> detectorPeers(const cv::Size& squares);

}  // namespace omr

#endif
