"""Compiles the core, in both real types, into one shared library beside the
module. It is no module of Python itself: twofold.py calls it by ctypes."""
from setuptools import Extension, setup

CORE = Extension(
    "_twofold", sources=["shared_f64.c", "shared_f32.c"],
    depends=["twofold.c", "twofold.h", "shared.h"],
    extra_compile_args=["-std=c99", "-O3", "-fno-math-errno"])

setup(py_modules=["twofold"], ext_modules=[CORE])
