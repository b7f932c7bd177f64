"""Pictures of a printed plate at known poses before a known camera, for tests."""
import cv2
import numpy as np

WIDTH, HEIGHT = 960, 720
FOCAL = 1000.
CAMERA = np.array([[FOCAL, 0, 470], [0, FOCAL, 365], [0, 0, 1]])
PIXELS_PER_METRE = 4000
INK = {'W': (235, 235, 235), 'P': (30, 30, 30), 'R': (50, 50, 200), 'G': (60, 150, 40), 'B': (170, 80, 40)}  # BGR


def paper(rows, cols, square, targets=()):
    """A sheet 0.4 x 0.3 m with a board in its middle and targets (colours, ring [m], x, y [m]); also the homography
    from metres, about the middle, to its pixels."""
    scale = PIXELS_PER_METRE
    sheet = np.full((int(.3 * scale), int(.4 * scale), 3), 235, np.uint8)
    middle = np.array([sheet.shape[1] / 2, sheet.shape[0] / 2])
    for row in range(rows):
        for col in range(cols):
            if (row + col) % 2 == 0:
                low = middle + (np.array([col - cols / 2, row - rows / 2]) * square * scale)
                x, y = np.rint(low).astype(int)
                side = int(round(square * scale))
                sheet[y:y + side, x:x + side] = 30
    for colors, ring, x, y in targets:
        center = np.rint(middle + np.array([x, y]) * scale).astype(int).tolist()
        for number in range(len(colors), 0, -1):
            cv2.circle(sheet, center, int(round(number * ring * scale)), INK[colors[number - 1]], -1)
    to_pixels = np.array([[scale, 0, middle[0] - .5], [0, scale, middle[1] - .5], [0, 0, 1.]])
    return sheet, to_pixels


def rotation(x, y, z):
    """About the camera's x, then y, then z, degrees."""
    return cv2.Rodrigues(np.radians([0, 0, float(z)]))[0] @ cv2.Rodrigues(np.radians([0, float(y), 0]))[0] @ \
        cv2.Rodrigues(np.radians([float(x), 0, 0]))[0]


def picture(sheet, turn, shift):
    """The sheet at R (3 x 3), t [m] as the camera sees it, blurred and with noise."""
    image, to_pixels = sheet
    homography = CAMERA @ np.column_stack([turn[:, 0], turn[:, 1], shift]) @ np.linalg.inv(to_pixels)
    # Twice the size and halved again: no steps at the edges. The centre of the first pixel stays at (0, 0).
    double = np.array([[2, 0, .5], [0, 2, .5], [0, 0, 1.]])
    large = cv2.warpPerspective(image, double @ homography, (2 * WIDTH, 2 * HEIGHT), flags=cv2.INTER_AREA,
                                borderValue=(120, 125, 130))
    seen = cv2.GaussianBlur(cv2.resize(large, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA), (0, 0), .6)
    noise = np.random.default_rng(1).normal(0, 1.5, seen.shape)
    return np.clip(seen + noise, 0, 255).astype(np.uint8)


def camera_info():
    """The camera's yaml file."""
    return ('image_width: %d\nimage_height: %d\ncamera_name: test\ncamera_matrix: {rows: 3, cols: 3, data: %s}\n'
            'distortion_model: plumb_bob\ndistortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n'
            % (WIDTH, HEIGHT, CAMERA.ravel().tolist()))
