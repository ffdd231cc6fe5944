"""Refines a pose that is known roughly. The picture has the rough pose on the left.

    python3 docs/examples/python/refine_pose.py OUT.png
"""

import pathlib
import sys

import numpy as np

import edgescout

EXAMPLES = pathlib.Path(__file__).resolve().parents[1]
scene = EXAMPLES / "scenes/000000"

image = edgescout.load_image(scene / "gray/000000.png")
camera = edgescout.load_camera(scene / "scene_camera.json")
templates = edgescout.Templates(edgescout.load_mesh(EXAMPLES / "parts/obj_000001.ply", "mm"),
                                edgescout.TemplateOptions(distance_min=0.3, distance_max=0.4))

camera_from_object = np.array([[-0.42, 0.91, 0.03, -0.115],
                               [0.73, 0.36, -0.58, 0.016],
                               [-0.54, -0.22, -0.81, 0.345],
                               [0, 0, 0, 1]])
u, _, v = np.linalg.svd(camera_from_object[:3, :3])
camera_from_object[:3, :3] = u @ v  # typed with two digits: the nearest rotation

(refined,) = edgescout.register(image, camera, templates, [camera_from_object])
moved_mm = 1000 * (refined.world_from_object - camera_from_object)[:3, 3]
print(f"moved by {moved_mm.round(2)} mm, probability {refined.probability:.2f}, "
      f"{refined.convergence}")

(rough,) = edgescout.register(image, camera, templates, [camera_from_object], max_seconds=0)
drawn = [edgescout.overlay(image, camera, [each], templates) for each in (rough, refined)]
edgescout.save_png(np.hstack(drawn), sys.argv[1])
