"""The core in both real types becomes one library beside the package, which
calls it by ctypes: it is no module of Python itself."""
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext


class Library(build_ext):
    """Named alike for every Python."""

    def get_ext_filename(self, fullname):
        return str(Path(*fullname.split("."))) + ".so"


setup(cmdclass={"build_ext": Library}, ext_modules=[Extension(
    "twofold._twofold", ["shared_f64.c", "shared_f32.c", "lanes_f64.c",
                         "lanes_f32.c"], libraries=["m"],
    extra_compile_args=["-std=c99", "-O3", "-fno-math-errno"])])
