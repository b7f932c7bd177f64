#!/usr/bin/env python3
"""The python scripts as the shell scripts call them. Usage: test_scripts.py PATH_OF_OMR_SHEET"""
import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np
import rosbag

SCRIPTS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), 'scripts')
sys.path.insert(0, SCRIPTS)
import contact_sheet  # noqa: E402
OMR_SHEET = None

# Stands in for omr_detect: finds nothing but a checkerboard that is not there.
FALSE_DETECTOR = """#!/usr/bin/env python3
import json, sys
with open(sys.argv[sys.argv.index('--json') + 1], 'w') as file:
    for image in sys.argv:
        if image.endswith('.png'):
            board = {'rows': 5, 'cols': 7, 'corners': [[5, 5], [50, 5], [50, 40], [5, 40]]}
            file.write(json.dumps({'image': image, 'checkerboards': [board], 'targets': []}) + '\\n')
"""

# Stands in for the scorer: one picture with a board found, one with a board missed and a false one.
SCORER = """#!/usr/bin/env python3
import json, sys
board = {'care': True, 'min_square_px': 20, 'visible_fraction': 1}
def picture(image, hit, filter_name):
    return {'image': image, 'set': sys.argv[1].split('/')[-1], 'factors': {'filter': filter_name, 'lighting': 'hard'},
            'checkerboard': {'tp': int(hit), 'fp': int(not hit), 'fn': int(not hit)},
            'target': {'tp': 0, 'fp': 0, 'fn': 0}, 'boards': [dict(board, hit=hit)], 'targets': []}
filters = sys.argv[sys.argv.index('--filters') + 1].split(',')
pictures = [picture(image, image == 'a.png', name) for name in filters for image in ('a.png', 'b.png')]
kind = {'tp': 1, 'fp': 1, 'fn': 1, 'precision': .5, 'recall': .5}
pool = {'pictures': len(pictures), 'checkerboard': kind, 'target': dict(kind, precision=None), 'color_accuracy': None,
        'time_ms': {'mean': 5, 'median': 4, 'max': 9}}
sets = {sys.argv[1].split('/')[-1]: {'all': pool}}
json.dump({'pictures': pictures, 'sets': sets}, open(sys.argv[sys.argv.index('--json') + 1], 'w'))
print('scored %d files' % (sys.argv.index('--filters') - 2))
"""


class Scripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def run_script(self, name, *arguments, path=None):
        environment = dict(os.environ, PATH=(path + ':' if path else '') + os.environ['PATH'])
        return subprocess.run([sys.executable, os.path.join(SCRIPTS, name), *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, universal_newlines=True, timeout=120, env=environment)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), 'w') as file:
            file.write(text)
        os.chmod(self.path(name), stat.S_IRWXU)

    def test_a_path_that_catkin_cannot_test_in_is_refused(self):
        for name, refused in (('my robot', True), ("d'or", True), ('a;b', True), ('cell_1.0+a-b', False)):
            scripts = self.path(name, 'scripts')
            os.makedirs(scripts)
            for script in ('test', 'environment.sh'):
                shutil.copy(os.path.join(SCRIPTS, script), scripts)
            self.write(os.path.join(name, 'scripts', 'setup'), '#!/bin/sh\necho set up >&2; exit 3\n')
            result = subprocess.run([os.path.join(scripts, 'test')], stderr=subprocess.PIPE, universal_newlines=True)
            self.assertEqual(1 if refused else 3, result.returncode, result.stderr)
            self.assertIn("move or clone '%s'" % self.path(name) if refused else 'set up', result.stderr)
            self.assertEqual(1, result.stderr.count('\n'), result.stderr)

    def test_scenes_show_the_sheet_from_several_sides(self):
        sheet = self.path('sheet.png')
        subprocess.check_call([OMR_SHEET, '--target', 'RWPGB', '--ring', '12', '--dpi', '60', sheet])
        for folder in ('once', 'again'):
            result = self.run_script('make_scene.py', sheet, self.path(folder), '--count', '3')
            self.assertEqual(0, result.returncode, result.stderr)
        scenes = [cv2.imread(self.path('once', name)).astype(int) for name in sorted(os.listdir(self.path('once')))]
        self.assertEqual(3, len(scenes))
        self.assertGreater(np.abs(scenes[0] - scenes[2]).mean(), 5)
        for scene in scenes:  # blue, green and red of the rings
            self.assertTrue(all((np.argmax(scene, axis=2)[np.ptp(scene, axis=2) > 60] == i).any() for i in range(3)))
        self.assertTrue((scenes[1] == cv2.imread(self.path('again', 'scene01.png'))).all(), 'a scene is a lottery')

    def make_bag(self):
        images = []
        for index in range(2):
            images.append(self.path('%d.png' % index))
            cv2.imwrite(images[-1], np.full((20, 30, 3), (10, 20 + index, 30), np.uint8))
        result = self.run_script('make_bag.py', self.path('in.bag'), *images, '--topic', '/eye', '--rate', '4')
        self.assertEqual(0, result.returncode, result.stderr)
        return images

    def test_a_bag_holds_images_and_their_names(self):
        self.make_bag()
        with rosbag.Bag(self.path('in.bag')) as bag:
            images = [message for _, message, _ in bag.read_messages(['/eye'])]
            names = [message.data for _, message, _ in bag.read_messages(['/eye_file'])]
            self.assertLessEqual(1, images[0].header.stamp.to_sec() - bag.get_start_time())
            self.assertLess(2, bag.get_end_time() - images[-1].header.stamp.to_sec())
        self.assertEqual([(30, 20, 90, 'bgr8', 'camera')] * 2,
                         [(i.width, i.height, i.step, i.encoding, i.header.frame_id) for i in images])
        self.assertEqual(bytes([10, 21, 30]) * 600, images[1].data)
        self.assertEqual(0.25, (images[1].header.stamp - images[0].header.stamp).to_sec())
        self.assertEqual(['', '0.png', '1.png', ''], names)

    def test_a_forgotten_bag_costs_no_image(self):
        image = self.path('0.png')
        self.assertTrue(cv2.imwrite(image, np.full((20, 30, 3), 10, np.uint8)))
        result = self.run_script('make_bag.py', image, image)
        self.assertEqual(1, result.returncode)
        self.assertIn("would overwrite the image '%s'" % image, result.stderr)
        self.assertIsNotNone(cv2.imread(image))

    def test_an_image_without_an_answer_fails_the_report(self):
        self.make_bag()
        with rosbag.Bag(self.path('out.bag'), 'w'):
            pass
        result = self.run_script('report_bag.py', self.path('in.bag'), self.path('out.bag'), self.path('overlays'))
        self.assertEqual(1, result.returncode)
        self.assertIn('0.png: no answer', result.stdout)
        self.assertIn('2 images, 0 answered', result.stdout)

    def make_data(self):
        board = {'rows': 5, 'cols': 7, 'outline': [[10, 10], [90, 10], [90, 60], [10, 60]]}
        images = [{'image': name, 'checkerboards': [board], 'targets': []} for name in ('a.png', 'b.png')]
        for name in ('doe', 'other'):
            self.write('data/%s/truth.json' % name, json.dumps({'images': images}))
            for image in images:
                cv2.imwrite(self.path('data', name, image['image']), np.zeros((75, 100, 3), np.uint8))
        self.write('bin/omr_detect', FALSE_DETECTOR)
        self.write('data/score.py', SCORER)

    def evaluate(self, *arguments):
        return self.run_script('evaluate.py', self.path('data'), '--output', self.path('report'), *arguments,
                               path=self.path('bin'))

    def test_evaluate_writes_one_report_folder(self):
        self.make_data()
        result = self.evaluate()
        self.assertEqual(0, result.returncode, result.stderr)
        self.assertEqual({'doe.json', 'doe.none.jsonl', 'doe.gaussian.jsonl', 'doe.median.jsonl', 'other.json',
                          'other.default.jsonl', 'report.txt', 'summary.md', 'recall_size.png', 'recall_hidden.png', 'lighting.png',
                          'failures.jpg'}, set(os.listdir(self.path('report'))))
        with open(self.path('report', 'report.txt')) as file:
            self.assertEqual('scored 3 files\nscored 1 files\n', file.read())
        with open(self.path('report', 'summary.md')) as file:
            self.assertIn('| other (2) | 1 / 1 / 1 | 50.0, 50.0 | - | 1 / 1 / 1 | -, 50.0 | - | - | 4, 9 |', file.read())
        self.assertIn('4 markers missed or false, 0 misread', result.stdout)
        sheet = cv2.imread(self.path('report', 'failures.jpg')).astype(int)
        # Four tiles in rows of three; left half as seen, in the right one the missed board red, what was read yellow.
        self.assertEqual((2 * 342, 3 * 640), sheet.shape[:2])
        is_red, is_yellow = ((sheet[..., 2] > 180) & (sheet[..., 0] < 80) & part
                             for part in (sheet[..., 1] < 80, sheet[..., 1] > 180))
        for colored in (is_red, is_yellow):
            self.assertFalse(colored[22:342, :320].any())
            self.assertTrue(colored[22:342, 320:640].any())

    def test_failures_are_told_marker_by_marker(self):
        def square(x, text, color):
            return contact_sheet.Marker(np.array([[x, 0], [x + 10, 0], [x + 10, 10], [x, 10]], float), text, color)

        def failures(truths, detections):
            return [(failure.caption, failure.is_minor) for failure in contact_sheet.failures(truths, detections)]

        found, missed = square(0, 'RGB', contact_sheet.GREEN), square(20, 'WPW', contact_sheet.RED)
        nameless, ignored = square(40, '', contact_sheet.GREEN), square(60, 'BRB', contact_sheet.GREY)
        truths = [found, missed, nameless, ignored]
        read = [square(x, text, contact_sheet.YELLOW) for x, text in ((0, 'RGB'), (40, 'PWP'), (60, 'BRR'))]
        self.assertEqual([('WPW, read: -', False)], failures(truths, read))
        self.assertEqual([('RGB, read: RGB R?B', True)],
                         failures([found], [read[0], square(1, 'R?B', contact_sheet.YELLOW)]))
        self.assertEqual([('RGB, read: R?B', True)], failures([found], [square(0, 'R?B', contact_sheet.YELLOW)]))
        self.assertEqual([('nothing, read: PWP', False)], failures([found], [read[0], read[1]]))

    def test_evaluate_chosen_sets_and_filters(self):
        self.make_data()
        self.assertEqual(0, self.evaluate('--sets', 'doe', '--filters', 'median').returncode)
        self.assertTrue({'doe.json', 'doe.median.jsonl'} <= set(os.listdir(self.path('report'))))
        self.assertFalse(os.path.exists(self.path('report', 'other.json')))
        result = self.evaluate('--sets', 'dough')
        self.assertEqual(1, result.returncode)
        self.assertIn('it has doe, other', result.stderr)

    def test_evaluate_beside_a_peer(self):
        self.make_data()
        self.assertEqual(0, self.evaluate('--sets', 'other', '--peers', 'quads').returncode)
        self.assertTrue({'other.quads.json', 'other.quads.jsonl'} <= set(os.listdir(self.path('report'))))
        with open(self.path('report', 'summary.md')) as file:
            self.assertIn('| other | 1 / 1 / 1 | 1 / 1 / 1, - px, 4 ms |', file.read())
        result = self.evaluate('--peers', 'squads')
        self.assertEqual(1, result.returncode)
        self.assertIn('no peer squads; there are mrgingham, quads, sector', result.stderr)

    def test_peers_find_every_board_that_they_are_told(self):
        pattern = np.kron(np.indices((5, 7)).sum(axis=0) % 2 * 255, np.ones((20, 20))).astype(np.uint8)
        board = cv2.copyMakeBorder(pattern, 40, 40, 40, 40, cv2.BORDER_CONSTANT, value=255)
        boards = [{'rows': 5, 'cols': 7}] * 2
        self.write('two/truth.json', json.dumps({'images': [{'image': 'two.png', 'checkerboards': boards}]}))
        cv2.imwrite(self.path('two', 'two.png'), np.hstack([board, board]))
        for peer in ('quads', 'sector'):
            result = self.run_script('peers.py', peer, self.path('two'), self.path('found.jsonl'))
            self.assertEqual(0, result.returncode, result.stderr)
            with open(self.path('found.jsonl')) as file:
                found = json.load(file)['checkerboards']
            self.assertEqual([(5, 7), (5, 7)], [(board['rows'], board['cols']) for board in found], peer)
            self.assertEqual([24, 24], [len(board['inner_corners']) for board in found])
            centers = sorted(np.mean(board['inner_corners'], axis=0)[0] for board in found)
            self.assertTrue(np.allclose([109.5, 329.5], centers, atol=.1), centers)

    def test_evaluate_without_a_scorer(self):
        self.make_data()
        os.remove(self.path('data', 'score.py'))
        result = self.evaluate()
        self.assertEqual(1, result.returncode)
        self.assertIn('score.py is missing', result.stderr)


if __name__ == '__main__':
    OMR_SHEET = sys.argv.pop(1)
    unittest.main()
