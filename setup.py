# SPDX-License-Identifier: Apache-2.0
"""Puts the programs, built by CMake, into the Python package that pyproject.toml describes.

Environment: SURGICALMESHER_BUILD names a finished build whose programs are taken; without it, one is made in
build-python, to which CMAKE_ARGS goes. SURGICALMESHER_BUNDLE=1 adds the shared libraries that the programs are linked to.
"""
import os
import re
import shlex
import subprocess
import sys

from setuptools import setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel  # since 70.1
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

SOURCE = os.path.dirname(os.path.abspath(__file__))
GIVEN_BUILD = os.environ.get("SURGICALMESHER_BUILD")
SCRATCH = os.path.join(os.path.abspath(GIVEN_BUILD), "python") if GIVEN_BUILD else os.path.join(SOURCE, "build-python")


def project_version():
    with open(os.path.join(SOURCE, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\(SurgicalMesher VERSION (\S+)", file.read()).group(1)


def finished_build():
    """The CMake build folder with all programs."""
    if GIVEN_BUILD:
        return GIVEN_BUILD
    build = os.path.join(SCRATCH, "cmake")
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF"]
    subprocess.check_call(["cmake", "-S", SOURCE, "-B", build, *options, *shlex.split(os.environ.get("CMAKE_ARGS", ""))])
    subprocess.check_call(["cmake", "--build", build, "--parallel", str(os.cpu_count())])
    return build


class BuildWithPrograms(build_py):
    def run(self):
        super().run()
        build = finished_build()
        components = ["RuntimeLibraries"]
        if os.environ.get("SURGICALMESHER_BUNDLE") == "1":
            components.append("Bundle")
        package = os.path.join(self.build_lib, "surgicalmesher")
        for component in components:
            subprocess.check_call(["cmake", "--install", build, "--prefix", package, "--component", component, "--strip"])


class PlatformWheel(bdist_wheel):
    """For any Python 3, on systems like this one: nothing in it is linked to Python."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


if os.name != "posix":
    sys.exit("setup.py: the surgicalmesher program, which the package runs, is built on POSIX systems only")
os.makedirs(SCRATCH, exist_ok=True)
setup(version=project_version(), cmdclass={"build_py": BuildWithPrograms, "bdist_wheel": PlatformWheel},
      options={"build": {"build_base": SCRATCH}, "egg_info": {"egg_base": SCRATCH}})
