"""Follows a part from image to image. The example image, moved by some pixels, is the video.

    python3 docs/examples/python/follow_part.py OUT.png
"""

import pathlib
import sys

import numpy as np

import edgescout

EXAMPLES = pathlib.Path(__file__).resolve().parents[1]
scene = EXAMPLES / "scenes/000000"

first = edgescout.load_image(scene / "gray/000000.png")
height, width = first.shape
camera = edgescout.load_camera(scene / "scene_camera.json").with_size(width, height)
templates = edgescout.Templates(
    edgescout.load_mesh(EXAMPLES / "parts/obj_000001.ply", unit="mm"),
    edgescout.TemplateOptions(distance_min=0.32, distance_max=0.36))

tracker = edgescout.Tracker(templates, camera)
print("found:", tracker.search(first))
for frame in range(10):
    image = np.roll(first, (2 * frame, 6 * frame), axis=(0, 1))
    for track in tracker.update(image, frame / 30):
        sigma_mm = 1e3 * np.sqrt(np.diag(track.covariance)[:3])
        print(f"{track.id} {track.state.name}: at {track.camera_from_object[:3, 3].round(4)} m, "
              f"to {sigma_mm.round(2)} mm")

edgescout.save_png(tracker.overlay(image), sys.argv[1])
