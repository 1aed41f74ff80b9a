#!/usr/bin/python3 -B
"""Makes the FMUs of a scene, in two steps: `layout` writes their sources and
descriptions, after which the binaries are compiled, and `pack` puts all into
archives with fixed times, so that equal contents are equal bytes.

usage: package.py layout DESCRIPTION.json DIRECTORY
       package.py pack DIRECTORY FMI2.fmu FMI3.fmu

DIRECTORY/fmi2 and DIRECTORY/fmi3 are the contents of the two; the scene is in
DIRECTORY/scene.h, as a constant."""
import hashlib
import json
import re
import shutil
import sys
import uuid
import zipfile
from pathlib import Path

import description
from icon import icon

ROOT = Path(__file__).resolve().parents[3]
HERE = Path(__file__).resolve().parent
FACES = {"fmi2": ["fmi2.c", "fmi2.h"],
         "fmi3": ["fmi3.c", "fmi3_absent.c", "fmi3.h"]}
NOT_IN_FMU = {"describe.c", "fmu_scene.h"}
INCLUDE = re.compile(r'^(#include ")([^"]+)(")', re.M)
WRITTEN = 0o100644 << 16  # a plain file that all may read


def flat_name(path):
    """The one name of a file of the tree: src/moreau/step.c becomes
    moreau_step.c, so that importers that know no folders can compile it."""
    parts = path.relative_to(ROOT).parts
    parts = parts[2:] if parts[0] == "tools" else parts[1:]
    prefix = "fmu_" if path.parent == HERE else ""
    return prefix + "_".join(parts).replace("fmu_", "")


def flat_text(path):
    """The text of a file, which includes flat names."""
    def flat(match):
        name = match[2]
        for folder in (path.parent, ROOT / "include"):
            target = (folder / name).resolve()
            if target.is_file():
                return match[1] + flat_name(target) + match[3]
        raise SystemExit(f"package.py: {path}: {name} is not there")
    return INCLUDE.sub(flat, path.read_text())


def sources_of(face):
    """The files from which one FMU is compiled: flat name to text."""
    others = {n for f, names in FACES.items() if f != face for n in names}
    mine = [p for p in sorted(HERE.glob("*.[ch]"))
            if p.name not in others | NOT_IN_FMU]
    core = sorted([*ROOT.glob("src/*/*.[ch]"), *ROOT.glob("include/*.h"),
                   *ROOT.glob("include/twofold/*.h")])
    texts = {}
    for path in [*mine, *core]:
        name = flat_name(path)
        if name in texts:
            raise SystemExit(f"package.py: two files are called {name}")
        texts[name] = flat_text(path)
    return texts


def token_of(model, texts):
    """Names interface and sources: it changes when either does."""
    digest = hashlib.sha256(json.dumps([model, texts], sort_keys=True).encode())
    return "{" + str(uuid.UUID(digest.hexdigest()[:32])) + "}"


def page(model, version):
    rows = "\n".join(
        f"<tr><td>{v['name']}</td><td>{v['role']}</td><td>{v['unit']}</td>"
        f"<td>{v['about'].replace('>', '&gt;')}</td></tr>"
        for v in model["variables"])
    guide = (ROOT / "docs" / "FMU.md").read_text()
    guide = guide.replace("&", "&amp;").replace("<", "&lt;")
    return (f"<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n"
            f"<title>twofold {model['scene']}, FMI {version}</title>\n"
            f"<h1>twofold {model['scene']}, FMI {version}</h1>\n"
            f"<table>\n{rows}\n</table>\n<pre>\n{guide}</pre>\n</html>\n")


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def lay_out(model, directory):
    texts = {face: sources_of(face) for face in FACES}
    constant = (directory / "scene.h").read_text()
    token = token_of([model, constant], texts)
    scene = (f"// The scene and the token of this FMU, {model['scene']}.\n"
             f"#include \"twofold_scene.h\"\n\n{constant}\n"
             "#define FMU_SCENE (&scene_constants)\n"
             f"#define FMU_TOKEN \"{token}\"\n")
    picture = icon()
    for face, files in texts.items():
        home = directory / face
        shutil.rmtree(home, ignore_errors=True)
        for name, text in files.items():
            write(home / "sources" / name, text)
        write(home / "sources" / "fmu_scene.h", scene)
        units = [name for name in sorted(files) if name.endswith(".c")]
        if face == "fmi2":
            xml = description.fmi2(model, token, units)
            (home / "model.png").write_bytes(picture)
        else:
            write(home / "terminalsAndIcons" / "terminalsAndIcons.xml",
                  description.icon_description())
            (home / "terminalsAndIcons" / "icon.png").write_bytes(picture)
            xml = description.fmi3(model, token)
            write(home / "sources" / "buildDescription.xml",
                  description.build_description(units))
        write(home / "modelDescription.xml", xml)
        write(home / "documentation" / "index.html", page(model, face[-1]))
        write(home / "documentation" / "licenses" / "license.txt",
              (ROOT / "LICENSE").read_text())


def pack(home, archive):
    archive.parent.mkdir(parents=True, exist_ok=True)
    files = sorted(p for p in home.rglob("*") if p.is_file())
    files.sort(key=lambda p: p.name != "modelDescription.xml")
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as out:
        for path in files:
            entry = zipfile.ZipInfo(path.relative_to(home).as_posix(),
                                    (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3
            entry.external_attr = WRITTEN
            out.writestr(entry, path.read_bytes())


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "layout":
        lay_out(json.loads(Path(sys.argv[2]).read_text()), Path(sys.argv[3]))
    elif len(sys.argv) == 5 and sys.argv[1] == "pack":
        pack(Path(sys.argv[2]) / "fmi2", Path(sys.argv[3]))
        pack(Path(sys.argv[2]) / "fmi3", Path(sys.argv[4]))
    else:
        raise SystemExit(__doc__)


main()
