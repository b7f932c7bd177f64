#!/usr/bin/env python3
"""omr_calibrate as its users call it. Usage: test_omr_calibrate.py PATH_OF_OMR_CALIBRATE"""
import os
import re
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np
import yaml

import plate

OMR_CALIBRATE = None
POSES = [(plate.rotation(x, y, z), np.array([.04 * np.sin(x), .03 * np.cos(y), distance]))
         for x, y, z, distance in ((25, 0, 5, .4), (-30, 10, 20, .5), (5, 35, 0, .45), (10, -35, -15, .4),
                                   (-20, -25, 90, .55), (30, 30, 45, .5), (0, 5, 0, .35), (-35, 20, 170, .45))]


def run(*arguments):
    return subprocess.run([OMR_CALIBRATE, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True, timeout=120)


class OmrCalibrate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        sheet = plate.paper(7, 10, .02)
        cls.images = []
        for number, pose in enumerate(POSES):
            cls.images.append(os.path.join(cls.folder, 'view%d.png' % number))
            cv2.imwrite(cls.images[-1], plate.picture(sheet, *pose))
        cls.empty = os.path.join(cls.folder, 'empty.png')
        cv2.imwrite(cls.empty, np.full((plate.HEIGHT, plate.WIDTH, 3), 120, np.uint8))

    def path(self, name):
        return os.path.join(self.folder, name)

    def calibrate(self, *arguments):
        return run('--checkerboard', '7x10', '--square', '0.02', *arguments)

    def assert_fails(self, message, result, code=2):
        self.assertEqual(code, result.returncode, result.stderr)
        self.assertIn(message, result.stderr)

    def test_finds_the_camera_again(self):
        result = self.calibrate('--output', self.path('camera.yaml'), '--name', 'left', *self.images)
        self.assertEqual((0, ''), (result.returncode, result.stderr))
        with open(self.path('camera.yaml')) as file:
            info = yaml.safe_load(file)
        self.assertEqual((960, 720, 'left', 'plumb_bob'), tuple(
            info[key] for key in ('image_width', 'image_height', 'camera_name', 'distortion_model')))
        np.testing.assert_allclose(np.reshape(info['camera_matrix']['data'], (3, 3)), plate.CAMERA, atol=3)
        np.testing.assert_allclose(info['distortion_coefficients']['data'], np.zeros(5), atol=.03)
        self.assertEqual((3, 4, 12), (info['projection_matrix']['rows'], info['projection_matrix']['cols'],
                                      len(info['projection_matrix']['data'])))
        self.assertLess(float(re.search(r'error: mean ([\d.]+) px', result.stdout).group(1)), .1)
        sigma = float(re.search(r'focal length ([\d.]+) %', result.stdout).group(1)) / 100
        self.assertLess(abs(info['camera_matrix']['data'][0] / plate.FOCAL - 1), 4 * sigma + .0005)

    def test_all_models(self):
        for model, count in (('plumb_bob', 5), ('rational_polynomial', 8), ('equidistant', 4)):
            output = self.path(model + '.yaml')
            self.assertEqual(0, self.calibrate('--model', model, '--output', output, *self.images).returncode)
            with open(output) as file:
                info = yaml.safe_load(file)
            self.assertEqual(model, info['distortion_model'])
            self.assertEqual(count, len(info['distortion_coefficients']['data']))

    def test_corners_for_mrcal(self):
        output = self.path('corners.vnl')
        result = self.calibrate('--mrcal', output, *self.images[:3], self.empty)
        self.assertEqual(0, result.returncode, result.stderr)
        with open(output) as file:
            lines = [line.split() for line in file]
        self.assertEqual(['#', 'filename', 'x', 'y', 'level'], lines[0])
        self.assertEqual([self.empty, '-', '-', '-'], lines[-1])
        first = [line for line in lines if line[0] == self.images[0]]
        self.assertEqual(6 * 9, len(first))
        self.assertEqual({'0'}, {line[3] for line in first})
        # Row by row: nine corners along the board's x, then the next row.
        turn, shift = POSES[0]
        grid = np.array([((col - 4) * .02, (row - 2.5) * .02, 0) for row in range(6) for col in range(9)])
        expected = cv2.projectPoints(grid, cv2.Rodrigues(turn)[0], shift, plate.CAMERA, None)[0].reshape(-1, 2)
        np.testing.assert_allclose(np.array([line[1:3] for line in first], float), expected, atol=.3)

    def test_a_calibration_that_cannot_be_written_is_a_failure(self):
        for option in ('--output', '--mrcal'):
            done = run('--checkerboard', '7x10', '--square', '.02', option, '/dev/full', *self.images)
            self.assertEqual(2, done.returncode, option)
            self.assertIn('disk full', done.stderr)

    def test_a_forgotten_output_costs_no_photograph(self):
        with open(self.images[0], 'rb') as file:
            before = file.read()
        for option in ('--output', '--mrcal'):
            result = self.calibrate(option, *self.images)
            self.assert_fails("would overwrite the image '%s'" % self.images[0], result)
            self.assertEqual('', result.stdout)
            with open(self.images[0], 'rb') as file:
                self.assertEqual(before, file.read())

    def test_names_that_the_files_cannot_hold(self):
        done = run('--checkerboard', '7x10', '--square', '.02', '--name', 'cell 2: left', *self.images)
        self.assertEqual(2, done.returncode)
        self.assertIn('letters, digits and _', done.stderr)
        done = run('--checkerboard', '7x10', '--square', '.02', '--mrcal', '/dev/null', 'sp ace/left.jpg')
        self.assertEqual(2, done.returncode)
        self.assertIn('sp ace/left.jpg', done.stderr)

    def test_either_side_first(self):
        turned = run('--checkerboard', '10x7', '--square', '0.02', *self.images)
        self.assertEqual((0, ''), (turned.returncode, turned.stderr))
        self.assertEqual(self.calibrate(*self.images).stdout, turned.stdout)

    def test_image_without_the_board_is_told_and_left_out(self):
        result = self.calibrate(*self.images[:4], self.empty)
        self.assertEqual(0, result.returncode)
        self.assertIn('empty.png: no such board', result.stdout)
        self.assertIn('4 of 5 images', result.stdout)

    def test_the_largest_board_counts(self):
        # The copy on a screen behind shows all its corners, the board in the hand does not.
        seen = cv2.imread(self.images[6])
        copy = cv2.resize(seen, (240, 180), interpolation=cv2.INTER_AREA)
        seen = cv2.copyMakeBorder(seen, 180, 0, 0, 0, cv2.BORDER_CONSTANT, value=(120, 125, 130))
        seen[:180, :240] = copy
        turn, shift = POSES[6]
        corner = cv2.projectPoints(np.array([[.08, .05, 0]]), cv2.Rodrigues(turn)[0], shift, plate.CAMERA, None)[0]
        x, y = np.rint(corner.ravel()).astype(int) + (0, 180)
        cv2.circle(seen, (int(x), int(y)), 40, (90, 120, 170), -1)
        image, output = self.path('copy.png'), self.path('copy.vnl')
        cv2.imwrite(image, seen)
        result = self.calibrate('--mrcal', output, image, image, image)
        self.assertEqual(0, result.returncode, result.stderr)
        with open(output) as file:
            points = np.array([line.split()[1:3] for line in file if '-' not in line.split() and line[0] != '#'], float)
        self.assertGreater(points[:, 1].min(), 180)

    def test_mistakes_are_named(self):
        self.assert_fails('the board was found in 2 of 2 images: three are the least', self.calibrate(*self.images[:2]))
        self.assert_fails('the board was found in 0 of 3 images',
                          run('--checkerboard', '7x9', '--square', '0.02', *self.images[:3]))
        inner = run('--checkerboard', '6x9', '--square', '0.02', *self.images[:3])
        self.assert_fails('boards of 7 x 10 squares; --checkerboard counts squares, not inner corners', inner)
        small = self.path('small.png')
        cv2.imwrite(small, cv2.resize(cv2.imread(self.images[0]), (640, 480)))
        self.assert_fails('small.png: the image has 640 x 480 pixels, those before it 960 x 720',
                          self.calibrate(*self.images[:4], small), 1)
        self.assert_fails('nothing.png: there is no such file', self.calibrate(*self.images[:4], 'nothing.png'), 1)
        self.assert_fails("there is no camera model 'fov'", self.calibrate('--model', 'fov', *self.images[:3]))
        self.assert_fails("cannot write '/nonexistent/a'", self.calibrate('--mrcal', '/nonexistent/a', *self.images[:3]))
        self.assert_fails('--square', run('--checkerboard', '7x10', '--square', '20', *self.images[:3]))
        self.assert_fails('7by10', run('--checkerboard', '7by10', '--square', '0.02', *self.images[:3]))
        self.assert_fails('is required', run('--checkerboard', '7x10', *self.images[:3]))


if __name__ == '__main__':
    OMR_CALIBRATE = sys.argv.pop(1)
    unittest.main()
