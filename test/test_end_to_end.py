#!/usr/bin/env python3
"""What omr_sheet prints, omr_detect finds: on the sheet's views of make_scene.py. Usage: OMR_SHEET OMR_DETECT"""
import json
import os
import subprocess
import sys
import tempfile

SCRIPTS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), 'scripts')
CODES = ['GRGPB', 'RWPGB']


def main(omr_sheet, omr_detect):
    with tempfile.TemporaryDirectory() as folder:
        sheet = os.path.join(folder, 'sheet.png')
        subprocess.check_call([omr_sheet, '--page', '420x180', '--checkerboard', '7x10', '--square', '15', '--ring', '9',
                               '--target', CODES[0], '--target', CODES[1], '--dpi', '100', sheet])
        subprocess.check_call([sys.executable, os.path.join(SCRIPTS, 'make_scene.py'), sheet, folder, '--count', '4'])
        scenes = [os.path.join(folder, 'scene%02d.png' % index) for index in range(4)]
        lines = subprocess.check_output([omr_detect, '--json', '-', *scenes], universal_newlines=True).splitlines()
    failures = 0
    for line in map(json.loads, lines):
        boards = [(board['rows'], board['cols'], board['size_certain']) for board in line['checkerboards']]
        codes = sorted(target['colors'] for target in line['targets'])
        found = boards == [(7, 10, True)] and codes == CODES
        print(os.path.basename(line['image']), boards, codes, '' if found else 'FAILED')
        failures += not found
    return 0 if len(lines) == 4 and failures == 0 else 1


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
