"""Pictures with true poses: reading them, writing the files that omr_position takes, and the errors of an answer."""
import json
import os

import cv2
import numpy as np


def read_truth(folder):
    with open(os.path.join(folder, 'truth.json')) as file:
        return json.load(file)['images']


def pose_of(marker):
    """R (3 x 3) and t [m] of a marker in the camera's frame."""
    pose = marker['pose']
    return np.array(pose['R']), np.array(pose['t'])


def write_camera(path, picture, focal=1., principal=0.):
    """The camera_info file of a camera, with an error if one is given: a factor and pixels."""
    matrix = np.array(picture['camera_matrix'])
    matrix[0, 0] *= focal
    matrix[1, 1] *= focal
    matrix[0, 2] += principal
    with open(path, 'w') as file:
        file.write('image_width: %d\nimage_height: %d\ncamera_name: camera\n' % (picture['width'], picture['height']))
        file.write('camera_matrix: {rows: 3, cols: 3, data: %s}\n' % matrix.ravel().tolist())
        file.write('distortion_model: plumb_bob\n')
        file.write('distortion_coefficients: {rows: 1, cols: 5, data: %s}\n' % picture['distortion'])


def matrix_of(quaternion):
    vector = np.array(quaternion[:3])
    length = np.linalg.norm(vector)
    angle = 2 * np.arctan2(length, quaternion[3])
    return cv2.Rodrigues(vector * (angle / length if length else 0))[0]


def project(picture, points, step=np.zeros(6)):
    """Pixels of a part's points [m], the part moved [m] and turned [radians] by a step."""
    rotation, translation = pose_of(picture['checkerboards'][0])
    turn = cv2.Rodrigues(cv2.Rodrigues(step[3:])[0] @ rotation)[0]
    return cv2.projectPoints(points, turn, translation + step[:3], np.array(picture['camera_matrix']),
                             np.array(picture['distortion'], float))[0].reshape(-1, 2)


def bound_along(picture, points, sigmas):
    """Standard deviation [mm] along the ray that an estimate has at least (Cramer-Rao) if the part's points [m] are
    seen with independent errors of these sigmas [px]."""
    jacobian = np.stack([((project(picture, points, step) - project(picture, points, -step)) / 2e-5 /
                          sigmas[:, None]).ravel() for step in 1e-5 * np.eye(6)], 1)
    translation = pose_of(picture['checkerboards'][0])[1]
    ray = translation / np.linalg.norm(translation)
    covariance = np.linalg.inv(jacobian.T @ jacobian)[:3, :3]
    return np.sqrt(ray @ covariance @ ray) * 1e3


def error_of(board, rotation, translation, covariance=None):
    """Distance [m]; errors along and across the ray [mm] and of the rotation [degrees]; squared error by covariance."""
    true_rotation, true_translation = pose_of(board)
    shift = translation - true_translation
    ray = true_translation / np.linalg.norm(true_translation)
    along = shift @ ray
    turn = cv2.Rodrigues(rotation @ true_rotation.T)[0].ravel()
    error = np.concatenate([shift, turn])
    chi_square = np.nan if covariance is None else error @ np.linalg.solve(covariance, error)
    return (true_translation[2], abs(along) * 1e3, np.linalg.norm(shift - along * ray) * 1e3,
            np.degrees(np.linalg.norm(turn)), chi_square)
