"""Matches detected poses with true ones, as `edgescout eval` does.

A pose is right if it is within MAX_ANGLE_RAD and MAX_DISTANCE_MM of a true pose of its object,
modulo symmetry. Each pose in turn, most probable first, takes the free truth that it fits best.
A second pose of the same instance is therefore wrong.
"""
import csv
import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

MAX_ANGLE_RAD = 0.1
MAX_DISTANCE_MM = 5.0
TURNS = 315  # samples of a continuous symmetry: 0.01 rad, as in BOP's evaluation


@dataclass
class Pose:
    rotation: np.ndarray  # camera from object
    translation_mm: np.ndarray


@dataclass
class Truth:
    pose: Pose
    visible: float  # fraction of its silhouette
    found: float = math.nan  # probability of the pose that took it


@dataclass
class Estimate:
    pose: Pose
    probability: float
    right: bool = False


def rotations_about(axis, count):
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angles = (2 * math.pi * np.arange(count) / count)[:, None, None]
    return np.eye(3) + np.sin(angles) * cross + (1 - np.cos(angles)) * (cross @ cross)


def load_symmetries(models_info, object_id):
    """Rotations [n, 3, 3] and translations [n, 3] in mm, the identity among them. The file lists
    all discrete symmetries, not only generators."""
    info = json.loads(Path(models_info).read_text())[str(object_id)]
    listed = [np.eye(4)] + [np.reshape(m, (4, 4)) for m in info.get("symmetries_discrete", [])]
    discrete = np.array(listed)
    rotations, translations = discrete[:, :3, :3], discrete[:, :3, 3]
    for continuous in info.get("symmetries_continuous", []):
        turns = rotations_about(continuous["axis"], TURNS)
        offset = np.asarray(continuous["offset"], float)
        shifts = offset - turns @ offset
        translations = (np.einsum("tij,nj->tni", turns, translations) +
                        shifts[:, None]).reshape(-1, 3)
        rotations = np.einsum("tij,njk->tnik", turns, rotations).reshape(-1, 3, 3)
    return rotations, translations


def error_of_bounds(estimate, truth, symmetries):
    """The larger of angle and distance, each divided by its bound, at the best symmetry: below 1
    if the pose is right."""
    rotations, translations = symmetries
    turned = truth.rotation @ rotations
    cosine = (np.einsum("ij,nij->n", estimate.rotation, turned) - 1) / 2
    angle = np.arccos(np.clip(cosine, -1, 1))
    places = translations @ truth.rotation.T + truth.translation_mm
    distance = np.linalg.norm(estimate.translation_mm - places, axis=1)
    return float(np.maximum(angle / MAX_ANGLE_RAD, distance / MAX_DISTANCE_MM).min())


def match(estimates, truths, symmetries):
    """Fills in Estimate.right and Truth.found for one image."""
    free = list(truths)
    for estimate in sorted(estimates, key=lambda e: -e.probability):
        errors = [error_of_bounds(estimate.pose, t.pose, symmetries) for t in free]
        if not errors or min(errors) >= 1:
            continue
        estimate.right = True
        free.pop(int(np.argmin(errors))).found = estimate.probability


def load_truths(dataset, object_id=1):
    """By (scene, image): the instances of one object in a BOP dataset."""
    images = {}
    for file in sorted(Path(dataset).glob("[0-9]*/scene_gt.json")):
        visible = json.loads((file.parent / "scene_gt_info.json").read_text())
        for image, entries in json.loads(file.read_text()).items():
            images[int(file.parent.name), int(image)] = [
                Truth(Pose(np.reshape(e["cam_R_m2c"], (3, 3)), np.array(e["cam_t_m2c"])),
                      visible[image][i]["visib_fract"])
                for i, e in enumerate(entries) if e["obj_id"] == object_id]
    return images


def load_estimates(results, object_id=1):
    """By (scene, image): the poses of one object in a BOP results CSV."""
    images = {}
    with open(results, newline="") as file:
        for row in csv.DictReader(file):
            if int(row["obj_id"]) != object_id:
                continue
            pose = Pose(np.array(row["R"].split(), float).reshape(3, 3),
                        np.array(row["t"].split(), float))
            key = int(row["scene_id"]), int(row["im_id"])
            images.setdefault(key, []).append(Estimate(pose, float(row["score"])))
    return images
