#!/usr/bin/python3 -B
"""Makes the FMUs of a scene, in two steps: `layout` writes their sources and
descriptions, after which the binaries are compiled, and `pack` puts all into
archives with fixed times, so that equal contents are equal bytes.

usage: package.py layout DESCRIPTION.json CORE DIRECTORY
       package.py pack DIRECTORY FMI2.fmu FMI3.fmu

DIRECTORY/fmi2 and DIRECTORY/fmi3 are the contents of the two; the scene is in
DIRECTORY/scene.h, as a constant; CORE has twofold.c and twofold.h."""
import hashlib
import json
import re
import shutil
import sys
import uuid
import zipfile
from pathlib import Path

import description

ROOT = Path(__file__).resolve().parents[3]
HERE = Path(__file__).resolve().parent
FACES = "fmi2", "fmi3"
NOT_IN_FMU = {"describe.c", "fmu_scene.h"}
WRITTEN = 0o100644 << 16  # a plain file that all may read


def sources_of(face, core):
    """The files from which one FMU is compiled, name to text: those here and
    the core in two files, because importers know no folders."""
    others = {f"{other}.c" for other in FACES if other != face}
    paths = [*sorted(HERE.glob("*.[ch]")), ROOT / "tools/motion.h",
             core / "twofold.c", core / "twofold.h"]
    return {path.name: path.read_text() for path in paths
            if path.name not in others | NOT_IN_FMU}


def token_of(model, texts):
    """Names interface and sources: it changes when either does."""
    digest = hashlib.sha256(json.dumps([model, texts], sort_keys=True).encode())
    return "{" + str(uuid.UUID(digest.hexdigest()[:32])) + "}"


def page(model, version):
    rows = "\n".join(
        f"<tr><td>{v['name']}</td><td>{v['role']}</td><td>{v['unit']}</td>"
        f"<td>{v['about'].replace('>', '&gt;')}</td></tr>"
        for v in model["variables"])
    use = (ROOT / "docs" / "USE.md").read_text()
    guide = re.search(r"^## FMI.*?(?=^## )", use, re.M | re.S)[0]
    guide = guide.replace("&", "&amp;").replace("<", "&lt;")
    return (f"<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n"
            f"<title>twofold {model['scene']}, FMI {version}</title>\n"
            f"<h1>twofold {model['scene']}, FMI {version}</h1>\n"
            f"<table>\n{rows}\n</table>\n<pre>\n{guide}</pre>\n</html>\n")


def reference(model, csv):
    """Results of the command line, with the names and numbers of the FMU."""
    modes = next(v["members"] for v in model["variables"]
                 if v["name"] == "mode")
    for i, mode in enumerate(modes):
        csv = csv.replace(f",{mode},", f",{i},")
    return csv.replace("t,", "time,", 1)


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def lay_out(model, core, directory):
    texts = {face: sources_of(face, core) for face in FACES}
    constant = (directory / "scene.h").read_text()
    token = token_of([model, constant], texts)
    scene = (f"// The scene and the token of this FMU, {model['scene']}.\n"
             f"#include \"twofold.h\"\n\n{constant}\n"
             "#define FMU_SCENE (&scene_constants)\n"
             f"#define FMU_TOKEN \"{token}\"\n")
    picture = (HERE / "icon.png").read_bytes()
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
        write(home / "documentation" / "twofold_ref.csv",
              reference(model, (directory / "reference.csv").read_text()))


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
    if len(sys.argv) == 5 and sys.argv[1] == "layout":
        _, _, model, core, directory = sys.argv
        lay_out(json.loads(Path(model).read_text()), Path(core),
                Path(directory))
    elif len(sys.argv) == 5 and sys.argv[1] == "pack":
        pack(Path(sys.argv[2]) / "fmi2", Path(sys.argv[3]))
        pack(Path(sys.argv[2]) / "fmi3", Path(sys.argv[4]))
    else:
        raise SystemExit(__doc__)


main()
