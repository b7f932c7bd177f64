#!/usr/bin/env python3
"""make_scene.py SHEET.png OUTPUT_DIR [--count N]

Views of a printed sheet as an outdoor camera may see it: tilted, in a plain surrounding, under a hard shadow, with
lens blur and noise. The colours and the geometry are known, so the demo has something that every photograph lacks.
"""
import argparse
import os

import cv2
import numpy as np

WIDTH, HEIGHT = 1280, 960
FOCAL_PX = 1400.
GAMMA = 2.2  # light is added and shaded in linear intensity, and coded at the end


def rotation(tilt, turn, roll):
    """Rotation matrix about the camera's x, y and z axes, angles in degrees."""
    matrix = np.eye(3)
    for axis, angle in ((0, tilt), (1, turn), (2, roll)):
        vector = np.zeros(3)
        vector[axis] = np.radians(angle)
        matrix = cv2.Rodrigues(vector)[0] @ matrix
    return matrix


def sheet_homography(sheet, pose, distance):
    """Maps the sheet's pixels to the picture's; distance in widths of the sheet."""
    height, width = sheet.shape[:2]
    to_plane = np.array([[1 / width, 0, -.5], [0, 1 / width, -.5 * height / width], [0, 0, 1]])
    camera = np.array([[FOCAL_PX, 0, WIDTH / 2], [0, FOCAL_PX, HEIGHT / 2], [0, 0, 1]])
    return camera @ np.column_stack([pose[:, 0], pose[:, 1], [0, 0, distance]]) @ to_plane


def print_reflectance(sheet):
    """Reflectance of the printed sheet [0, 1]: ink gives back a little of every colour, two thirds of its own."""
    asked = (sheet / np.float32(255)) ** GAMMA
    own = (2 + asked.min(axis=2, keepdims=True)) / 3
    return .05 + .8 * asked * own


def background(random):
    """Reflectance of weathered concrete: noise of several sizes around a grey."""
    picture = np.full((HEIGHT, WIDTH), .2, np.float32)
    for cells, contrast in ((6, .06), (40, .03), (320, .02)):
        noise = random.normal(0, contrast, (cells * HEIGHT // WIDTH + 1, cells)).astype(np.float32)
        picture += cv2.resize(noise, (WIDTH, HEIGHT), interpolation=cv2.INTER_CUBIC)
    return np.clip(cv2.merge([picture * .95, picture, picture * 1.03]), .02, 1)


def sunlight(random):
    """Brightness of every pixel: a slope of the light and the hard-edged shadow of a beam."""
    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float32)
    direction = random.uniform(0, 2 * np.pi)
    along = (np.cos(direction) * (x - WIDTH / 2) + np.sin(direction) * (y - HEIGHT / 2)) / WIDTH
    offset = random.uniform(-.25, .25)
    shadow = (np.abs(along - offset) < .06).astype(np.float32)
    across = (np.cos(direction + .6) * (x - WIDTH / 2) + np.sin(direction + .6) * (y - HEIGHT / 2)) / WIDTH
    return (1 + .5 * across) * (1 - .75 * cv2.GaussianBlur(shadow, (0, 0), 1.2))


def make_scene(sheet, index, count):
    random = np.random.default_rng(index)
    progress = index / max(1, count - 1)
    pose = rotation(30 * np.sin(2 * np.pi * progress), 35 * np.cos(2 * np.pi * progress), 12 * progress - 6)
    homography = sheet_homography(sheet, pose, 1.5 + progress)
    size = (WIDTH, HEIGHT)
    paper = cv2.warpPerspective(print_reflectance(sheet), homography, size)
    mask = cv2.warpPerspective(np.ones(sheet.shape[:2], np.float32), homography, size)[..., None]
    picture = background(random) * (1 - mask) + paper * mask
    picture = cv2.GaussianBlur(.9 * picture * sunlight(random)[..., None], (0, 0), .8)
    code = 255 * np.clip(picture, 0, 1) ** (1 / GAMMA)
    return np.clip(code + random.normal(0, 2, code.shape), 0, 255).astype(np.uint8)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('sheet')
    parser.add_argument('output')
    parser.add_argument('--count', type=int, default=8)
    arguments = parser.parse_args()
    sheet = cv2.imread(arguments.sheet)
    if sheet is None:
        parser.error('cannot read %s' % arguments.sheet)
    os.makedirs(arguments.output, exist_ok=True)
    for index in range(arguments.count):
        name = os.path.join(arguments.output, 'scene%02d.png' % index)
        if not cv2.imwrite(name, make_scene(sheet, index, arguments.count)):
            parser.error('cannot write %s' % name)


if __name__ == '__main__':
    main()
