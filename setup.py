"""Builds the package by CMake, for `pip install . --no-build-isolation`.

What has been built is not built again: the folder is build/pip, or the one that ROCKYARD_BUILD names.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py

ROOT = Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    def build_extension(self, ext):
        build = Path(os.environ.get("ROCKYARD_BUILD") or ROOT / "build" / "pip")
        if not (build / "CMakeCache.txt").exists():
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DROCKYARD_BUILD_TESTS=OFF", "-DROCKYARD_BUILD_BENCHMARKS=OFF",
                            f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        try:
            subprocess.run(["cmake", "--build", build, "--target", "rockyard_python_module"], check=True)
        except subprocess.CalledProcessError:
            sys.exit("rockyard: the module was not built; it needs python3-dev, pybind11-dev and libboost-context-dev")
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(build / "python" / "rockyard" / target.name, target)


class WithData(build_py):
    """Adds what lies elsewhere in the project: the base class of navigators, scenarios, published values."""

    def run(self):
        super().run()
        package = Path(self.build_lib) / "rockyard"
        shutil.copy(ROOT / "examples/navigators/rockyard_navigator.py", package / "navigator.py")
        for source, name in (("scenarios", "scenarios"), ("results/reference", "results/reference")):
            shutil.copytree(ROOT / source, package / name, dirs_exist_ok=True)
        for stub in (ROOT / "src/python/rockyard").glob("*.py[it]*"):
            shutil.copy(stub, package / stub.name)


version = re.search(r"project\(rockyard VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
setup(version=version[1], ext_modules=[Extension("rockyard._core", [])],
      cmdclass={"build_ext": BuildByCMake, "build_py": WithData})
