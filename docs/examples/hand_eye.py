#!/usr/bin/env python3
"""Prints detections in the frame of the robot's base: base_from_camera * camera_from_object.

hand_eye.py RESULT.json BASE_FROM_CAMERA.json [MIN_PROBABILITY]

RESULT.json is a NAME.json of `edgescout detect`. BASE_FROM_CAMERA.json is {"R": 9 numbers by row,
"t": 3 numbers in metres}: where the camera was when it took the image.
"""
import json
import sys


def product(a, b):
    """c_from_a = c_from_b * b_from_a, for {"R": 9 by row, "t": 3}."""
    rows = [a["R"][0:3], a["R"][3:6], a["R"][6:9]]
    columns = [b["R"][i::3] for i in range(3)]
    rotation = [sum(x * y for x, y in zip(r, c)) for r in rows for c in columns]
    turned = [sum(x * y for x, y in zip(r, b["t"])) for r in rows]
    return {"R": rotation, "t": [x + y for x, y in zip(turned, a["t"])]}


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    with open(sys.argv[1]) as result_file, open(sys.argv[2]) as camera_file:
        result, base_from_camera = json.load(result_file), json.load(camera_file)
    min_probability = float(sys.argv[3]) if len(sys.argv) == 4 else 0
    for found in result["detections"]:
        if found["probability"] < min_probability:
            continue
        base_from_object = product(base_from_camera, found["camera_from_object"])
        print(f'{found["object"]}, probability {found["probability"]:.2f}')
        print("  t [m]", " ".join(f"{x:8.4f}" for x in base_from_object["t"]))
        for row in range(3):
            print("  R    ", " ".join(f"{x:8.4f}" for x in base_from_object["R"][3 * row:][:3]))


main()
