# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the module fcl_kios._core by CMake, with the library in it. See pyproject.toml."""
import os
import pathlib
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def pybind11_dir():
    """Options that find pybind11 where it is a package of Python, as in pip's own environment."""
    try:
        import pybind11
    except ImportError:
        return []  # Debian's pybind11-dev
    return ["-Dpybind11_DIR=" + pybind11.get_cmake_dir()]


class BuildByCMake(build_ext):
    def build_extension(self, ext):
        built = ROOT / "build" / f"python-{sys.version_info.major}.{sys.version_info.minor}"
        prefix = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent.parent
        jobs = subprocess.run([ROOT / "scripts/jobs"], check=True, capture_output=True, text=True)
        for command in (
                ["cmake", "--preset", "library", "-B", built, "-DBUILD_SHARED_LIBS=OFF",
                 "-DCMAKE_POSITION_INDEPENDENT_CODE=ON", "-DFCL_KIOS_BUILD_PYTHON=ON",
                 "-DFCL_KIOS_BUILD_ROBOT=AUTO", "-DFCL_KIOS_PYTHON_DIR=.", f"-DCMAKE_INSTALL_PREFIX={prefix}",
                 f"-DPython3_EXECUTABLE={sys.executable}", *pybind11_dir()],
                ["cmake", "--build", built, "--target", "fcl_kios_python", "-j",
                 os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", jobs.stdout.strip())],
                ["cmake", "--install", built, "--component", "python"]):
            subprocess.run([str(part) for part in command], cwd=ROOT, check=True)
        shutil.rmtree(prefix / "share", ignore_errors=True)  # a Debian package's papers


setup(version=(ROOT / "VERSION").read_text().split()[0], ext_modules=[Extension("fcl_kios._core", [])],
      cmdclass={"build_ext": BuildByCMake})
