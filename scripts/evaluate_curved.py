"""Positions of boards on cylinders, each described to omr_position as what it is, bent, and as if it were flat."""
import json
import os
import subprocess
import sys

import numpy as np

from pose_truth import error_of, matrix_of, write_camera

NEAR = .2  # [m]; boards of one size are farther apart


def parts_text(board, bent):
    # The pictures' cylinders have their axes along the columns of the truth; a part's rows are the shorter side.
    rows, cols = sorted((board['rows'], board['cols']))
    axis = 'x' if board['rows'] > board['cols'] else 'y'
    surface = ', surface: {cylinder: %.6f, axis: %s}' % (board['cylinder_radius_m'], axis) if bent else ''
    return 'parts:\n- name: board\n  checkerboards: [{rows: %d, cols: %d, square: %.9f%s}]\n' % (
        rows, cols, board['square_m'], surface)


def locate(folder, picture, board, bent, output):
    """Error of the candidate nearest to the board (half a turn is ambiguous), and its reprojection error [px]."""
    parts, camera = os.path.join(output, 'parts.yaml'), os.path.join(output, 'camera.yaml')
    write_camera(camera, picture)
    with open(parts, 'w') as file:
        file.write(parts_text(board, bent))
    command = ['omr_position', '--camera', camera, '--parts', parts, '--json', '-']
    done = subprocess.run(command + [os.path.join(folder, picture['image'])], stdout=subprocess.PIPE,
                          universal_newlines=True)
    if done.returncode != 0:
        sys.exit('evaluate_pose: omr_position failed on %s' % picture['image'])
    answer = json.loads(done.stdout)
    candidates = answer['parts'] + sum(answer['ambiguous'], [])
    errors = [(*error_of(board, matrix_of(part['orientation']), np.array(part['position'])), part['reprojection_error'])
              for part in candidates]
    errors = [error for error in errors if np.hypot(error[1], error[2]) < NEAR * 1e3]
    return min(errors, key=lambda error: np.hypot(error[1], error[2]), default=None)


def evaluate(folder, pictures, output):
    """Prints and writes the table."""
    lines = ['| described as | boards | located | along, median [mm] | 95 % | across, median [mm] | 95 % '
             '| reprojection error, median [px] |', '|' + '---|' * 8]
    for name, bent in (('bent', True), ('flat', False)):
        errors = [locate(folder, picture, board, bent, output)
                  for picture in pictures for board in picture['checkerboards']]
        good = np.array([error for error in errors if error])
        lines.append('| %s | %d | %d | %.3f | %.3f | %.3f | %.3f | %.3f |' % (
            name, len(errors), len(good), np.median(good[:, 1]), np.percentile(good[:, 1], 95),
            np.median(good[:, 2]), np.percentile(good[:, 2], 95), np.median(good[:, 5])))
    print('\n'.join(lines))
    with open(os.path.join(output, 'report.md'), 'w') as report:
        report.write('\n'.join(lines) + '\n')
