"""Detection, registration, the scout and the tracker find what C++ finds, bit for bit.

The program results_of_cpp prints it (tests/bindings/c); the same is computed here.
"""

import json
import os
import pathlib
import re
import subprocess

import numpy as np
import pytest

import edgescout

PROGRAM = os.environ.get("EDGESCOUT_RESULTS_OF_CPP")
pytestmark = pytest.mark.skipif(not PROGRAM, reason="the C interface is not built")
EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "docs/examples"

QUICK = {"coarse_poses": 500, "medium_poses": 60, "coarse_poses_joint": 200,
         "medium_poses_joint": 40, "candidates": 5}
PART_WINDOW, SCOUT_WINDOW = (0, 160, 200, 210), (150, 215, 320, 160)  # x, y, width, height


def window_of(file, window):
    x, y, width, height = window
    image = edgescout.load_image(EXAMPLES / "scenes" / file)[y:y + height, x:x + width]
    camera = edgescout.Camera(width, height,
                              [[700, 0, 319.5 - x], [0, 700, 239.5 - y], [0, 0, 1]])
    return image, camera


def depth_of(window):
    """As depth_values.h makes it."""
    _, _, width, height = window
    y, x = np.mgrid[0:height, 0:width]
    depth = (330 + y // 16 + x // 64).astype(np.uint16)
    depth[100:140, 20:60] = 0
    return depth


def templates_of(part, distance_m, viewpoints, backend):
    mesh = edgescout.load_mesh(EXAMPLES / f"parts/obj_{part:06}.ply", "mm")
    options = edgescout.TemplateOptions(distance_min=distance_m, distance_max=distance_m,
                                        viewpoints=viewpoints)
    return edgescout.Templates(mesh, options, object_id=part, backend=backend, cached=False)


def numbers(name, values):
    return f"  {name} " + " ".join(float(value).hex() for value in np.ravel(values))


def lines_of_detection(detection):
    lines = [f" object {detection.object} id {detection.object_id} {detection.name}, "
             f"{detection.convergence}",
             numbers("pose", detection.world_from_object),
             numbers("covariance", detection.covariance),
             numbers("scores", [detection.probability, detection.psi, detection.psi_z_score,
                                detection.cost_px, detection.matched_fraction,
                                detection.unexplained_grey])]
    for other in detection.alternatives:
        lines += [numbers("alternative", other.world_from_object),
                  numbers("probability", other.probability)]
    return lines


def lines_of_detections(found):
    assert found.is_complete
    lines = [f"{len(found)}, completion 0", *(f" stage {name}" for name in found.seconds)]
    return lines + [line for detection in found for line in lines_of_detection(detection)]


def results_in_one_view(backend):
    templates = templates_of(1, 0.34, 2, backend)
    image, camera = window_of("000000/gray/000000.png", PART_WINDOW)
    options = edgescout.DetectOptions(min_probability=0.05, **QUICK)
    found = edgescout.detect(image, camera, templates, options, backend=backend)
    tracker = edgescout.Tracker(templates, camera, backend=backend)
    tracker.add(found[0].world_from_object, found[0].object)
    tracks = []
    for i in range(1, 4):
        track, = tracker.update(image, i / 30)
        tracks += [f"track {track.id} of object {track.object}: state {int(track.state)}",
                   numbers("pose", track.camera_from_object),
                   numbers("covariance", track.covariance),
                   numbers("above chance", track.above_chance)]
    starts = np.repeat(np.eye(4)[None], 2, axis=0)
    starts[:, :3, 3] = [-0.11, 0.01, 0.33], [5, 0.01, 0.33]
    registered = edgescout.register(image, camera, templates, starts, backend=backend)
    with_options = edgescout.register(
        image, camera, templates, starts, backend=backend,
        options=edgescout.RegisterOptions(edge_sigma=1.5, bins=30, search_kept=2))
    with_depth = edgescout.detect(image, camera, templates, options, depth=depth_of(PART_WINDOW),
                                  depth_options=edgescout.DepthOptions(depth_noise=0.002),
                                  backend=backend)
    return {"track": tracks, "detect": lines_of_detections(found),
            "register": lines_of_detections(registered),
            "register with options": lines_of_detections(with_options),
            "detect with depth": lines_of_detections(with_depth)}


def poses_of_views():
    """Of views.h, which C++ reads: those of the scene's file, rounded otherwise."""
    text = pathlib.Path(__file__).parents[1].joinpath("c/views.h").read_text()
    table = text[text.index("= {") + 2:text.rindex(";")]
    return np.reshape(json.loads(table.replace("{", "[").replace("}", "]")), (2, 4, 4))


def results_in_two_views(backend):
    templates = [templates_of(4, 0.37, 1, backend), templates_of(6, 0.37, 2, backend)]
    images = [window_of(f"000001/gray/00000{i}.png", SCOUT_WINDOW)[0] for i in range(2)]
    camera = window_of("000001/gray/000000.png", SCOUT_WINDOW)[1]
    poses, depth = poses_of_views(), [None, depth_of(SCOUT_WINDOW)]
    scout = edgescout.Scout(
        templates, camera, poses,
        edgescout.ScoutOptions(particles=40, combinations=100, max_searches=1, **QUICK),
        reachable=[1], backend=backend)
    proposal = scout.propose()
    for i in range(2):
        scout.give(i, images[i], depth=depth[i])
    options = edgescout.DetectOptions(min_probability=0.05, **QUICK)
    jointly, with_depth = (
        edgescout.detect_jointly(images, [camera] * 2, poses, templates, options, depth=given,
                                 backend=backend) for given in (None, depth))
    instances = scout.detections
    lines = [f"{len(instances)}, completion 0"]
    for instance in instances:
        lines += lines_of_detection(instance)
        lines += [f"  supported by image {image}" for image in instance.supporting_images]
    return {"detect_jointly": lines_of_detections(jointly),
            "detect_jointly with depth": lines_of_detections(with_depth), "scout": lines,
            "proposal": [f"view {proposal.view}"]}


def results_of_cpp():
    """By the name of the call. Numbers are written as Python writes them."""
    printed = subprocess.run([PROGRAM, EXAMPLES], check=True, capture_output=True, text=True).stdout
    exact = re.sub(r"-?0x[0-9a-f.]+p[+-]\d+", lambda found: float.fromhex(found[0]).hex(), printed)
    results, lines = {}, []
    for line in exact.splitlines():
        if line.startswith("track "):
            lines = results.setdefault("track", [])
        elif not line.startswith(" "):
            name, line = line.split(": ", 1)
            lines = results.setdefault(name, [])
        lines.append(line)
    return results


def test_equals_cpp():
    backend = edgescout.Backend("cpu", threads=2)
    results = results_in_one_view(backend) | results_in_two_views(backend)
    expected = results_of_cpp()
    del expected["register with a depth camera"]  # Python takes depth of the image's camera alone
    assert results.keys() == expected.keys()
    for name, lines in expected.items():
        assert results[name] == lines, name
    assert any("object" in line for line in results["scout"])
