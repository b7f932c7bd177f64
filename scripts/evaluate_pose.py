#!/usr/bin/env python3
"""evaluate_pose.py SET_DIR [--output results/evaluate_pose] [--references]

Runs omr_position over a set of pictures of one plate, its true pose and camera known, and compares. The part is the
plate's board with both targets. Tables, one row for a range of distances: position error along the ray and across it,
rotation error, how often the true pose lies in the 95 % ellipsoid. Variants:
  exact        the pictures and the calibration as they are
  occluded     30 % of the markers' area painted over, a place of its own in each picture; with what the points that are
               left allow at best (Cramer-Rao)
  noisy        with noise of 12 grey levels: does the covariance follow?
  focal        the calibration's focal length is 0.1 % too long
  principal    the calibration's principal point is 1 px too far right
  references   with --references: OpenCV's findChessboardCornersSB, told the size, and its solvePnP, board alone
A set of boards on cylinders is evaluated another way: each board's position as a flat and as a bent one.
Leaves OUTPUT/report.md and what omr_position said, VARIANT.jsonl.
"""
import argparse
import glob
import json
import os
import subprocess
import sys

import cv2
import numpy as np

import evaluate_curved
from pose_truth import bound_along, error_of, matrix_of, pose_of, project, read_truth, write_camera

RANGES = ((0, 1.25), (1.25, 2), (2, 4), (4, 5.2), (5.2, 100))  # [m]
# 95th percentile of a part's error [mm], along and across the ray, and of its rotation [degrees] that are aimed at.
GOALS = {(0, 1.25): (.1, None, None), (2, 4): (.5, .02, None), (5.2, 100): (1.5, None, .1)}
CHI_SQUARE_6 = 12.592  # of six degrees of freedom; 95 % stay below
FLIP = 5  # [degrees]
OCCLUDED_SHARE = .3
NOISE = 12  # [grey levels]
# What the detector leaves of a corner before it draws any to the others, and of the centre of a target's outermost ring,
# on pictures as they are [px].
CORNER_SIGMA, CENTER_SIGMA = .0145, .015


def write_parts(path, picture):
    """The parts file of the plate, measured in its first picture."""
    board = picture['checkerboards'][0]
    rotation, translation = pose_of(board)
    with open(path, 'w') as file:
        file.write('parts:\n- name: plate\n  checkerboards:\n  - {rows: %d, cols: %d, square: %g}\n  targets:\n'
                   % (board['rows'], board['cols'], board['square_m']))
        for target in picture['targets']:
            center = rotation.T @ (np.array(target['pose']['t']) - translation)
            file.write('  - {colors: %s, ring: %g, xyz: [%.6f, %.6f, %.6f]}\n'
                       % (target['code'], target['ring_m'], *center))


def cover_of(picture, random):
    """The pixels of a rough polygon over 30 % of the area of the part's markers."""
    markers = np.zeros((picture['height'], picture['width']), np.uint8)
    for marker in picture['checkerboards'] + picture['targets']:
        cv2.fillPoly(markers, [np.rint(marker['outline']).astype(int)], 1)
    ys, xs = np.nonzero(markers)
    number = random.integers(len(xs))
    middle = np.array([xs[number], ys[number]])
    angles = (np.arange(9) + random.uniform(-.4, .4, 9)) * 2 * np.pi / 9
    ray = np.column_stack([np.cos(angles), np.sin(angles)]) * random.uniform(.7, 1.3, (9, 1))
    cover = np.zeros_like(markers)
    radius = np.sqrt(len(xs) * OCCLUDED_SHARE / np.pi)
    while cover[ys, xs].mean() < OCCLUDED_SHARE:
        radius *= 1.03
        cover = cv2.fillPoly(np.zeros_like(markers), [np.rint(middle + radius * ray).astype(int)], 1)
    return cover


def occlude(image, picture, random):
    """Paints what hides a part of the markers."""
    cover = cover_of(picture, random)
    color = np.array([60, 90, 120]) * random.uniform(.6, 1.4)
    paint = cv2.GaussianBlur(random.normal(0, 60, image.shape).astype(np.float32), (0, 0), 2) + color
    alpha = cv2.GaussianBlur(cover.astype(np.float32), (0, 0), .8)[..., None]
    return np.clip(image * (1 - alpha) + paint * alpha, 0, 255).astype(np.uint8)


def bounds(pictures):
    """What the points that occlude() leaves bound the error along the ray to."""
    lines = ['| distance [m] | pictures | bound along [mm], 95 %, of all points | of those left |', '|---|---|---|---|']
    first = pictures[0]
    rotation, translation = pose_of(first['checkerboards'][0])
    centers = [rotation.T @ (np.array(target['pose']['t']) - translation) for target in first['targets']]
    board = first['checkerboards'][0]
    x, y = np.meshgrid(np.arange(board['cols'] - 1), np.arange(board['rows'] - 1))
    corners = np.column_stack([x.ravel() - (board['cols'] - 2) / 2, y.ravel() - (board['rows'] - 2) / 2, 0 * x.ravel()])
    points = np.vstack([corners * board['square_m'], centers])
    sigmas = np.array([CORNER_SIGMA] * len(corners) + [CENTER_SIGMA] * len(centers))
    deviations = []
    for number, picture in enumerate(pictures):
        cover = cover_of(picture, np.random.default_rng(number))
        column, row = np.rint(project(picture, points)).astype(int).T
        left = cover[row, column] == 0
        deviations.append((pose_of(picture['checkerboards'][0])[1][2], bound_along(picture, points, sigmas),
                           bound_along(picture, points[left], sigmas[left])))
    deviations = np.array(deviations)
    normal = np.abs(np.random.default_rng(0).normal(size=(4000, 1, 1)))
    for low, high in RANGES:
        some = deviations[(deviations[:, 0] >= low) & (deviations[:, 0] < high)]
        if len(some):
            spread = (normal * some[:, 1:]).reshape(-1, 2)
            lines.append('| %.1f to %.1f | %d | %.3f | %.3f |' % (some[:, 0].min(), some[:, 0].max(), len(some),
                                                                  *np.percentile(spread, 95, axis=0)))
    return '\n'.join(lines) + '\n\n'


def add_noise(image, _, random):
    return np.clip(image + random.normal(0, NOISE, image.shape), 0, 255).astype(np.uint8)


def write_changed(folder, pictures, copies, change):
    """Copies of all pictures, each as change(image, picture, random) makes it; returns their folder."""
    os.makedirs(copies, exist_ok=True)
    for number, picture in enumerate(pictures):
        image = cv2.imread(os.path.join(folder, picture['image']))
        changed = change(image, picture, np.random.default_rng(number))
        cv2.imwrite(os.path.join(copies, picture['image']), changed, [cv2.IMWRITE_JPEG_QUALITY, 95])
    return copies


def locate(folder, pictures, camera, parts, jsonl):
    """Runs omr_position; returns one error of the certain poses and how many pictures are ambiguous."""
    images = [os.path.join(folder, picture['image']) for picture in pictures]
    command = ['omr_position', '--camera', camera, '--parts', parts, '--json', jsonl]
    if subprocess.run(command + images).returncode != 0:
        sys.exit('evaluate_pose: omr_position failed on %s' % folder)
    errors, ambiguous = [], 0
    with open(jsonl) as file:
        for picture, line in zip(pictures, file):
            answer = json.loads(line)
            ambiguous += bool(answer['ambiguous'])
            for part in answer['parts']:
                covariance = np.array(part['covariance']).reshape(6, 6)
                errors.append(error_of(picture['checkerboards'][0], matrix_of(part['orientation']),
                                       np.array(part['position']), covariance))
    return np.array(errors).reshape(-1, 5), ambiguous


def reference(folder, pictures):
    """OpenCV, told the size of the board; of the orders that the board allows it gets the right one told as well."""
    errors = []
    for picture in pictures:
        board = picture['checkerboards'][0]
        size = (board['cols'] - 1, board['rows'] - 1)
        grey = cv2.imread(os.path.join(folder, picture['image']), cv2.IMREAD_GRAYSCALE)
        flags = cv2.CALIB_CB_EXHAUSTIVE | cv2.CALIB_CB_ACCURACY | cv2.CALIB_CB_NORMALIZE_IMAGE
        found, corners = cv2.findChessboardCornersSB(grey, size, flags=flags)
        if not found:
            continue
        x, y = np.meshgrid(np.arange(size[0]) - (size[0] - 1) / 2, np.arange(size[1]) - (size[1] - 1) / 2)
        points = np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()]) * board['square_m']
        camera = np.array(picture['camera_matrix']), np.array(picture['distortion'])
        candidates = []
        for order in (corners, corners[::-1]):
            _, turn, shift = cv2.solvePnP(points, order, *camera, flags=cv2.SOLVEPNP_IPPE)
            turn, shift = cv2.solvePnPRefineLM(points, order, *camera, turn, shift)
            candidates.append(error_of(board, cv2.Rodrigues(turn)[0], shift.ravel()))
        errors.append(min(candidates, key=lambda error: error[3]))
    return np.array(errors)


def percentiles(values):
    return '%.3f | %.3f' % (np.median(values), np.percentile(values, 95))


def table(title, errors, count, ambiguous=0):
    """A variant's table in Markdown."""
    flips = int((errors[:, 3] > FLIP).sum())
    lines = ['## %s' % title, '',
             '%d pictures: %d located, %d ambiguous, %d flips' % (count, len(errors), ambiguous, flips)]
    if not len(errors):
        return '\n'.join(lines) + '\n\n'
    lines += ['', '| distance [m] | pictures | along, median [mm] | 95 % | RMS | across, median [mm] | 95 % '
              '| rotation, median [degrees] | 95 % | true pose in the 95 % ellipsoid |', '|' + '---|' * 10]
    for low, high in RANGES:
        some = errors[(errors[:, 0] >= low) & (errors[:, 0] < high)]
        if not len(some):
            continue
        inside = '' if np.isnan(some[:, 4]).any() else '%.0f %%' % (100 * (some[:, 4] < CHI_SQUARE_6).mean())
        lines.append('| %.1f to %.1f | %d | %s | %.3f | %s | %s | %s |' % (
            some[:, 0].min(), some[:, 0].max(), len(some), percentiles(some[:, 1]),
            np.sqrt((some[:, 1] ** 2).mean()), percentiles(some[:, 2]), percentiles(some[:, 3]), inside))
    relative = errors[:, 1:3] / errors[:, :1]
    lines += ['', 'All distances, mm per metre: along %.3f (median) %.3f (95 %%), across %.4f, %.4f' % (
        np.median(relative[:, 0]), np.percentile(relative[:, 0], 95),
        np.median(relative[:, 1]), np.percentile(relative[:, 1], 95))]
    if not np.isnan(errors[:, 4]).any():
        lines.append('True pose in the 95 %% ellipsoid: %.1f %% of all' % (100 * (errors[:, 4] < CHI_SQUARE_6).mean()))
    return '\n'.join(lines) + '\n\n'


def goals(errors):
    """The 95th percentiles beside what is aimed at."""
    lines = ['## Goals', '', '| distance [m] | what | aimed at | measured |', '|---|---|---|---|']
    for (low, high), aims in GOALS.items():
        some = errors[(errors[:, 0] >= low) & (errors[:, 0] < high)]
        for column, (name, aim) in enumerate(zip(('along [mm]', 'across [mm]', 'rotation [degrees]'), aims), 1):
            if aim is not None and len(some):
                lines.append('| %.1f to %.1f | %s | %g | %.3f |' % (some[:, 0].min(), some[:, 0].max(), name, aim,
                                                                    np.percentile(some[:, column], 95)))
    return '\n'.join(lines) + '\n\n'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('set')
    parser.add_argument('--output', default='results/evaluate_pose')
    parser.add_argument('--references', action='store_true')
    arguments = parser.parse_args()
    if not os.path.isfile(os.path.join(arguments.set, 'truth.json')):
        sets = sorted(glob.glob(os.path.join(arguments.set, '*', 'truth.json')))
        names = [os.path.basename(os.path.dirname(path)) for path in sets]
        sys.exit('evaluate_pose: %s holds no truth.json: give the folder of one set%s'
                 % (arguments.set, ', of those in it: ' + ', '.join(names) if names else ''))
    pictures = read_truth(arguments.set)
    os.makedirs(arguments.output, exist_ok=True)
    boards = [board for picture in pictures for board in picture['checkerboards']]
    if all(board['surface'] == 'cylinder' for board in boards):
        evaluate_curved.evaluate(arguments.set, pictures, arguments.output)
        return
    if len(boards) != len(pictures) or any(board['surface'] != 'plane' for board in boards):
        sys.exit('evaluate_pose: expected one flat board a picture, or boards on cylinders')

    def path(name):
        return os.path.join(arguments.output, name)

    write_parts(path('parts.yaml'), pictures[0])
    occluded = write_changed(arguments.set, pictures, path('occluded'), occlude)
    noisy = write_changed(arguments.set, pictures, path('noisy'), add_noise)
    variants = (('exact', arguments.set, {}), ('occluded', occluded, {}), ('noisy', noisy, {}),
                ('focal', arguments.set, {'focal': 1.001}), ('principal', arguments.set, {'principal': 1.}))
    with open(path('report.md'), 'w') as report:
        for name, folder, mistake in variants:
            write_camera(path(name + '.yaml'), pictures[0], **mistake)
            errors, ambiguous = locate(folder, pictures, path(name + '.yaml'), path('parts.yaml'),
                                       path(name + '.jsonl'))
            text = table(name, errors, len(pictures), ambiguous) + (goals(errors) if name == 'exact' else '')
            text += bounds(pictures) if name == 'occluded' else ''
            print(text, flush=True)
            report.write(text)
        if arguments.references:
            errors = reference(arguments.set, pictures)
            text = table('OpenCV SB, told the size, board alone', errors, len(pictures))
            print(text)
            report.write(text)


if __name__ == '__main__':
    main()
