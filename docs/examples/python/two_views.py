"""Finds parts in two images of one scene at once. Their poses are in the world of the camera poses.

    python3 docs/examples/python/two_views.py OUT.png
"""

import json
import pathlib
import sys

import numpy as np

import edgescout

EXAMPLES = pathlib.Path(__file__).resolve().parents[1]
scene = EXAMPLES / "scenes/000001"


def pose(rotation, translation_mm):
    matrix = np.eye(4)
    matrix[:3, :3] = np.reshape(rotation, (3, 3))
    matrix[:3, 3] = np.array(translation_mm) / 1000
    return matrix


views = json.loads((scene / "scene_camera.json").read_text())
images = [edgescout.load_image(scene / f"gray/{int(view):06}.png") for view in views]
camera_from_world = [pose(v["cam_R_w2c"], v["cam_t_w2c"]) for v in views.values()]
height, width = images[0].shape
camera = edgescout.Camera(width, height, np.reshape(views["0"]["cam_K"], (3, 3)))

options = edgescout.TemplateOptions(distance_min=0.45, distance_max=0.52)
templates = [edgescout.Templates(edgescout.load_mesh(EXAMPLES / f"parts/obj_{part:06}.ply", "mm"),
                                 options, object_id=part) for part in (4, 6)]

# At the default, 0.4, a false nut on the cylinder is listed, too.
found = edgescout.detect_jointly(images, camera, camera_from_world, templates,
                                 edgescout.DetectOptions(min_probability=0.6))
for detection in found:
    deviation_mm = 1000 * np.sqrt(detection.covariance.diagonal()[:3])
    print(f"object {detection.object_id}: probability {detection.probability:.2f}, "
          f"at {detection.world_from_object[:3, 3].round(4)} m +- {deviation_mm.round(2)} mm")

drawn = [edgescout.overlay(image, camera, found, templates, camera_from_world=at)
         for image, at in zip(images, camera_from_world)]
edgescout.save_png(np.hstack(drawn), sys.argv[1])
