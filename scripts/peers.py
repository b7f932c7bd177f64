#!/usr/bin/env python3
"""peers.py PEER FOLDER OUTPUT.jsonl

Runs another checkerboard detector over a set with ground truth and writes what it found in omr_detect's format.

Peers, all told each board's number of squares by truth.json, which outdoor_omr is not:
  sector       OpenCV's findChessboardCornersSB, exhaustive and accurate
  quads        OpenCV's findChessboardCorners, then cornerSubPix
  mrgingham    boards of as many rows as columns only: it knows no other

None of them returns more than one board, so each looks again with what it found painted over, once for every board.
"""
import argparse
import json
import os
import sys
import time

import cv2
import numpy as np

# Window and end of cornerSubPix as in OpenCV's calibration example.
SUB_PIXEL = ((11, 11), (-1, -1), (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 30, .01))


def find_sector(grey, columns, rows):
    found, corners = cv2.findChessboardCornersSB(grey, (columns, rows), None,
                                                 cv2.CALIB_CB_EXHAUSTIVE | cv2.CALIB_CB_ACCURACY)
    return corners.reshape(-1, 2) if found else None


def find_quads(grey, columns, rows):
    found, corners = cv2.findChessboardCorners(grey, (columns, rows), None,
                                               cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE)
    return cv2.cornerSubPix(grey, corners, *SUB_PIXEL).reshape(-1, 2) if found else None


def find_mrgingham(grey, columns, rows):
    import mrgingham
    corners = mrgingham.find_chessboard(grey, gridn=rows) if rows == columns else None
    return None if corners is None else np.asarray(corners, np.float32).reshape(-1, 2)


PEERS = {'sector': find_sector, 'quads': find_quads, 'mrgingham': find_mrgingham}


def paint_over(grey, corners, columns, rows):
    """Hides the board of these inner corners, its outer squares included, under the grey of its middle."""
    grid = corners.reshape(rows, columns, 2)
    outer = [grid[i, j] + (grid[i, j] - grid[k, m]) * 1.2  # the outer square, and a little of its blur
             for i, j, k, m in ((0, 0, 1, 1), (0, -1, 1, -2), (-1, -1, -2, -2), (-1, 0, -2, 1))]
    cv2.fillConvexPoly(grey, np.round(outer).astype(np.int32), int(grey.mean()))


def detect(find, grey, sizes):
    """The boards found; sizes: (rows, cols) in squares of every board there is."""
    boards = []
    for rows, cols in sizes:
        corners = find(grey, cols - 1, rows - 1)
        if corners is not None:
            boards.append({'rows': rows, 'cols': cols, 'inner_corners': corners.astype(float).round(4).tolist()})
            paint_over(grey, corners, cols - 1, rows - 1)
    return boards


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('peer', choices=sorted(PEERS))
    parser.add_argument('folder')
    parser.add_argument('output')
    arguments = parser.parse_args()
    with open(os.path.join(arguments.folder, 'truth.json')) as file:
        truths = json.load(file)['images']
    with open(arguments.output, 'w') as output:
        for truth in truths:
            path = os.path.join(arguments.folder, truth['image'])
            grey = cv2.imread(path, cv2.IMREAD_GRAYSCALE)
            if grey is None:
                sys.exit('peers: cannot read %s' % path)
            start = time.perf_counter()
            boards = detect(PEERS[arguments.peer], grey, [(board['rows'], board['cols'])
                                                          for board in truth['checkerboards']])
            line = {'image': truth['image'], 'time_ms': round(1e3 * (time.perf_counter() - start), 3),
                    'checkerboards': boards, 'targets': []}
            output.write(json.dumps(line) + '\n')


if __name__ == '__main__':
    main()
