#!/usr/bin/env python3
"""report_bag.py INPUT.bag OUTPUT.bag OVERLAY_DIR

What the detector said of each image of INPUT.bag (written by make_bag.py), from OUTPUT.bag (its recorded topics);
leaves the overlays as PNG. Fails when an image was not answered.
"""
import argparse
import os
import sys

import cv2
import numpy as np
import rosbag


def image_files(bag_file):
    """Stamp -> file name of every image in the bag."""
    with rosbag.Bag(bag_file) as bag:
        topics = [topic for topic in bag.get_type_and_topic_info().topics if topic.endswith('_file')]
        return {stamp.to_nsec(): name.data for _, name, stamp in bag.read_messages(topics) if name.data}


def answers(bag_file):
    """Stamp -> {last part of the topic's name: message}."""
    found = {}
    with rosbag.Bag(bag_file) as bag:
        for topic, message, _ in bag.read_messages():
            if hasattr(message, 'header'):
                found.setdefault(message.header.stamp.to_nsec(), {})[topic.split('/')[-1]] = message
    return found


def checkerboard_text(board):
    return 'checkerboard %s%d x %d (%d of %d inner corners seen)' % (
        '' if board.size_certain else '>= ', board.rows, board.cols, sum(board.inner_corners_seen),
        len(board.inner_corners))


def target_text(target):
    return 'target %s at (%.1f, %.1f)' % (target.colors, target.center.x, target.center.y)


def write_overlay(message, path):
    picture = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    picture = picture[:, :3 * message.width].reshape(message.height, message.width, 3)
    if not cv2.imwrite(path, picture):
        sys.exit('report_bag: cannot write %s' % path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('input')
    parser.add_argument('output')
    parser.add_argument('overlays')
    arguments = parser.parse_args()
    os.makedirs(arguments.overlays, exist_ok=True)
    files, found = image_files(arguments.input), answers(arguments.output)
    unanswered = 0
    for stamp, name in sorted(files.items()):
        answer = found.get(stamp, {})
        if not {'checkerboards', 'targets', 'overlay'} <= set(answer):
            print('%s: no answer' % name)
            unanswered += 1
            continue
        texts = [checkerboard_text(board) for board in answer['checkerboards'].checkerboards]
        texts += [target_text(target) for target in answer['targets'].targets]
        print('%s: %s' % (name, '; '.join(texts) or 'nothing found'))
        write_overlay(answer['overlay'], os.path.join(arguments.overlays, os.path.splitext(name)[0] + '.png'))
    print('%d images, %d answered; the overlays lie in %s' % (len(files), len(files) - unanswered, arguments.overlays))
    return 1 if unanswered else 0


if __name__ == '__main__':
    sys.exit(main())
