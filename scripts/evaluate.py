#!/usr/bin/env python3
"""evaluate.py DATA_DIR [--sets doe,size] [--filters none,gaussian,median] [--peers sector,quads,mrgingham]
            [--output results/evaluate] [--set name=value]

Runs omr_detect over every set of DATA_DIR, calls the scorer DATA_DIR/score.py and writes one report folder:
  report.txt       the scorer's tables, one chapter a set
  summary.md       the tables that README quotes
  SET.FILTER.jsonl what was detected;  SET.json  what the scorer says of it;  SET.PEER.*  the same of a peer
  *.png            plots: recall over the size of squares and rings, over the hidden share, per lighting
  failures.jpg     contact sheet: a tile for each marker missed, false or misread
The set "doe", the paper's experiment, runs with every prefilter of --filters (the paper's third algorithm factor), each
other set with the default one. Peers are other detectors (see peers.py); they take hours for all sets.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys

import contact_sheet
import peers
import plots
import summary

EXPERIMENT = 'doe'


def find_sets(data, chosen):
    """Names of the folders of `data` that hold a truth.json."""
    found = sorted(name for name in os.listdir(data) if os.path.isfile(os.path.join(data, name, 'truth.json')))
    unknown = sorted(set(chosen or []) - set(found))
    if unknown:
        sys.exit('evaluate: %s has no set %s; it has %s' % (data, ', '.join(unknown), ', '.join(found) or 'none'))
    if not found:
        sys.exit('evaluate: no folder of %s holds a truth.json' % data)
    return [name for name in found if not chosen or name in chosen]


def read_truth(folder):
    with open(os.path.join(folder, 'truth.json')) as file:
        return json.load(file)['images']


def detect(folder, filter_name, settings, jsonl):
    """Writes omr_detect's answer for every picture of the set; returns how many pictures there are."""
    images = [os.path.join(folder, truth['image']) for truth in read_truth(folder)]
    command = ['omr_detect', '--json', jsonl]
    if filter_name != 'default':
        command += ['--filter', filter_name]
    for assignment in settings:
        command += ['--set', assignment]
    done = subprocess.run(command + images)
    if done.returncode not in (0, 1):  # 1: a picture could not be read; the scorer counts it as undetected
        sys.exit('evaluate: omr_detect failed on %s' % folder)
    return len(images)


def score(scorer, folder, detections, filters, result):
    """Calls the scorer; returns its tables as text and its result."""
    command = [sys.executable, scorer, folder, *detections, '--filters', ','.join(filters), '--json', result]
    done = subprocess.run(command, stdout=subprocess.PIPE, universal_newlines=True)
    if done.returncode != 0:
        sys.exit('evaluate: %s failed on %s' % (scorer, folder))
    with open(result) as file:
        return done.stdout, json.load(file)


def evaluate_set(arguments, name):
    """Detects and scores one set; returns the scorer's tables as text and its result."""
    folder = os.path.join(arguments.data, name)
    filters = arguments.filters.split(',') if name == EXPERIMENT else ['default']
    detections = [os.path.join(arguments.output, '%s.%s.jsonl' % (name, filter_name)) for filter_name in filters]
    for filter_name, jsonl in zip(filters, detections):
        count = detect(folder, filter_name, arguments.set, jsonl)
        print('%s: %d pictures, filter %s' % (name, count, filter_name), flush=True)
    return score(arguments.scorer, folder, detections, filters, os.path.join(arguments.output, name + '.json'))


def evaluate_peer(arguments, peer, name):
    """Runs and scores a peer on one set; returns its tables as text and its result."""
    folder = os.path.join(arguments.data, name)
    detections, result = (os.path.join(arguments.output, '%s.%s.%s' % (name, peer, end)) for end in ('jsonl', 'json'))
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'peers.py')
    if subprocess.run([sys.executable, program, peer, folder, detections]).returncode != 0:
        sys.exit('evaluate: the peer %s failed on %s' % (peer, folder))
    print('%s: %s' % (name, peer), flush=True)
    return score(arguments.scorer, folder, [detections], [peer], result)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('data')
    parser.add_argument('--sets', type=lambda text: text.split(','), help='only these, separated by commas')
    parser.add_argument('--filters', default='none,gaussian,median', help='prefilters for the set "doe"')
    parser.add_argument('--peers', type=lambda text: text.split(','), default=[],
                        help='also run these: ' + ', '.join(sorted(peers.PEERS)))
    parser.add_argument('--set', action='append', default=[], metavar='NAME=VALUE', help='a parameter of omr_detect')
    parser.add_argument('--output', default='results/evaluate')
    arguments = parser.parse_args()
    arguments.scorer = os.path.join(arguments.data, 'score.py')
    if not os.path.isfile(arguments.scorer):
        sys.exit('evaluate: the scorer %s is missing; it belongs beside the sets' % arguments.scorer)
    if shutil.which('omr_detect') is None:
        sys.exit('evaluate: omr_detect is not on PATH; call scripts/evaluate, which builds it')
    unknown = sorted(set(arguments.peers) - set(peers.PEERS))
    if unknown:
        sys.exit('evaluate: no peer %s; there are %s' % (', '.join(unknown), ', '.join(sorted(peers.PEERS))))
    sets = find_sets(arguments.data, arguments.sets)
    os.makedirs(arguments.output, exist_ok=True)

    pictures, results, peer_results = [], {}, {peer: {} for peer in arguments.peers}
    with open(os.path.join(arguments.output, 'report.txt'), 'w') as report:
        for name in sets:
            text, results[name] = evaluate_set(arguments, name)
            has_boards = any(truth['checkerboards'] for truth in read_truth(os.path.join(arguments.data, name)))
            for peer in arguments.peers if has_boards else []:
                peer_text, peer_results[peer][name] = evaluate_peer(arguments, peer, name)
                text += '\npeer: %s\n%s' % (peer, peer_text)
            print(text, flush=True)
            report.write(text)
            pictures += results[name]['pictures']
    summary.write(results, peer_results, EXPERIMENT, os.path.join(arguments.output, 'summary.md'))
    plots.write_all(pictures, arguments.output)
    failed, misread = contact_sheet.write(pictures, arguments.data, arguments.output)
    print('%d markers missed or false, %d misread; the report is in %s' % (failed, misread, arguments.output))


if __name__ == '__main__':
    main()
