"""Contact sheet of what evaluate.py saw go wrong: a tile for each marker missed, false, found twice or misread.

Left what a person sees there, right the same with the truth (green: found, red: missed, grey: does not count) and what
was detected (yellow). The caption names the picture, what is there and what was read.
"""
import collections
import json
import os

import cv2
import numpy as np

SIDE = 320  # of either half of a tile [px]
CAPTION = 22
COLUMNS = 3
MOST_TILES = 75  # 25 rows of tiles make a picture of 1920 x 8550, which every viewer still opens
MARGIN = .4      # around a marker, of its size
LEAST_MARGIN = 6  # [px]
GREEN, RED, GREY, YELLOW, WHITE = (0, 220, 0), (0, 0, 255), (150, 150, 150), (0, 255, 255), (255, 255, 255)

Marker = collections.namedtuple('Marker', 'outline text color')  # outline: n x 2 [px]; text: size or colours
Failure = collections.namedtuple('Failure', 'outline caption is_minor')  # minor: found, but twice or misread


def size_text(board):
    """Sides in ascending order, as the truth may name them in the other."""
    return '%dx%d' % tuple(sorted((board['rows'], board['cols'])))


def ellipse_outline(center, half_axes, angle):
    """Points of an ellipse whose first half axis lies at angle [rad]."""
    turn = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    along, across = half_axes[0] * np.cos(turn), half_axes[1] * np.sin(turn)
    return np.stack([center[0] + along * np.cos(angle) - across * np.sin(angle),
                     center[1] + along * np.sin(angle) + across * np.cos(angle)], axis=1)


def true_boards(truth, scores):
    return [Marker(np.array(board['outline'], float), size_text(board), truth_color(score))
            for board, score in zip(truth['checkerboards'], scores)]


def true_targets(truth, scores):
    outlines = [ellipse_outline((e['cx'], e['cy']), (e['a'], e['b']), e['theta'])
                for e in (target['ellipse'] for target in truth['targets'])]
    return [Marker(outline, target['code'], truth_color(score))
            for outline, target, score in zip(outlines, truth['targets'], scores)]


def truth_color(score):
    return GREEN if score['hit'] else RED if score['care'] else GREY


def detected_boards(detection):
    return [Marker(np.array(board['corners'], float), size_text(board), YELLOW) for board in detection['checkerboards']]


def detected_targets(detection):
    rings = [(target['rings'][-1], target['colors']) for target in detection['targets']]
    return [Marker(ellipse_outline(ring['center'], np.array(ring['axes']) / 2, np.radians(ring['angle'])), colors, YELLOW)
            for ring, colors in rings]


def contains(marker, other):
    middle = tuple(float(value) for value in other.outline.mean(axis=0))
    return cv2.pointPolygonTest(marker.outline.astype(np.float32), middle, False) >= 0


def failures(truths, detections):
    """Failures among markers of one kind in one picture; those that do not count are none."""
    for truth in truths:
        read = [detection.text for detection in detections if contains(truth, detection)]
        is_right = len(read) == 1 and truth.text in ('', read[0])  # '': a target whose letters the truth does not name
        if truth.color == RED or (truth.color == GREEN and not is_right):
            yield Failure(truth.outline, '%s, read: %s' % (truth.text, ' '.join(read) or '-'), truth.color == GREEN)
    for detection in detections:
        if not any(contains(truth, detection) for truth in truths):
            yield Failure(detection.outline, 'nothing, read: %s' % detection.text, False)


def crop_of(outline):
    """Maps the square around an outline, margin included, to a half of a tile: 2 x 3."""
    low, high = outline.min(axis=0), outline.max(axis=0)
    extent = (high - low).max()
    side = extent + 2 * max(MARGIN * extent, LEAST_MARGIN)
    scale = SIDE / side
    offset = SIDE / 2 - scale * (low + high) / 2
    return np.array([[scale, 0, offset[0]], [0, scale, offset[1]]])


def draw(image, marker, crop):
    points = marker.outline @ crop[:, :2].T + crop[:, 2]
    cv2.polylines(image, [np.round(points * 16).astype(np.int32).reshape(-1, 1, 2)], True, marker.color, 2,
                  cv2.LINE_AA, 4)
    write_text(image, marker.text, points.max(axis=0) if marker.color != YELLOW else points.min(axis=0), marker.color)


def write_text(image, text, position, color):
    """Text whose lower left end is at position, or as near to it as the image holds it."""
    size, _ = cv2.getTextSize(text, cv2.FONT_HERSHEY_SIMPLEX, .45, 1)
    x = int(np.clip(position[0], 2, max(2, image.shape[1] - size[0] - 2)))
    y = int(np.clip(position[1], size[1] + 2, image.shape[0] - 4))
    for shade, thickness in (((0, 0, 0), 3), (color, 1)):
        cv2.putText(image, text, (x, y), cv2.FONT_HERSHEY_SIMPLEX, .45, shade, thickness, cv2.LINE_AA)


def make_tile(image, failure, markers, title):
    crop = crop_of(failure.outline)
    seen = cv2.warpAffine(image, crop, (SIDE, SIDE), flags=cv2.INTER_AREA if crop[0, 0] < 1 else cv2.INTER_LINEAR)
    drawn = seen.copy()
    for marker in markers:
        draw(drawn, marker, crop)
    caption = np.zeros((CAPTION, 2 * SIDE, 3), np.uint8)
    write_text(caption, '%s: %s' % (title, failure.caption), (4, 15), WHITE)
    return np.vstack([caption, np.hstack([seen, drawn])])


def arrange(tiles):
    tiles = tiles + [np.zeros_like(tiles[0])] * (-len(tiles) % COLUMNS)
    return np.vstack([np.hstack(tiles[start:start + COLUMNS]) for start in range(0, len(tiles), COLUMNS)])


def read_detections(folder, set_name, filter_name):
    with open(os.path.join(folder, '%s.%s.jsonl' % (set_name, filter_name))) as file:
        return {os.path.basename(line['image']): line for line in map(json.loads, file)}


def read_truths(data, set_name):
    with open(os.path.join(data, set_name, 'truth.json')) as file:
        return {truth['image']: truth for truth in json.load(file)['images']}


def write(pictures, data, folder):
    """
    Writes failures.jpg into folder, from its *.jsonl; those that are only misread come last.

    Returns how many markers are missed or false, and how many found twice or misread.
    """
    keys = [(picture['set'], picture['factors']['filter']) for picture in pictures]
    truths = {name: read_truths(data, name) for name, _ in set(keys)}
    detections = {key: read_detections(folder, *key) for key in set(keys)}
    failed = []
    for key, picture in zip(keys, pictures):
        truth = truths[key[0]][picture['image']]
        detection = detections[key].get(picture['image'], {'checkerboards': [], 'targets': []})
        kinds = [(true_boards(truth, picture['boards']), detected_boards(detection)),
                 (true_targets(truth, picture['targets']), detected_targets(detection))]
        markers = [marker for kind in kinds for some in kind for marker in some]
        failed += [(picture, failure, markers) for kind in kinds for failure in failures(*kind)]
    failed.sort(key=lambda item: item[1].is_minor)

    tiles = []
    for picture, failure, markers in failed[:MOST_TILES]:
        pixels = cv2.imread(os.path.join(data, picture['set'], picture['image']))
        if pixels is not None:  # omr_detect could not read it either, and said so
            tiles.append(make_tile(pixels, failure, markers, '%s %s' % (os.path.splitext(picture['image'])[0],
                                                                        picture['factors']['filter'])))
    path = os.path.join(folder, 'failures.jpg')
    if tiles:
        cv2.imwrite(path, arrange(tiles), [cv2.IMWRITE_JPEG_QUALITY, 85])
    elif os.path.exists(path):
        os.remove(path)
    minor = sum(failure.is_minor for _, failure, _ in failed)
    return len(failed) - minor, minor
