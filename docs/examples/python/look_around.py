"""Takes the next best view until the part is certain. Recorded images stand in for an arm.

    python3 docs/examples/python/look_around.py OUT.png
"""

import json
import pathlib
import sys

import numpy as np

import edgescout

EXAMPLES = pathlib.Path(__file__).resolve().parents[1]
scene = EXAMPLES / "scenes/000001"

views = json.loads((scene / "scene_camera.json").read_text())
camera_from_world = np.tile(np.eye(4), (len(views), 1, 1))
for at, view in zip(camera_from_world, views.values()):
    at[:3, :3] = np.reshape(view["cam_R_w2c"], (3, 3))
    at[:3, 3] = np.array(view["cam_t_w2c"]) / 1000


def take_image(view):  # an arm moves to camera_from_world[view] here
    return edgescout.load_image(scene / f"gray/{view:06}.png")


height, width = take_image(0).shape
camera = edgescout.Camera(width, height, np.reshape(views["0"]["cam_K"], (3, 3)))
templates = edgescout.Templates(
    edgescout.load_mesh(EXAMPLES / "parts/obj_000006.ply", "mm"),
    edgescout.TemplateOptions(distance_min=0.45, distance_max=0.52))
scout = edgescout.Scout(templates, camera, camera_from_world, edgescout.ScoutOptions(max_views=5))

while (proposal := scout.propose()) is not None:
    scout.give(proposal.view, take_image(proposal.view))
    best = [f"{instance.probability:.2f}" for instance in scout.detections]
    print(f"view {proposal.view}: entropy {scout.entropy_nats:.3f} nats, found {best}")
print("end:", scout.end)

picture = edgescout.overlay(take_image(0), camera, scout.detections, templates,
                            camera_from_world=camera_from_world[0])
edgescout.save_png(picture, sys.argv[1])
