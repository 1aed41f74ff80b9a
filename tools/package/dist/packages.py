#!/usr/bin/python3
"""Makes the packages of build/dist: templates of tools/package/dist with the
version filled in, and the two files and the prepared scene where each one wants
them.

usage: packages.py C FOLDER HELP
C: the folder with twofold.h, twofold.c and the headers of PREPARED. HELP: what
the command line prints, as C.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

from sources import ROOT, version

HERE = Path(__file__).resolve().parent
# Arduino passes no option to a library.
FLOAT = """\
#if !defined(TF_REAL_DOUBLE) && !defined(TF_REAL_FLOAT)
#define TF_REAL_FLOAT // no option reaches a library of Arduino
#endif

"""
BOTH = ("twofold.h", "twofold.c")
# The scenes that packages have prepared: chaos, and one under a single-valued
# law, of which an Uno has room for the code.
PREPARED = ("chaos", "smooth")
# By template: where the package lies, the folder of its sources, which of
# them, and what they begin with.
PACKAGES = {
    "cmake": ("cmake/twofold", ".", BOTH, ""),
    "arduino": ("arduino/twofold", "src",
                BOTH + tuple(f"twofold_{name}.h" for name in PREPARED), FLOAT),
    "platformio": ("platformio/twofold", "src", BOTH + ("twofold_chaos.h",),
                   ""),
    "zephyr": ("zephyr/twofold", "src", BOTH, ""),
    "esp-idf": ("esp-idf/twofold", "src", BOTH, ""),
    "python": (f"python/twofold-{version()}", ".", BOTH, ""),
}


def fill(template, to):
    """Copies a folder of templates with the version in place; what is named
    after a scene is copied for each of PREPARED. `.in` stands after the name
    of what is no C yet."""
    for path in sorted(template.rglob("*")):
        if not path.is_file() or "__pycache__" in path.parts:
            continue
        name = path.relative_to(template).as_posix().removesuffix(".in")
        for scene in PREPARED if "@scene@" in name.lower() else ("",):
            target = to / of_scene(name, scene)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(of_scene(path.read_text(), scene)
                              .replace("@VERSION@", version()))


# What the native example of PlatformIO is, too.
DEMO = HERE / "cmake/examples/demo/demo.c"


def of_scene(text, scene):
    """A text with the name of a scene in place."""
    for case in str.lower, str.capitalize, str.upper:
        text = text.replace(f"@{case('scene')}@", case(scene))
    return text


def keywords(package):
    """What Arduino's editor colours: types, and functions."""
    names = {name for header in package.glob("src/*.h")
             for name in re.findall(r"\btf_\w+", header.read_text())}
    (package / "keywords.txt").write_text("".join(
        f"{name}\tKEYWORD{1 if name.endswith('_t') else 2}\n"
        for name in sorted(names)))


def archive(package, to):
    """A tar with the same bytes for the same files."""
    subprocess.run(
        ["tar", "-I", "gzip -n9", "--sort=name", "--owner=0", "--group=0",
         "--numeric-owner", "--mtime=@0", "--mode=u=rw,go=r,a+X", "-C",
         package.parent, "-cf", to.absolute(), package.name], check=True)


def main():
    made, folder, help_ = map(Path, sys.argv[1:])
    for template, (name, inner, files, begin) in PACKAGES.items():
        package = folder / name
        shutil.rmtree(package.parent, ignore_errors=True)
        fill(HERE / template, package)
        (package / inner).mkdir(parents=True, exist_ok=True)
        for file in files:
            text = (made / file).read_text()
            if file.endswith(".h"):
                text = begin + text
            (package / inner / file).write_text(text)
        if template == "arduino":
            keywords(package)
        if template == "platformio":
            (package / "examples/chaos/src").mkdir()
            shutil.copy(DEMO, package / "examples/chaos/src/main.c")
        shutil.copy(ROOT / "LICENSE", package / "LICENSE")
        if template == "python":
            for part in "include", "src", "tools/cli":
                shutil.copytree(ROOT / part, package / part)
            for file in ROOT.glob("tools/*.[ch]"):
                shutil.copy(file, package / "tools")
            shutil.copy(help_, package)
            shutil.copy(ROOT / "tools/board/protocol/decode.py",
                        package / "twofold")
        if template in ("cmake", "python"):
            archive(package, folder / template
                    / f"twofold-{version()}.tar.gz")


main()
