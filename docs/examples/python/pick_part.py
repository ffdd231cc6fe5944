"""Turns a pose in the camera into a pose of the gripper, and decides whether to grasp.

    python3 docs/examples/python/pick_part.py OUT.png

A robot's own numbers replace the three at the top: where the flange is, where the camera sits on it
(hand-eye calibration), and where the gripper takes the part.
"""

import pathlib
import sys

import numpy as np

import edgescout

EXAMPLES = pathlib.Path(__file__).resolve().parents[1]
scene = EXAMPLES / "scenes/000000"


def pose(rotation_z_rad=0.0, translation_m=(0, 0, 0)):
    c, s = np.cos(rotation_z_rad), np.sin(rotation_z_rad)
    return np.array([[c, -s, 0, translation_m[0]], [s, c, 0, translation_m[1]],
                     [0, 0, 1, translation_m[2]], [0, 0, 0, 1]])


base_from_flange = pose(0.5, (0.4, 0.1, 0.5))     # from the arm's controller
flange_from_camera = pose(-np.pi / 2, (0.05, 0, 0.06))  # from the hand-eye calibration
object_from_gripper = pose(0, (0, 0, 0.01))       # taught once, on the CAD model

MIN_PROBABILITY = 0.8   # docs/calibration.md: by which probability to grasp
JAWS_M = 0.004          # how far off the jaws still close on the part, each way
JAWS_RAD = 0.1

image = edgescout.load_image(scene / "gray/000000.png")
camera = edgescout.load_camera(scene / "scene_camera.json")
templates = edgescout.Templates(
    edgescout.load_mesh(EXAMPLES / "parts/obj_000002.ply", unit="mm"),
    edgescout.TemplateOptions(distance_min=0.3, distance_max=0.38))


def uncertainty(detection):
    """Largest standard deviations of the gripper's place and turn, m and rad, at 95 %."""
    rotation = detection.world_from_object[:3, :3]
    arm = rotation @ object_from_gripper[:3, 3]       # from the object's origin to the grasp
    cross = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
    moved = np.block([[np.eye(3), -cross], [np.zeros((3, 3)), np.eye(3)]])
    covariance = moved @ detection.covariance @ moved.T
    factor = 2.8                                       # 95 % of a Gaussian in three dimensions
    return (factor * np.sqrt(np.linalg.eigvalsh(covariance[:3, :3])[-1]),
            factor * np.sqrt(np.linalg.eigvalsh(covariance[3:, 3:])[-1]))


found = edgescout.detect(image, camera, templates)
for detection in found:
    camera_from_gripper = detection.world_from_object @ object_from_gripper
    base_from_gripper = base_from_flange @ flange_from_camera @ camera_from_gripper
    off_m, off_rad = uncertainty(detection)
    fits = off_m < JAWS_M and off_rad < JAWS_RAD
    decision = ("grasp" if detection.probability >= MIN_PROBABILITY and fits else
                "look again: the place is not certain enough" if not fits else
                "leave: it may be something else")
    print(f"probability {detection.probability:.2f}, within {1e3 * off_m:.1f} mm and "
          f"{off_rad:.3f} rad: {decision}")
    print("base_from_gripper\n", base_from_gripper.round(4))

edgescout.save_png(edgescout.overlay(image, camera, found, templates), sys.argv[1])
