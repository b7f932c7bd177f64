#!/usr/bin/env python3
"""omr_sheet as its users call it. Usage: test_omr_sheet.py PATH_OF_OMR_SHEET"""
import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import cv2

OMR_SHEET = None
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


class OmrSheet(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def run_sheet(self, *arguments):
        return subprocess.run([OMR_SHEET, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              universal_newlines=True, timeout=120)

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_writes_all_formats_at_once(self):
        result = self.run_sheet('--checkerboard', '5x8', '--square', '15', '--target', 'RPG', '--target', 'BWP',
                                '--ring', '10', '--dpi', '100', 'a.svg', 'a.pdf', 'a.png')
        self.assertEqual((0, '', ''), (result.returncode, result.stdout, result.stderr))
        svg = xml.etree.ElementTree.parse(self.path('a.svg')).getroot()
        self.assertEqual(('210mm', '297mm'), (svg.get('width'), svg.get('height')))
        circles = [shape for shape in svg if shape.tag.endswith('circle')]
        self.assertEqual(6, len(circles))
        self.assertEqual((1169, 827, 3), cv2.imread(self.path('a.png')).shape)
        with open(self.path('a.pdf'), 'rb') as file:
            self.assertTrue(file.read().startswith(b'%PDF-1.4'))

    def test_landscape_makes_room(self):
        board = ['--checkerboard', '7x10', '--square', '20']
        refused = self.run_sheet(*board, 'a.svg')
        self.assertEqual(2, refused.returncode)
        self.assertRegex(refused.stderr, '^omr_sheet: the checkerboard 7 x 10 .* does not fit')
        self.assertFalse(os.path.exists(self.path('a.svg')))
        self.assertEqual(0, self.run_sheet(*board, '--landscape', 'a.svg').returncode)

    def test_what_the_guides_ask_for_fits_its_page(self):
        commands = []
        for guide in glob.glob(os.path.join(ROOT, 'docs', '*.md')) + [os.path.join(ROOT, 'README.md')]:
            with open(guide) as file:
                text = re.sub(r'\s+', ' ', file.read())
            commands += re.findall(r'\bomr_sheet (--[^`|#]*?\.(?:pdf|png|svg))\b', text)
        self.assertTrue(any('--checkerboard 7x10 --square 25' in command for command in commands), commands)
        for command in commands:
            done = self.run_sheet(*command.split())
            self.assertEqual(0, done.returncode, command + ': ' + done.stderr)

    def test_says_that_a_board_is_ambiguous(self):
        result = self.run_sheet('--checkerboard', '5x7', '--square', '15', 'a.svg')
        self.assertEqual(0, result.returncode)
        self.assertIn('upside down', result.stderr)

    def test_wrong_arguments(self):
        for arguments, told in ((['a.svg'], 'nothing to draw'), (['--target', 'RPG'], 'files'),
                                (['--target', 'RPG', 'a.jpg'], '.svg, .pdf or .png'),
                                (['--target', 'RPG', 'absent/a.svg'], 'cannot write'),
                                (['--target', 'RXG', 'a.svg'], 'W white'),
                                (['--checkerboard', '3x4', 'a.svg'], '5x7 to 21x21'),
                                (['--target', 'RPG', '--page', 'letter', 'a.svg'], 'WIDTHxHEIGHT'),
                                (['--target', 'RPG', '--ring', 'wide', 'a.svg'], 'ring')):
            result = self.run_sheet(*arguments)
            self.assertEqual(2, result.returncode, arguments)
            self.assertIn(told, result.stderr)


if __name__ == '__main__':
    OMR_SHEET = sys.argv.pop(1)
    unittest.main()
