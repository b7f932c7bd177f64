#!/usr/bin/env python3
"""evaluate_candidates.py DATA_DIR [--sets distance,negative] [--network FILE] [--output results/candidates]
                       [--set name=value]

What the preliminary detection gives on the sets of DATA_DIR, a Markdown table on standard output:
  covered   markers with squares or rings of at least 3 px of whose box a candidate covers half
  false     candidates a picture that lie on no marker; on the sets of negatives that is all of them
  time      of the step "candidates", median and largest [ms], and of "enlargements"
"""
import argparse
import json
import os
import subprocess
import sys

import numpy as np

MIN_PX = 3.
COVERED = .5  # of the marker's box
ON_MARKER = .1  # of the candidate's box
MIN_VISIBLE = .5
UNREADABLE = {'candidates': [], 'steps_ms': {'candidates': 0, 'enlargements': 0}}  # of a picture without an answer


def box_of(points):
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    return np.array([low[0], low[1], high[0], high[1]])


def shared_area(a, b):
    width, height = np.minimum(a[2:], b[2:]) - np.maximum(a[:2], b[:2])
    return max(width, 0) * max(height, 0)


def area(box):
    return (box[2] - box[0]) * (box[3] - box[1])


def true_markers(picture):
    """(kind, box, size of a square or ring [px], visible fraction) of every marker whose outline is known."""
    for board in picture['checkerboards']:
        yield 'checkerboard', box_of(board['outline']), board['min_square_px'], board['visible_fraction']
    for target in picture['targets']:
        if target['outline']:
            yield 'target', box_of(target['outline']), target['ring_px'], target['visible_fraction']


def detect(folder, names, arguments, jsonl):
    command = ['omr_detect', '--json', jsonl, '--set', 'candidate_mode=all']
    if arguments.network:
        command += ['--network', arguments.network]
    for assignment in arguments.set:
        command += ['--set', assignment]
    done = subprocess.run(command + [os.path.join(folder, name) for name in names])
    if done.returncode not in (0, 1):
        sys.exit('evaluate_candidates: omr_detect failed on %s' % folder)
    with open(jsonl) as file:
        return {os.path.basename(answer['image']): answer for answer in map(json.loads, file)}


def judge(picture, answer, report):
    markers = list(true_markers(picture))
    boxes = [np.array([x, y, x + width, y + height])
             for x, y, width, height in (candidate['box'] for candidate in answer['candidates'])]
    for kind, box, size, visible in markers:
        if size < MIN_PX or visible < MIN_VISIBLE:
            continue
        covered = any(shared_area(box, candidate) >= COVERED * area(box) for candidate in boxes)
        report[kind].append(covered)
        if not covered:
            report['missed'].append('%s %s at (%.0f, %.0f), %.1f px' % (picture['image'], kind, box[0], box[1], size))
    for candidate, box in zip(answer['candidates'], boxes):
        if not any(shared_area(marker, box) >= ON_MARKER * area(box) for _, marker, _, _ in markers):
            report['false'].append('%s %s %s %.3f %d' % (picture['image'], candidate['kind'], candidate['box'],
                                                         candidate['score'], candidate['windows']))
    report['candidates ms'].append(answer['steps_ms']['candidates'])
    report['enlargements ms'].append(answer['steps_ms']['enlargements'])


def row(name, pictures, report):
    def share(covered):
        return '%d of %d' % (sum(covered), len(covered)) if covered else '-'

    def times(values):
        return '%.1f / %.1f' % (np.median(values), max(values))

    return '| %s | %s | %s | %.2f | %s | %s |' % (name, share(report['checkerboard']), share(report['target']),
                                               len(report['false']) / pictures, times(report['candidates ms']),
                                               times(report['enlargements ms']))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('data')
    parser.add_argument('--sets', type=lambda text: text.split(','), help='only these, separated by commas')
    parser.add_argument('--set', action='append', default=[], metavar='NAME=VALUE', help='a parameter of omr_detect')
    parser.add_argument('--network', help='yaml file of omr_train; default: the built-in network')
    parser.add_argument('--output', default='results/candidates')
    arguments = parser.parse_args()
    os.makedirs(arguments.output, exist_ok=True)
    names = arguments.sets or sorted(name for name in os.listdir(arguments.data)
                                     if os.path.isfile(os.path.join(arguments.data, name, 'truth.json')))
    if not names:
        sys.exit('evaluate_candidates: no folder of %s holds a truth.json' % arguments.data)
    print('| set | checkerboards covered | targets covered | false a picture | candidates ms | enlargements ms |')
    print('|---|---|---|---|---|---|', flush=True)
    for name in names:
        folder = os.path.join(arguments.data, name)
        with open(os.path.join(folder, 'truth.json')) as file:
            pictures = json.load(file)['images']
        answers = detect(folder, [picture['image'] for picture in pictures], arguments,
                         os.path.join(arguments.output, name + '.jsonl'))
        keys = ('checkerboard', 'target', 'missed', 'false', 'candidates ms', 'enlargements ms')
        report = {key: [] for key in keys}
        for picture in pictures:
            judge(picture, answers.get(picture['image'], UNREADABLE), report)
        print(row(name, len(pictures), report), flush=True)
        with open(os.path.join(arguments.output, name + '.txt'), 'w') as file:
            file.write('\n'.join(['missed:'] + report['missed'] + ['false:'] + report['false']) + '\n')


if __name__ == '__main__':
    main()
