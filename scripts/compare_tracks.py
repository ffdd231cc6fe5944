#!/usr/bin/env python3
"""Compares poses of `edgescout track`, `detect` or `register` with the true ones of a BOP scene.

    scripts/compare_tracks.py SCENE OUT.. [--center X Y Z] [--min-score S]

Each OUT is a folder with a results.csv; one object a scene. Prints a row for each: images with a
pose, errors of the point --center (m, object frame) along the camera's axis and across it, and of
the rotation. Of several poses of an image that of the highest score counts.
"""
import argparse
import csv
import json
import math
import pathlib


def quantile(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))] if values else math.nan


def placed(rotation, translation, point):
    return [sum(rotation[3 * row + c] * point[c] for c in range(3)) + translation[row]
            for row in range(3)]


def errors_of(row, true, center_mm):
    """Along the axis and across it, mm; of the rotation, degrees."""
    rotation = [float(word) for word in row['R'].split()]
    found = placed(rotation, [float(word) for word in row['t'].split()], center_mm)
    known = placed(true['cam_R_m2c'], true['cam_t_m2c'], center_mm)
    trace = sum(a * b for a, b in zip(rotation, true['cam_R_m2c']))
    return (abs(found[2] - known[2]), math.hypot(found[0] - known[0], found[1] - known[1]),
            math.degrees(math.acos(max(-1, min(1, (trace - 1) / 2)))))


def best_poses(file, least_score):
    best = {}
    for row in csv.DictReader(file.open()):
        score = float(row['score'])
        if score >= least_score and score > best.get(row['im_id'], {'s': -1})['s']:
            best[row['im_id']] = {'s': score, 'row': row}
    return {image: found['row'] for image, found in best.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('scene', type=pathlib.Path)
    parser.add_argument('out', type=pathlib.Path, nargs='+')
    parser.add_argument('--center', type=float, nargs=3, default=(0, 0, 0))
    parser.add_argument('--min-score', type=float, default=0)
    given = parser.parse_args()
    center_mm = [1000 * value for value in given.center]
    truths = json.loads((given.scene / 'scene_gt.json').read_text())
    print('| poses | images | along the axis, median, mm | 95 % | across, median | 95 % '
          '| rotation, median, degrees | 95 % |\n|---|---|---|---|---|---|---|---|')
    for out in given.out:
        poses = best_poses(out / 'results.csv', given.min_score)
        errors = [errors_of(row, truths[image][0], center_mm)
                  for image, row in poses.items() if image in truths]
        columns = list(zip(*errors)) or [(), (), ()]
        cells = [f'{quantile(column, part):.2f}' for column in columns for part in (0.5, 0.95)]
        print(f'| {out.name} | {len(errors)} of {len(truths)} | ' + ' | '.join(cells) + ' |')


if __name__ == '__main__':
    main()
