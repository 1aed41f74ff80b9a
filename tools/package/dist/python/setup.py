"""The core and the command line in both real types become two libraries beside
the package, which calls them by ctypes: they are no modules of Python."""
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCES = ["shared.c", "lanes.c", "help.c", *map(str, sorted(
    Path("tools").rglob("*.c")))]


class Library(build_ext):
    """Named alike for every Python."""

    def get_ext_filename(self, fullname):
        return str(Path(*fullname.split("."))) + ".so"


setup(cmdclass={"build_ext": Library}, ext_modules=[Extension(
    f"twofold._{name}", SOURCES, include_dirs=["include", "tools"],
    libraries=["m"], define_macros=[("main", "twofold_main"), *macros],
    extra_compile_args=["-std=c99", "-O3", "-ffp-contract=off",
                        "-fno-math-errno"])
    for name, macros in (("f64", []), ("f32", [("TF_REAL_FLOAT", None)]))])
