"""Builds the package with CMake, from the repository that this file lies in.

    pip install ./host/bindings/python --no-build-isolation

EDGESCOUT_BUILD names a build folder that is used again; without it, one is made and removed.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

REPOSITORY = pathlib.Path(__file__).resolve().parents[3]
LIBRARY = "libedgescout.so.*"


class BuildByCMake(build_ext):
    def build_extension(self, ext: Extension) -> None:
        given = os.environ.get("EDGESCOUT_BUILD")
        build = pathlib.Path(given or self.build_temp).resolve()
        if not given:
            subprocess.run(
                ["cmake", "-S", REPOSITORY, "-B", build, "-G", "Ninja",
                 "-DCMAKE_BUILD_TYPE=Release", "-DEDGESCOUT_TESTS=OFF", "-DEDGESCOUT_BENCH=OFF",
                 f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "edgescout_python"], check=True)
        package = pathlib.Path(self.get_ext_fullpath(ext.name)).parent
        package.mkdir(parents=True, exist_ok=True)
        for module in (build / "python/edgescout").glob("_core*.so"):
            shutil.copy(module, package)
        for library in (build / "host").glob(LIBRARY):
            shutil.copy(library, package, follow_symlinks=True)


def version() -> str:
    text = (REPOSITORY / "CMakeLists.txt").read_text()
    return re.search(r"project\(edgescout VERSION ([\d.]+)", text).group(1)


setup(
    name="edgescout",
    version=version(),
    description="Finds textureless rigid objects in grey images from their CAD models",
    packages=["edgescout"],
    package_data={"edgescout": ["py.typed", "_core.pyi"]},
    ext_modules=[Extension("edgescout._core", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
    install_requires=["numpy"],
    python_requires=">=3.9",
    zip_safe=False,
)
