#!/usr/bin/env python3
"""omr_detect as its users call it: options, outputs, exit codes. Usage: test_omr_detect.py PATH_OF_OMR_DETECT"""
import json
import os
import pty
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np

OMR_DETECT = None


def run(*arguments, **options):
    return subprocess.run([OMR_DETECT, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True, timeout=120, **options)


class OmrDetect(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.image = self.write_image('a/photo.png')

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def write_image(self, name, width=64, height=48):
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        image = np.full((height, width, 3), 128, np.uint8)
        image[10:30, 10:30] = (0, 0, 255)
        self.assertTrue(cv2.imwrite(path, image))
        return path

    def test_writes_one_json_object_a_line(self):
        second = self.write_image('a/second.jpg', 100, 80)
        result = run('--json', '-', self.image, second)
        self.assertEqual((0, ''), (result.returncode, result.stderr))
        lines = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([self.image, second], [line['image'] for line in lines])
        self.assertEqual([(64, 48), (100, 80)], [(line['width'], line['height']) for line in lines])
        for line in lines:
            self.assertEqual([], line['checkerboards'])
            self.assertEqual([], line['targets'])
            self.assertGreater(line['time_ms'], 0)
            self.assertLessEqual(sum(line['steps_ms'].values()), line['time_ms'] + 0.01)

    def test_writes_json_to_a_file_and_nothing_else(self):
        result = run('--json', self.path('out.jsonl'), self.image)
        self.assertEqual((0, '', ''), (result.returncode, result.stdout, result.stderr))
        with open(self.path('out.jsonl')) as file:
            self.assertEqual(self.image, json.loads(file.read())['image'])

    def test_summarises_where_no_output_was_asked_for(self):
        result = run(self.image)
        self.assertEqual(0, result.returncode)
        self.assertRegex(result.stdout, r'photo\.png: 0 checkerboards, 0 targets, [0-9.]+ ms')

    def test_creates_the_overlay_folder(self):
        result = run('--overlay', self.path('new/folder'), self.image)
        self.assertEqual((0, '', ''), (result.returncode, result.stdout, result.stderr))
        picture = cv2.imread(self.path('new/folder/photo.png'))
        self.assertTrue((picture == cv2.imread(self.image)).all())

    def test_overlay_regions_paints_them(self):
        self.assertEqual(0, run('--overlay', self.folder, '--set', 'overlay_regions=true', self.image).returncode)
        picture = cv2.imread(self.path('photo.png'))
        self.assertEqual([255, 0, 0], picture[0, 0].tolist())
        self.assertEqual([0, 255, 255], picture[10, 20].tolist())

    def test_images_of_the_same_name_keep_their_own_overlays(self):
        others = [self.write_image('b/photo.png', 100, 80), self.write_image('c/photo.jpg', 120, 90)]
        self.assertEqual(0, run('--overlay', self.path('out'), self.image, *others).returncode)
        sizes = [cv2.imread(self.path('out', name)).shape[1] for name in ('photo.png', 'photo-2.png', 'photo-3.png')]
        self.assertEqual([64, 100, 120], sizes)

    def test_overlays_take_no_images_place(self):
        with open(self.image, 'rb') as file:
            before = file.read()
        done = run('--overlay', self.path('a'), self.image)
        self.assertEqual(2, done.returncode)
        self.assertIn('would overwrite the image', done.stderr)
        with open(self.image, 'rb') as file:
            self.assertEqual(before, file.read())

    def test_a_forgotten_output_costs_no_photograph(self):
        second = self.write_image('a/second.jpg', 100, 80)
        os.symlink(self.image, self.path('link'))
        for named in (self.image, self.path('link'), second):
            with open(named, 'rb') as file:
                before = file.read()
            done = run('--json', named, second)  # as --json a/* without its - or file
            self.assertEqual((2, ''), (done.returncode, done.stdout))
            self.assertIn("the output would overwrite the image '%s'; name another file" % named, done.stderr)
            with open(named, 'rb') as file:
                self.assertEqual(before, file.read())

    def test_output_of_an_earlier_run_is_replaced(self):
        for _ in range(2):
            done = run('--json', self.path('out.jsonl'), '--overlay', self.path('out'), self.image)
            self.assertEqual((0, ''), (done.returncode, done.stderr))
        with open(self.path('out.jsonl')) as file:
            self.assertEqual(1, len(file.readlines()))

    def test_a_refused_overlay_leaves_the_json_of_an_earlier_run(self):
        with open(self.path('out.jsonl'), 'w') as file:
            file.write('earlier')
        self.assertEqual(2, run('--json', self.path('out.jsonl'), '--overlay', self.path('a'), self.image).returncode)
        with open(self.path('out.jsonl')) as file:
            self.assertEqual('earlier', file.read())

    def test_a_name_that_no_file_can_have_is_told_and_the_others_are_processed(self):
        done = run('--json', '-', self.path('x' * 300 + '.png'), self.image)
        self.assertEqual(1, done.returncode)
        self.assertEqual(1, len(done.stdout.splitlines()))

    def test_lost_output_is_a_failure(self):
        for arguments in ([self.image], ['--json', '-', self.image], ['--list-parameters']):
            with open('/dev/full', 'w') as full:
                done = subprocess.run([OMR_DETECT, *arguments], stdout=full, stderr=subprocess.PIPE,
                                      universal_newlines=True, timeout=120)
            self.assertEqual(2, done.returncode, arguments)
            self.assertIn('disk full', done.stderr)

    def test_an_unreadable_image_is_told_and_the_others_are_processed(self):
        broken = self.path('broken.jpg')
        with open(broken, 'wb') as file:
            file.write(b'\xff\xd8\xff\xe0 no image')
        result = run('--json', '-', broken, self.path('absent.png'), self.folder, self.image)
        self.assertEqual(1, result.returncode)
        self.assertEqual([self.image], [json.loads(line)['image'] for line in result.stdout.splitlines()])
        for name in (broken, self.path('absent.png'), self.folder):
            self.assertEqual(1, sum(line.startswith('omr_detect: %s: ' % name) for line in result.stderr.splitlines()))

    def test_a_file_name_need_not_be_utf8(self):
        name = os.fsencode(self.folder) + b'/\xff.png'
        os.link(self.image, name)
        result = subprocess.run([OMR_DETECT, '--json', '-', name], stdout=subprocess.PIPE, timeout=120)
        self.assertEqual(0, result.returncode)
        self.assertEqual(64, json.loads(result.stdout.decode())['width'])

    def test_outputs_that_cannot_be_written(self):
        for arguments in (['--json', self.path('absent/out.jsonl')], ['--json', '/dev/full'],
                          ['--overlay', os.path.join(self.image, 'below')]):
            result = run(*arguments, self.image)
            self.assertEqual(2, result.returncode, arguments)
            self.assertRegex(result.stderr, '^omr_detect: cannot (write|create)')
        os.makedirs(self.path('out/photo.png'))
        result = run('--overlay', self.path('out'), self.image)
        self.assertEqual(2, result.returncode)
        self.assertIn('cannot write the overlay', result.stderr)

    def test_wrong_arguments(self):
        for arguments, told in (([], 'images'), (['--filter', 'gauss', self.image], 'none, gaussian, median'),
                                (['--set', 'filter', self.image], 'name=value'),
                                (['--set', 'sobel_treshold=3', self.image], 'sobel_threshold'),
                                (['--set', 'sobel_threshold=0', self.image], 'out of bounds'),
                                (['--config', self.path('absent.yaml'), self.image], 'absent.yaml'),
                                (['--nonsense', self.image], 'nonsense')):
            result = run(*arguments)
            self.assertEqual((2, ''), (result.returncode, result.stdout), arguments)
            self.assertIn(told, result.stderr)

    def test_reads_the_configuration_before_the_other_options(self):
        with open(self.path('omr.yaml'), 'w') as file:
            file.write('filter: median\noverlay_regions: true\n')
        result = run('--config', self.path('omr.yaml'), '--filter', 'none', '--overlay', self.folder, self.image)
        self.assertEqual((0, ''), (result.returncode, result.stderr))
        self.assertEqual([255, 0, 0], cv2.imread(self.path('photo.png'))[0, 0].tolist())

    def test_lists_parameters_and_devices(self):
        parameters = run('--list-parameters')
        self.assertEqual(0, parameters.returncode)
        rows = [[cell.strip() for cell in line.split(' | ')] for line in parameters.stdout.splitlines()]
        threshold = next(row for row in rows if '`sobel_threshold`' in row[0])
        self.assertEqual(['1 to 2040', 'grey levels'], threshold[2:4])
        devices = run('--list-devices')
        self.assertEqual(0, devices.returncode)
        self.assertTrue(devices.stdout)

    def test_shows_progress_on_a_terminal_only(self):
        ours, terminal = pty.openpty()
        with os.fdopen(ours, 'rb', 0) as ours:
            result = subprocess.run([OMR_DETECT, '--json', self.path('out.jsonl'), self.image], stderr=terminal,
                                    stdout=subprocess.PIPE, timeout=120)
            os.close(terminal)
            self.assertEqual((0, b''), (result.returncode, result.stdout))
            self.assertIn(b'1/1 ' + os.fsencode(self.image), ours.read(1000))


if __name__ == '__main__':
    OMR_DETECT = sys.argv.pop(1)
    unittest.main()
