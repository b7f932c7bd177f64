#!/usr/bin/env python3
"""omr_position as its users call it. Usage: test_omr_position.py PATH_OF_OMR_POSITION"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np

import plate

OMR_POSITION = None
TARGETS = (('RWPGB', .01, -.15, 0), ('GRGPB', .01, .15, 0))
ANGLES = (25, -20, 10)  # roll, pitch and yaw [degrees]
PARTS = '''parts:
- name: plate
  checkerboards: [{rows: 7, cols: 9, square: 0.02}]
  targets:
  - {colors: RWPGB, ring: 0.01, xyz: [-0.15, 0, 0]}
  - {colors: GRGPB, ring: 0.01, xyz: [0.15, 0, 0]}
'''


class OmrPosition(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.turn, cls.shift = plate.rotation(*ANGLES), np.array([.02, -.01, .6])
        cls.whole = plate.picture(plate.paper(7, 9, .02, TARGETS), cls.turn, cls.shift)
        cls.board = plate.picture(plate.paper(7, 9, .02), cls.turn, cls.shift)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.camera = self.write('camera.yaml', plate.camera_info())
        self.parts = self.write('parts.yaml', PARTS)

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        if isinstance(content, str):
            with open(path, 'w') as file:
                file.write(content)
        else:
            self.assertTrue(cv2.imwrite(path, content))
        return path

    def run_tool(self, *arguments, camera=None, parts=None):
        command = [OMR_POSITION, '--camera', camera or self.camera, '--parts', parts or self.parts, *arguments]
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True,
                              timeout=120)

    def assert_fails(self, message, result, code=2):
        self.assertEqual(code, result.returncode)
        self.assertIn(message, result.stderr)
        self.assertEqual(1, result.stderr.count('\n'), result.stderr)

    def test_pose_of_a_part(self):
        image = self.write('whole.png', self.whole)
        result = self.run_tool('--json', '-', image)
        self.assertEqual((0, ''), (result.returncode, result.stderr))
        answer = json.loads(result.stdout)
        self.assertEqual((image, 960, 720, []), tuple(answer[key] for key in ('image', 'width', 'height', 'ambiguous')))
        self.assertEqual(1, len(answer['parts']))
        part = answer['parts'][0]
        self.assertEqual('plate', part['name'])
        self.assertEqual((1, 2), (len(part['checkerboards']), len(part['targets'])))
        self.assertLess(np.linalg.norm(part['position'] - self.shift), .0005)
        x, y, z, w = part['orientation']
        expected = cv2.Rodrigues(self.turn)[0].ravel()
        angle = np.linalg.norm(expected)
        np.testing.assert_allclose([x, y, z, w], [*(expected / angle * np.sin(angle / 2)), np.cos(angle / 2)], atol=.002)
        self.assertEqual(36, len(part['covariance']))
        self.assertLess(part['reprojection_error'], .2)
        self.assertEqual(6 * 8 + 2, part['points'] + part['outliers'])

    def test_ambiguity_is_no_part(self):
        image = self.write('board.png', self.board)
        answer = json.loads(self.run_tool('--json', '-', image).stdout)
        self.assertEqual([], answer['parts'])
        self.assertEqual([2], [len(candidates) for candidates in answer['ambiguous']])
        summary = self.run_tool(image)
        self.assertIn('ambiguous; one of', summary.stdout)

    def test_summary(self):
        result = self.run_tool(self.write('whole.png', self.whole))
        self.assertEqual((0, ''), (result.returncode, result.stderr))
        self.assertIn('plate at (0.0', result.stdout)
        self.assertIn('1 checkerboards, 2 targets', result.stdout)
        printed = re.search(r'rpy_degrees \((.*?), (.*?), (.*?)\)', result.stdout)
        np.testing.assert_allclose([float(value) for value in printed.groups()], ANGLES, atol=.1)

    def test_a_part_that_is_described_wrongly_is_told(self):
        image = self.write('whole.png', self.whole)
        bent = self.write('bent.yaml', PARTS.replace('square: 0.02', 'square: 0.02, surface: {cylinder: 0.5}'))
        result = self.run_tool('--json', '-', image, parts=bent)
        self.assert_fails('omr_position: warning: %s: plate: reprojection error ' % image, result, 0)
        self.assertIn('px, more than 0.30: likely its description in the parts file', result.stderr)
        self.assertGreater(json.loads(result.stdout)['parts'][0]['reprojection_error'], .3)

    def test_file_of_json(self):
        output = os.path.join(self.folder, 'out.jsonl')
        images = [self.write('whole.png', self.whole), self.write('empty.png', np.full((720, 960, 3), 120, np.uint8))]
        result = self.run_tool('--json', output, *images)
        self.assertEqual((0, '', ''), (result.returncode, result.stdout, result.stderr))
        with open(output) as file:
            answers = [json.loads(line) for line in file]
        self.assertEqual([1, 0], [len(answer['parts']) for answer in answers])

    def test_a_forgotten_output_costs_no_photograph(self):
        image = self.write('whole.png', self.whole)
        self.assert_fails("would overwrite the image '%s'" % image, self.run_tool('--json', image, image))
        self.assertTrue((cv2.imread(image) == self.whole).all())

    def test_image_of_another_size_and_no_image(self):
        small = self.write('small.png', cv2.resize(self.whole, (640, 480)))
        good = self.write('whole.png', self.whole)
        result = self.run_tool('--json', '-', small, good)
        self.assert_fails("small.png: the image has 640 x 480 pixels, the calibration in '%s' is of 960 x 720"
                          % self.camera, result, 1)
        self.assertEqual(1, len(json.loads(result.stdout)['parts']))
        self.assert_fails('nothing.png: there is no such file', self.run_tool('nothing.png'), 1)

    def test_rectified_needs_p(self):
        image = self.write('whole.png', self.whole)
        self.assert_fails('the camera is not calibrated: P[0] = 0', self.run_tool('--rectified', image))
        info = plate.camera_info() + 'projection_matrix: {rows: 3, cols: 4, data: %s}\n' % np.column_stack(
            [plate.CAMERA, [0, 0, 0]]).ravel().tolist()
        result = self.run_tool('--rectified', '--json', '-', image, camera=self.write('rectified.yaml', info))
        self.assertEqual(1, len(json.loads(result.stdout)['parts']))

    def test_wrong_files_are_named(self):
        image = self.write('whole.png', self.whole)
        self.assert_fails("cannot read the file 'none.yaml'", self.run_tool(image, camera='none.yaml'))
        self.assert_fails("cannot read the file 'none.yaml'", self.run_tool(image, parts='none.yaml'))
        bad = self.write('bad.yaml', PARTS.replace('0.02', '20'))
        self.assert_fails(bad + ':3: parts[0].checkerboards[0].square: expected the side of a square in metres',
                          self.run_tool(image, parts=bad))
        raw = self.write('raw.yaml', plate.camera_info().replace(str(plate.FOCAL), '0'))
        self.assert_fails('the camera is not calibrated: K[0] = 0', self.run_tool(image, camera=raw))
        self.assert_fails("cannot write '/nonexistent/out'", self.run_tool('--json', '/nonexistent/out', image))

    def test_evaluate_pose(self):
        os.mkdir(os.path.join(self.folder, 'set'))
        pictures = []
        for number, distance in enumerate((.6, .7)):
            name, shift = '%d.jpg' % number, np.array([0, 0, distance])
            pose = {'R': self.turn.tolist(), 't': shift.tolist()}
            self.write('set/' + name, plate.picture(plate.paper(7, 9, .02, TARGETS), self.turn, shift))

            def outline(corners):
                points = np.array([[x, y, 0.] for x, y in corners])
                return cv2.projectPoints(points, cv2.Rodrigues(self.turn)[0], shift, plate.CAMERA,
                                         None)[0].reshape(-1, 2).tolist()
            pictures.append({
                'image': name, 'width': plate.WIDTH, 'height': plate.HEIGHT,
                'camera_matrix': plate.CAMERA.tolist(), 'distortion': [0] * 5,
                'checkerboards': [{'rows': 7, 'cols': 9, 'square_m': .02, 'surface': 'plane', 'pose': pose,
                                   'outline': outline([(-.09, -.07), (.09, -.07), (.09, .07), (-.09, .07)])}],
                'targets': [{'code': code, 'ring_m': ring, 'outline': outline([(x - .05, y - .05), (x + .05, y + .05)]),
                             'pose': {'t': (self.turn @ [x, y, 0] + shift).tolist()}} for code, ring, x, y in TARGETS]})
        self.write('set/truth.json', json.dumps({'images': pictures}))
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'scripts', 'evaluate_pose.py')
        output = os.path.join(self.folder, 'output')
        environment = dict(os.environ, PATH=os.path.dirname(OMR_POSITION) + os.pathsep + os.environ['PATH'])
        result = subprocess.run([sys.executable, script, os.path.join(self.folder, 'set'), '--output', output],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True,
                                env=environment, timeout=120)
        self.assertEqual((0, ''), (result.returncode, result.stderr))
        with open(os.path.join(output, 'report.md')) as file:
            report = file.read()
        self.assertIn('2 pictures: 2 located, 0 ambiguous, 0 flips', report)
        self.assertEqual(5, report.count('## ') - report.count('## Goals'))
        refused = subprocess.run([sys.executable, script, self.folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 universal_newlines=True)
        self.assertEqual(1, refused.returncode)
        self.assertIn('holds no truth.json', refused.stderr)

    def test_wrong_arguments(self):
        for arguments in ([], ['--camera', 'a', 'b.png'], ['--camera', 'a', '--parts', 'b']):
            result = subprocess.run([OMR_POSITION, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                    universal_newlines=True)
            self.assertEqual(2, result.returncode)
            self.assertIn('is required', result.stderr)


if __name__ == '__main__':
    OMR_POSITION = sys.argv.pop(1)
    unittest.main()
