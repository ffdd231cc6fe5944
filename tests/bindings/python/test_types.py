"""The type stubs name what the module has, and a user's program is checked by them."""

import ast
import os
import pathlib
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
found = edgescout.detect(edgescout.load_image("image.png"), camera, templates, max_seconds=1)
for detection in found:
    position_m: float = float(detection.world_from_object[0, 3])
"""


def run(module, *arguments, **options):
    return subprocess.run([sys.executable, "-m", module, *arguments], capture_output=True,
                          text=True, **options)


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_the_stubs_name_what_the_module_has():
    stub = ast.parse(pathlib.Path(edgescout.__file__).with_name("_core.pyi").read_text())
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    module = edgescout._core
    assert classes.keys() | functions == public(vars(module))
    for name, node in classes.items():
        listed = {member.name for member in node.body if isinstance(member, ast.FunctionDef)}
        listed |= {member.target.id for member in node.body if isinstance(member, ast.AnnAssign)}
        assert public(listed) == public(vars(getattr(module, name))), name


def test_a_users_program_is_checked(tmp_path):
    wrong = {"found[0].pose": 'has no attribute "pose"',
             "edgescout.load_mesh('part.stl')": 'Missing positional argument "unit"',
             "edgescout.detect(1, camera, templates)": "incompatible type"}
    (tmp_path / "program.py").write_text(PROGRAM + "\n".join(wrong) + "\n")
    package = os.path.dirname(edgescout.__file__)
    checked = run("mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), "program.py",
                  cwd=tmp_path, env={**os.environ, "MYPYPATH": os.path.dirname(package)})
    errors = [line for line in checked.stdout.splitlines() if ": error: " in line]
    assert len(errors) == len(wrong), checked.stdout
    for error, expected in zip(errors, wrong.values()):
        assert expected in error
