"""Finds a part in one image and draws it.

    python3 docs/examples/python/find_part.py OUT.png
"""

import pathlib
import sys

import edgescout

EXAMPLES = pathlib.Path(__file__).resolve().parents[1]
scene = EXAMPLES / "scenes/000000"

image = edgescout.load_image(scene / "gray/000000.png")
camera = edgescout.load_camera(scene / "scene_camera.json")
mesh = edgescout.load_mesh(EXAMPLES / "parts/obj_000001.ply", unit="mm")
templates = edgescout.Templates(
    mesh, edgescout.TemplateOptions(distance_min=0.32, distance_max=0.36))

found = edgescout.detect(image, camera, templates)
for detection in found:
    print(f"{detection.name}: probability {detection.probability:.2f}, camera_from_object")
    print(detection.world_from_object.round(4))

edgescout.save_png(edgescout.overlay(image, camera, found, templates), sys.argv[1])
