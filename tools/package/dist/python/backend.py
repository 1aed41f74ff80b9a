"""Makes what pip installs, by the standard library and a C compiler: a package
that is built by setuptools needs that and wheel, which a new environment does
not have and pip would fetch (PEP 517 has the names of the functions here).

The core, in both real types, becomes one shared library beside the module. It
is no module of Python itself: the package calls it by ctypes."""
import base64
import hashlib
import os
import platform
import re
import shlex
import subprocess
import sysconfig
import tarfile
import tempfile
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
FLAGS = ["-std=c99", "-O3", "-fno-math-errno", "-fPIC"]
SOURCES = ("shared_f64.c", "shared_f32.c")
# Of the library an ensemble takes what is made for the processor it meets.
AVX2 = platform.machine().lower() in ("x86_64", "amd64")
INFO = (HERE / "PKG-INFO").read_text()
NAME = "twofold-" + re.search(r"^Version: (.+)$", INFO, re.M)[1]
# For any Python 3 on systems like this one.
TAG = "py3-none-" + re.sub(r"[-.]", "_", sysconfig.get_platform())
WHEEL = f"""\
Wheel-Version: 1.0
Generator: twofold
Root-Is-Purelib: false
Tag: {TAG}
"""


def compiled():
    """The shared library."""
    compiler = shlex.split(os.environ.get("CC") or "cc")
    with tempfile.TemporaryDirectory() as place:
        library = Path(place, "library")
        lanes = [str(Path(place, source + ".o")) for source in SOURCES * AVX2]
        commands = [[*compiler, *FLAGS, "-mavx2", "-DTWOFOLD_AVX2_LANES",
                     "-c", source, "-o", to]
                    for source, to in zip(SOURCES, lanes)]
        commands.append([*compiler, *FLAGS, "-shared", *SOURCES, *lanes,
                         *["-DTWOFOLD_HAS_AVX2_LANES"] * AVX2,
                         "-o", str(library), "-lm"])
        try:
            for command in commands:
                subprocess.run(command, cwd=HERE, check=True)
        except (OSError, subprocess.CalledProcessError) as error:
            raise SystemExit("twofold needs a C compiler of the kind of gcc "
                             f"(CC, else cc): {error}") from None
        return library.read_bytes()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes the wheel and returns its name."""
    del config_settings, metadata_directory
    files = {"twofold/_twofold.so": compiled(),
             **{f"twofold/{path.name}": path.read_bytes()
                for path in sorted(HERE.glob("twofold/*.*"))},
             f"{NAME}.dist-info/METADATA": INFO.encode(),
             f"{NAME}.dist-info/WHEEL": WHEEL.encode(),
             f"{NAME}.dist-info/LICENSE": (HERE / "LICENSE").read_bytes()}
    record = ""
    for path, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest())
        record += f"{path},sha256={digest.decode().rstrip('=')},{len(data)}\n"
    files[f"{NAME}.dist-info/RECORD"] = (
        f"{record}{NAME}.dist-info/RECORD,,\n".encode())
    wheel = f"{NAME}-{TAG}.whl"
    with zipfile.ZipFile(Path(wheel_directory, wheel), "w",
                         zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path)  # of 1980: the same bytes each time
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    """Packs this folder again and returns the name of the archive."""
    del config_settings
    archive = f"{NAME}.tar.gz"
    with tarfile.open(Path(sdist_directory, archive), "w:gz") as tar:
        for path in sorted(HERE.rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                tar.add(path, Path(NAME, path.relative_to(HERE)))
    return archive
