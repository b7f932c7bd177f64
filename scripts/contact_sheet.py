"""Contact sheet of the pictures on which evaluate.py saw misses or false detections.

Truth: green = found, red = missed, grey = does not count. Detections: yellow.
"""
import json
import os

import cv2
import numpy as np

TILE_WIDTH = 640
COLUMNS = 3
MOST_TILES = 60  # 60 tiles of 640 px make a picture of 1920 x 10000, which every viewer still opens
GREEN, RED, GREY, YELLOW = (0, 220, 0), (0, 0, 255), (150, 150, 150), (0, 255, 255)


def failures(picture):
    """Misses and false detections of one scored picture."""
    return sum(picture[kind][count] for kind in ('checkerboard', 'target') for count in ('fp', 'fn'))


def polygon(image, points, color, scale):
    points = np.round(np.asarray(points, float) * scale * 16).astype(np.int32)
    cv2.polylines(image, [points.reshape(-1, 1, 2)], True, color, 2, cv2.LINE_AA, 4)


def draw_truth(image, truth, picture, scale):
    for board, score in zip(truth['checkerboards'], picture['boards']):
        color = GREEN if score['hit'] else RED if score['care'] else GREY
        polygon(image, board['outline'], color, scale)
        label(image, '%dx%d' % (board['rows'], board['cols']), np.max(board['outline'], axis=0) * scale, color)
    for target, score in zip(truth['targets'], picture['targets']):
        color = GREEN if score['hit'] else RED if score['care'] else GREY
        ellipse = target['ellipse']
        box = ((ellipse['cx'] * scale, ellipse['cy'] * scale), (2 * ellipse['a'] * scale, 2 * ellipse['b'] * scale),
               np.degrees(ellipse['theta']))
        cv2.ellipse(image, box, color, 2, cv2.LINE_AA)
        label(image, target['code'], (np.array(target['center']) + ellipse['a']) * scale, color)


def draw_detections(image, detection, scale):
    for board in detection['checkerboards']:
        polygon(image, board['corners'], YELLOW, scale)
        label(image, '%dx%d' % (board['rows'], board['cols']), np.min(board['corners'], axis=0) * scale, YELLOW)
    for target in detection['targets']:
        center = np.array(target['center']) * scale
        cv2.drawMarker(image, tuple(int(x) for x in center), YELLOW, cv2.MARKER_CROSS, 12, 2)
        label(image, target['colors'], center + (6, -6), YELLOW)


def label(image, text, position, color):
    position = tuple(int(np.clip(value, 0, limit)) for value, limit in zip(position, image.shape[1::-1]))
    for shade, thickness in (((0, 0, 0), 3), (color, 1)):
        cv2.putText(image, text, position, cv2.FONT_HERSHEY_SIMPLEX, .45, shade, thickness, cv2.LINE_AA)


def make_tile(picture, truth, detection, path):
    image = cv2.imread(path)
    scale = TILE_WIDTH / image.shape[1]
    image = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    draw_truth(image, truth, picture, scale)
    draw_detections(image, detection, scale)
    label(image, '%s %s' % (picture['image'], picture['factors']['filter']), (6, 16), (255, 255, 255))
    return image


def arrange(tiles):
    """Rows of COLUMNS tiles, each row as high as its highest tile."""
    rows = []
    for start in range(0, len(tiles), COLUMNS):
        row = tiles[start:start + COLUMNS]
        height = max(tile.shape[0] for tile in row)
        row += [np.zeros((1, TILE_WIDTH, 3), np.uint8)] * (COLUMNS - len(row))
        rows.append(np.hstack([cv2.copyMakeBorder(tile, 0, height - tile.shape[0], 0, TILE_WIDTH - tile.shape[1],
                                                  cv2.BORDER_CONSTANT) for tile in row]))
    return np.vstack(rows)


def read_detections(folder, set_name, filter_name):
    with open(os.path.join(folder, '%s.%s.jsonl' % (set_name, filter_name))) as file:
        lines = [json.loads(line) for line in file]
    return {os.path.basename(line['image']): line for line in lines}


def write(pictures, data, folder):
    """Writes failures.jpg of the worst pictures into folder, from its *.jsonl; returns how many pictures failed."""
    failed = sorted((picture for picture in pictures if failures(picture)), key=failures, reverse=True)
    tiles, truths, detections = [], {}, {}
    for picture in failed[:MOST_TILES]:
        name, filter_name = picture['set'], picture['factors']['filter']
        if name not in truths:
            with open(os.path.join(data, name, 'truth.json')) as file:
                truths[name] = {truth['image']: truth for truth in json.load(file)['images']}
        if (name, filter_name) not in detections:
            detections[name, filter_name] = read_detections(folder, name, filter_name)
        detection = detections[name, filter_name].get(picture['image'], {'checkerboards': [], 'targets': []})
        tiles.append(make_tile(picture, truths[name][picture['image']], detection,
                               os.path.join(data, name, picture['image'])))
    path = os.path.join(folder, 'failures.jpg')
    if tiles:
        cv2.imwrite(path, arrange(tiles), [cv2.IMWRITE_JPEG_QUALITY, 85])
    elif os.path.exists(path):
        os.remove(path)
    return len(failed)
