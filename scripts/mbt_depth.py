#!/usr/bin/env python3
"""Makes BOP scenes of ViSP's RGB-D sequences, for `edgescout track`, `register` and `detect`.

    scripts/mbt_depth.py OUT [--from /usr/share/visp-images-data/ViSP-images/mbt-depth]

The sequences come with Debian's visp-images-data. Writes for each of them a folder, `rendered` (40
images, all with a true pose) and `real` (30 images of a RealSense, a pose of the first one):

    gray/ depth/ scene_camera.json     images, depth of its own camera
    depth_camera.json depth_pose.txt   what --depth-camera and --depth-pose take
    scene_gt.json start.json           the poses; the first one, for --poses
    castle.cao *.cao                   the model, m
"""
import argparse
import array
import json
import math
import pathlib
import shutil
import struct
import sys
import zlib

WIDTH, HEIGHT = 640, 480


def png(width, height, bits, rows):
    """A grey PNG; each row is the bytes of its pixels, the higher byte first."""
    def chunk(name, data):
        return (struct.pack('>I', len(data)) + name + data
                + struct.pack('>I', zlib.crc32(name + data)))
    header = struct.pack('>IIBBBBB', width, height, bits, 0, 0, 0, 0)
    packed = zlib.compress(b''.join(b'\0' + row for row in rows), 1)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', packed)
            + chunk(b'IEND', b''))


def image_of_pgm(file):
    """The pixels are the last bytes of a binary PGM."""
    pixels = file.read_bytes()[-WIDTH * HEIGHT:]
    return png(WIDTH, HEIGHT, 8, [pixels[WIDTH * y:WIDTH * (y + 1)] for y in range(HEIGHT)])


def depth_of_bin(file):
    """Height and width, 32 bit, then 16 bit a pixel; all with the lower byte first."""
    data = file.read_bytes()
    height, width = struct.unpack('<II', data[:8])
    values = array.array('H', data[8:])
    if len(values) != height * width:
        sys.exit(f'{file}: found {len(values)} values, expected {width} x {height}')
    if sys.byteorder == 'little':
        values.byteswap()
    return png(width, height, 16, [values[width * y:width * (y + 1)].tobytes()
                                   for y in range(height)])


def matrix_of_file(file):
    numbers = [float(word) for word in file.read_text().split()]
    return [numbers[4 * row:4 * row + 4] for row in range(3)]


def matrix_of_vector(file):
    """A translation, m, and a rotation vector."""
    *place, x, y, z = [float(word) for word in file.read_text().split()]
    angle = math.sqrt(x * x + y * y + z * z)
    x, y, z = x / angle, y / angle, z / angle
    c, s, k = math.cos(angle), math.sin(angle), 1 - math.cos(angle)
    rotation = [[c + x * x * k, x * y * k - z * s, x * z * k + y * s],
                [x * y * k + z * s, c + y * y * k, y * z * k - x * s],
                [x * z * k - y * s, y * z * k + x * s, c + z * z * k]]
    return [row + [t] for row, t in zip(rotation, place)]


def inverse(matrix):
    rotation = [[matrix[c][r] for c in range(3)] for r in range(3)]
    return [row + [-sum(row[c] * matrix[c][3] for c in range(3))] for row in rotation]


def pose_words(matrix):
    """x y z and a quaternion x y z w, of a rotation of less than 180 degrees."""
    (a, b, c, x), (d, e, f, y), (g, h, i, z) = matrix
    w = 0.5 * math.sqrt(1 + a + e + i)
    words = [x, y, z, (h - f) / (4 * w), (c - g) / (4 * w), (d - b) / (4 * w), w]
    return ' '.join(f'{word:.9f}' for word in words)


def start(number, matrix):
    return [{'image': f'{number:06}.png', 'object': 1, 'R': [n for row in matrix for n in row[:3]],
             't': [row[3] for row in matrix]}]


def truth(matrix):
    return [{'obj_id': 1, 'cam_R_m2c': [n for row in matrix for n in row[:3]],
             'cam_t_m2c': [1000 * row[3] for row in matrix]}]


class Scene:
    """One sequence. Cameras are fx, fy, cx, cy; `unit_m` is that of stored depth."""

    def __init__(self, out, cameras, unit_m, grey_from_depth):
        self.out = out
        self.grey, depth = cameras
        self.unit_m = unit_m
        self.cameras, self.truths = {}, {}
        for folder in ('gray', 'depth'):
            (out / folder).mkdir(parents=True, exist_ok=True)
        (out / 'depth_camera.json').write_text(json.dumps(
            dict(zip(('fx', 'fy', 'cx', 'cy'), depth), width=WIDTH, height=HEIGHT)))
        (out / 'depth_pose.txt').write_text(pose_words(grey_from_depth) + '\n')

    def add(self, number, grey, depth, camera_from_object):
        (self.out / f'gray/{number:06}.png').write_bytes(image_of_pgm(grey))
        (self.out / f'depth/{number:06}.png').write_bytes(depth_of_bin(depth))
        fx, fy, cx, cy = self.grey
        self.cameras[str(number)] = {'cam_K': [fx, 0, cx, 0, fy, cy, 0, 0, 1],
                                     'depth_scale': 1000 * self.unit_m}
        if not camera_from_object:
            return
        if not self.truths:
            (self.out / 'start.json').write_text(json.dumps(start(number, camera_from_object)))
        self.truths[str(number)] = truth(camera_from_object)

    def finish(self):
        (self.out / 'scene_camera.json').write_text(json.dumps(self.cameras))
        (self.out / 'scene_gt.json').write_text(json.dumps(self.truths))


def copy_models(folders, out):
    for folder in folders:
        for file in folder.glob('*.cao'):
            shutil.copy(file, out)


def rendered(source, out):
    camera = (700, 700, 319.5, 239.5)  # ViSP's file counts from the pixels' corners here
    scene = Scene(out, (camera, camera), 0.000030518,
                  [[1, 0, 0, 0.05], [0, 1, 0, 0], [0, 0, 1, 0]])
    copy_models([source / 'Models', source / 'Models/chateau_parts'], out)
    turn = math.pi / math.sqrt(2)
    (out / 'castle.cao').write_text(
        'V1\nload("chateau_floor.cao")\nload("chateau_tower.cao")\n'
        f'load("cube.cao", t=[-0.2; 0.12; -0.15], tu=[0; {turn}; {turn}])\n' + '0\n' * 6)
    for number in range(1, 41):
        scene.add(number, source / f'Images/Image_{number:04}.pgm',
                  source / f'Depth/Depth_{number:04}.bin',
                  matrix_of_file(source / f'CameraPose/Camera_{number:03}.txt'))
    scene.finish()


def real(source, out):
    grey = (615.1674804688, 615.1675415039, 312.1889953613, 243.4373779297)
    depth = (476.0536193848, 476.0534973145, 311.4845581055, 246.2832336426)
    scene = Scene(out, (grey, depth), 0.000124987,
                  inverse(matrix_of_file(source / 'depth_M_color.txt')))
    copy_models([source / 'chateau_parts'], out)
    parts = ('floor', 'tower', 'front_door', 'slope')
    (out / 'castle.cao').write_text(
        'V1\n' + ''.join(f'load("chateau_{part}.cao")\n' for part in parts) + '0\n' * 6)
    for number in range(30):
        scene.add(number, source / f'castel/image_{number:04}.pgm',
                  source / f'castel/depth_image_{number:04}.bin',
                  None if number else matrix_of_vector(source / 'chateau.0.pos'))
    scene.finish()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('out', type=pathlib.Path)
    parser.add_argument('--from', dest='source', type=pathlib.Path,
                        default='/usr/share/visp-images-data/ViSP-images/mbt-depth')
    given = parser.parse_args()
    rendered(given.source / 'Castle-simu', given.out / 'rendered')
    real(given.source / 'castel', given.out / 'real')


if __name__ == '__main__':
    main()
