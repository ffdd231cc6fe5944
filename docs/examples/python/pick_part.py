"""Turns a pose in the base into a pose of the gripper, and decides whether to grasp.

    python3 docs/examples/python/pick_part.py OUT.png

A robot's own numbers replace those at the top: where the camera sits on the flange (hand-eye
calibration), and where the gripper takes the part. The recorded scene has two images, one fewer
than the rule asks for, so the answer here is to take another image.
"""

import json
import pathlib
import sys

import numpy as np

import edgescout

EXAMPLES = pathlib.Path(__file__).resolve().parents[1]
scene = EXAMPLES / "scenes/000001"


def pose(rotation, translation_m):
    matrix = np.eye(4)
    matrix[:3, :3] = np.reshape(rotation, (3, 3))
    matrix[:3, 3] = translation_m
    return matrix


object_from_gripper = pose(np.eye(3), (0, 0, 0.01))  # taught once, on the CAD model

# The rule of docs/calibration.md, "From which probability to report or to grasp". It asks for more:
# a calibration that was checked, and a person who looks at the first hundred overlays.
MIN_IMAGES = 3
MIN_PROBABILITY = 0.9
MAX_ALTERNATIVE = 0.1  # of a pose that this one may be confused with
JAWS_M = 0.004         # how far off the jaws still close on the part, each way
JAWS_RAD = 0.1


def uncertainty(detection):
    """How far off the gripper's place and turn are at 95 %, along their worst axes, m and rad."""
    rotation = detection.world_from_object[:3, :3]
    arm = rotation @ object_from_gripper[:3, 3]       # from the object's origin to the grasp
    cross = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
    moved = np.block([[np.eye(3), -cross], [np.zeros((3, 3)), np.eye(3)]])
    covariance = moved @ detection.covariance @ moved.T
    factor = 2.8                                       # 95 % of a Gaussian in three dimensions
    return (factor * np.sqrt(np.linalg.eigvalsh(covariance[:3, :3])[-1]),
            factor * np.sqrt(np.linalg.eigvalsh(covariance[3:, 3:])[-1]))


def reasons_against(detection, image_count):
    """What of the rule does not hold; empty: grasp."""
    off_m, off_rad = uncertainty(detection)
    alternative = max((other.probability for other in detection.alternatives), default=0)
    reasons = []
    if image_count < MIN_IMAGES:
        reasons.append(f"{image_count} of {MIN_IMAGES} images")
    if detection.probability < MIN_PROBABILITY:
        reasons.append(f"probability {detection.probability:.2f}")
    if alternative > MAX_ALTERNATIVE:
        reasons.append(f"another pose at this place has {alternative:.2f}")
    if not (off_m < JAWS_M and off_rad < JAWS_RAD):  # also where an entry is infinite
        reasons.append(f"known to {1e3 * off_m:.1f} mm and {off_rad:.3f} rad only")
    return reasons


# The arm's base is the world here. On an arm camera_from_base is
# inverse(base_from_flange @ flange_from_camera), with the arm's pose at the time of the image.
views = json.loads((scene / "scene_camera.json").read_text())
camera_from_base = [pose(view["cam_R_w2c"], np.array(view["cam_t_w2c"]) / 1000)
                    for view in views.values()]
images = [edgescout.load_image(scene / f"gray/{int(view):06}.png") for view in views]
height, width = images[0].shape
camera = edgescout.Camera(width, height, np.reshape(views["0"]["cam_K"], (3, 3)))
templates = edgescout.Templates(
    edgescout.load_mesh(EXAMPLES / "parts/obj_000002.ply", unit="mm"),
    edgescout.TemplateOptions(distance_min=0.27, distance_max=0.46),
    symmetries="y2")  # it looks the same after a half turn about its y axis

found = edgescout.detect_jointly(images, camera, camera_from_base, templates)
for detection in found:
    off_m, off_rad = uncertainty(detection)
    reasons = reasons_against(detection, len(images))
    print(f"probability {detection.probability:.2f}, within {1e3 * off_m:.1f} mm and "
          f"{off_rad:.3f} rad: {'look again: ' + ', '.join(reasons) if reasons else 'grasp'}")
    print("base_from_gripper\n", (detection.world_from_object @ object_from_gripper).round(4))

edgescout.save_png(edgescout.overlay(images[0], camera, found, templates,
                                     camera_from_world=camera_from_base[0]), sys.argv[1])
