"""Puts the library that TVG_LIBRARY names into the wheel, which is then for this kind of machine only."""
import os
import shutil
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70.1
    from wheel.bdist_wheel import bdist_wheel

HERE = os.path.dirname(os.path.abspath(__file__))
LICENSE = os.path.join(HERE, os.pardir, "LICENSE")
if os.path.exists(LICENSE):  # of the project; an sdist has it already
    shutil.copyfile(LICENSE, os.path.join(HERE, "LICENSE"))

LIBRARY = os.environ.get("TVG_LIBRARY")
if LIBRARY and not os.path.isfile(LIBRARY):
    sys.exit(f"TVG_LIBRARY={LIBRARY} is no file; pip builds in a folder of its own, so write the whole path")
# The name that the package looks for beside itself.
BUNDLED = {"win32": "tvg.dll", "darwin": "libtvg.dylib"}.get(sys.platform, "libtvg.so.0.2")


class BuildWithLibrary(build_py):
    """build_py, and the library."""

    def run(self):
        super().run()
        target = os.path.join(self.build_lib, "tvg", BUNDLED)
        if LIBRARY:
            shutil.copyfile(LIBRARY, target)
        elif os.path.exists(target):
            os.remove(target)  # of a build before this one


class ForMachine(Distribution):
    """What has the library in it is for this kind of machine."""

    def has_ext_modules(self):
        return bool(LIBRARY)


class WheelForMachine(bdist_wheel):
    """Any Python 3, and where the library is in it, this kind of machine."""

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


setup(distclass=ForMachine, cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": WheelForMachine})
