"""A user's program is checked by the type stubs."""

import os
import subprocess
import sys

import pytest

import edgescout

pytest.importorskip("mypy")

PROGRAM = """
import numpy as np
import edgescout

camera = edgescout.Camera(640, 480, np.eye(3))
templates = edgescout.Templates(edgescout.load_mesh("part.stl", unit="mm"), camera=camera)
camera = edgescout.Camera(640, 480, camera.K, camera.distortion, camera.lens).with_size(640, 480)
state: int = int(edgescout.TrackState.LOST)
lens = edgescout.LensModel.__members__["FISHEYE"]
both = edgescout.detect_jointly([np.zeros((480, 640), np.uint8)], [camera], [np.eye(4)], templates)
options = edgescout.DetectOptions(min_probability=0.5, world_box=[0, 1, 0, 1, 0, 1])
poses: int = options.coarse_poses
found = edgescout.detect(edgescout.load_image("image.png"), camera, templates, options,
                         max_seconds=1)
for detection in found:
    position_m: float = float(detection.world_from_object[0, 3])
"""


def run(module, *arguments, **options):
    return subprocess.run([sys.executable, "-m", module, *arguments], capture_output=True,
                          text=True, **options)


def test_a_users_program_is_checked(tmp_path):
    wrong = {"found[0].pose": 'has no attribute "pose"',
             "edgescout.load_mesh('part.stl')": 'Missing positional argument "unit"',
             "edgescout.DetectOptions(min_probabilty=0.5)": 'argument "min_probabilty"',
             "options.coarse_poses = 1.5": "Incompatible types",
             "edgescout.detect(1, camera, templates)": "incompatible type"}
    (tmp_path / "program.py").write_text(PROGRAM + "\n".join(wrong) + "\n")
    package = os.path.dirname(edgescout.__file__)
    checked = run("mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), "program.py",
                  cwd=tmp_path, env={**os.environ, "MYPYPATH": os.path.dirname(package)})
    errors = [line for line in checked.stdout.splitlines() if ": error: " in line]
    assert len(errors) == len(wrong), checked.stdout
    for error, expected in zip(errors, wrong.values()):
        assert expected in error
