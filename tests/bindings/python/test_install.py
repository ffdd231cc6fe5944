"""pip installs the package into a virtual environment with the system's packages."""

import os
import pathlib
import subprocess
import sys

import pytest

pytest.importorskip("venv")
pytest.importorskip("setuptools")
PACKAGE = pathlib.Path(__file__).resolve().parents[3] / "host/bindings/python"


def test_pip_installs_it(tmp_path):
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"],
                   check=True)
    python = tmp_path / "venv/bin/python"
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    installed = subprocess.run(
        [python, "-m", "pip", "install", "-q", "--no-build-isolation", "--no-deps",
         "--no-index", PACKAGE], env=environment, capture_output=True, text=True)
    assert installed.returncode == 0, installed.stderr
    program = ("import edgescout, pathlib; print(edgescout.__file__, edgescout.__version__);"
               "print(edgescout.Backend('cpu').name);"
               "print(*[f.name for f in pathlib.Path(edgescout.__file__).parent.iterdir()])")
    printed = subprocess.run([python, "-c", program], env=environment, check=True,
                             capture_output=True, text=True, cwd=tmp_path).stdout
    assert str(tmp_path / "venv") in printed and "cpu" in printed
    assert "py.typed" in printed and "libedgescout.so" in printed
