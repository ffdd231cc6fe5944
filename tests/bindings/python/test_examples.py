"""The programs of the documents run and draw what they find."""

import pathlib
import subprocess
import sys

import numpy as np
import pytest

import edgescout

PROGRAMS = pathlib.Path(__file__).resolve().parents[3] / "docs/examples/python"


@pytest.mark.parametrize("name, line", [
    ("find_part", "obj_000001: probability 0.9"),
    ("two_views", "object 6: probability 0.9"),
    ("look_around", "end: no view left"),
    ("refine_pose", "probability 0.9"),
    ("pick_part", "rad: look again: 2 of 3 images\n"),  # nothing else speaks against it
    ("scout_with_arm", "end: no view left"),
    ("follow_part", "1 TRACKED"),
    ("notebook", "back within 0."),
])
def test_runs_and_draws(name, line, tmp_path):
    run = subprocess.run([sys.executable, PROGRAMS / f"{name}.py", tmp_path / "out.png"],
                         capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert line in run.stdout
    picture = edgescout.load_image(tmp_path / "out.png")
    assert picture.shape[0] == 480 and np.unique(picture).size > 100


def test_each_program_is_tested():
    assert len(list(PROGRAMS.glob("*.py"))) == 8
