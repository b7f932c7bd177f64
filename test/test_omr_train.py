#!/usr/bin/env python3
"""test_omr_train.py OMR_TRAIN OMR_DETECT: training as a user runs it, on photographs that are drawn here."""
import os
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np

TRAIN, DETECT = sys.argv[1:3]


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)


class TrainTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.photographs = os.path.join(self.folder, 'photographs')
        os.makedirs(os.path.join(self.photographs, 'site'))
        random = np.random.default_rng(1)
        for i in range(4):
            small = random.integers(0, 256, (30, 40, 3)).astype(np.uint8)
            cv2.imwrite(os.path.join(self.photographs, 'site', '%d.png' % i), cv2.resize(small, (240, 180)))

    def train(self, name, *more):
        output = os.path.join(self.folder, name)
        return output, run(TRAIN, '--scenes', '4', '--epochs', '2', '--rounds', '2', '--hidden', '4',
                           '--held-out-scenes', '1', '--output', output, self.photographs, *more)

    def test_repeats_from_a_seed_and_the_detector_reads_it(self):
        first, done = self.train('a.yaml')
        self.assertEqual(0, done.returncode, done.stderr)
        for words in ('recall', 'precision', 'accuracy', 'held out: 1 photographs', '1 in 2 ', '1 in 20 '):
            self.assertIn(words, done.stdout)
        second, _ = self.train('b.yaml')
        other, _ = self.train('c.yaml', '--seed', '2')

        def weights(file):
            with open(file) as stream:
                return [line for line in stream if not line.startswith('#')]
        self.assertEqual(weights(first), weights(second))
        self.assertNotEqual(weights(first), weights(other))
        self.assertIn('boxes', ''.join(weights(first)))
        again, done = self.train('d.yaml', '--network', first)
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertEqual(weights(first), weights(again), 'what is kept and what is learned again')
        with open(first) as stream:
            self.assertTrue(stream.readline().startswith('# omr_train --scenes 4'))
        photograph = os.path.join(self.photographs, 'site', '0.png')
        read = run(DETECT, '--network', first, '--set', 'candidate_mode=all', photograph)
        self.assertEqual(0, read.returncode, read.stderr)

    def test_leaves_out_what_is_no_photograph_and_says_so(self):
        with open(os.path.join(self.photographs, 'notes.txt'), 'w') as file:
            file.write('no picture')
        _, done = self.train('a.yaml')
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertIn('notes.txt', done.stderr)

    def test_refuses_what_it_cannot_do(self):
        _, done = self.train('a.yaml', os.path.join(self.folder, 'nowhere'))
        self.assertEqual(2, done.returncode)
        self.assertIn('nowhere', done.stderr)
        empty = os.path.join(self.folder, 'empty')
        os.makedirs(empty)
        done = run(TRAIN, '--output', os.path.join(self.folder, 'a.yaml'), empty)
        self.assertEqual(2, done.returncode)
        self.assertIn('there are 0 photographs', done.stderr)
        done = run(TRAIN, '--output', '/nowhere/a.yaml', self.photographs)
        self.assertEqual(2, done.returncode)
        self.assertIn('/nowhere/a.yaml', done.stderr)
        photograph = os.path.join(self.photographs, 'site', '0.png')
        done = run(TRAIN, '--output', photograph, self.photographs)
        self.assertEqual(2, done.returncode)
        self.assertIn("would overwrite the image '%s'" % photograph, done.stderr)
        self.assertIsNotNone(cv2.imread(photograph))
        self.assertEqual(2, run(TRAIN, self.photographs).returncode)
        self.assertEqual(2, run(TRAIN, '--output', 'a.yaml', '--hidden', '0', self.photographs).returncode)

    def test_a_network_may_be_replaced_and_stays_until_the_new_one_is_there(self):
        file, done = self.train('a.yaml')
        self.assertEqual(0, done.returncode, done.stderr)
        with open(file) as stream:
            before = stream.read()
        done = self.train('a.yaml', '--network', 'absent.yaml')[1]
        self.assertEqual(2, done.returncode)
        with open(file) as stream:
            self.assertEqual(before, stream.read())
        os.symlink('a.yaml', os.path.join(self.folder, 'link.yaml'))
        done = self.train('link.yaml', '--network', file)[1]
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertEqual(['a.yaml', 'link.yaml', 'photographs'], sorted(os.listdir(self.folder)))
        self.assertTrue(os.path.islink(os.path.join(self.folder, 'link.yaml')))

    def test_the_detector_refuses_another_file(self):
        file = os.path.join(self.folder, 'a.yaml')
        with open(file, 'w') as stream:
            stream.write('thresholds: 3\n')
        done = run(DETECT, '--network', file, os.path.join(self.photographs, 'site', '0.png'))
        self.assertEqual(2, done.returncode)
        self.assertIn('a.yaml:1: thresholds', done.stderr)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1])
