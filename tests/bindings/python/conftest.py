"""The example scene, its templates and one detection in it, made once."""

import json
import os
import pathlib
from types import SimpleNamespace

import numpy as np
import pytest

import edgescout

SOURCE = pathlib.Path(__file__).resolve().parents[3]
SCENE = SOURCE / "docs/examples/scenes/000000"
PART = SOURCE / "docs/examples/parts/obj_000001.ply"


@pytest.fixture(scope="session")
def program():
    return os.environ["EDGESCOUT_PROGRAM"]


@pytest.fixture(scope="session")
def scene():
    image = edgescout.load_image(SCENE / "gray/000000.png")
    matrix = json.loads((SCENE / "scene_camera.json").read_text())["0"]["cam_K"]
    backend = edgescout.Backend("cpu", threads=2)
    camera = edgescout.Camera(image.shape[1], image.shape[0], np.reshape(matrix, (3, 3)))
    few = {"distance_min": 0.32, "distance_max": 0.36, "viewpoints": 3, "in_plane_steps": 12}
    fewer = {"coarse_poses": 600, "medium_poses": 100, "candidates": 20}
    templates = edgescout.Templates(edgescout.load_mesh(PART, "mm"),
                                    edgescout.TemplateOptions(**few), backend=backend)

    def detect(image, min_probability=0.4, **more):
        options = edgescout.DetectOptions(min_probability=min_probability, **fewer)
        return edgescout.detect(image, camera, templates, options, backend=backend, **more)

    return SimpleNamespace(detect=detect, image=image, camera=camera, templates=templates,
                           backend=backend, file=SCENE / "gray/000000.png", part=PART,
                           arguments=[word for name, value in (few | fewer).items() for word in
                                      ("--" + name.replace("_", "-"), str(value))])


@pytest.fixture(scope="session")
def found(scene):
    return scene.detect(scene.image)
