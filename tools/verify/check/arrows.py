#!/usr/bin/python3
"""Rooms of src/ and the one way between them. Each room stands on one room
earlier in the table of DESIGN.md, section 2, and through it on all that this
one stands on. A file may include what is in its own room and in those that it
stands on, so never what is in a room later in that table:

    num < friction < model < moreau < event
                     model < analysis
                             moreau < ensemble
                             moreau < scene < link

A public header belongs to the room that has the source of its name. Beside
these the core includes five headers that a compiler without a library has, and
branches of its preprocessor ask about the real type. Nothing includes or
imports itself through others, in the core, the tools and the ports; a header
and the source beside it count as one there. No two sources have one name, for
an archive would have two members of it; that no name of a file is defined in
another one is seen where boards compile all of src/ as one file.

The rooms of tools/ stand in a row: each includes and imports what is in those
before it, what lies in tools/ itself, and, from `study` on, the reference of
the tests and their random machines. The folders of the command line are in the
order that tools/cli/command.c describes. In port/ each file includes only what
its line in a table allows, so that the loop knows neither the simulation nor
the core: it drives whatever app.h declares.
"""
import ast
import graphlib
import posixpath
import re
from pathlib import Path

from findings import checked, wrong

# In the order of that table: the room that each one stands on.
STANDS_ON = {"num": None, "friction": "num", "model": "friction",
             "moreau": "model", "event": "moreau", "analysis": "model",
             "scene": "moreau", "link": "scene", "ensemble": "moreau"}
# Public headers without a source of their name, and the lowest room that has a
# use for them.
HEADER_ONLY = {"real": "num"}
# Each folder of tools/cli/, and the other folders, or single files, that it may
# include. Files in tools/cli/ itself may include all of them. The commands do
# not include each other, except that `monitor` writes the rows of `run` and
# `sweep` counts its events and ambiguous instants.
ROOMS = ("cli", "board", "package", "page", "study", "bench", "verify")
REFERENCE, JUDGES = "tests/reference/", ("study", "bench", "verify")
MACHINES = "tests/golden/population.h"
CLI = "tools/cli/"
CLI_INCLUDES = {
    "monitor": ("run/row.h", "run/session.h", "live", "setup", "host", "text"),
    "run": ("live", "setup", "host", "text"),
    "analysis": ("setup", "host", "text"),
    "diverge": ("setup", "host", "text"),
    "sweep": ("run/events.h", "setup", "host", "text"),
    "setup": ("host", "text"),
    "live": ("host", "text"),
    "host": ("text",),
    "text": (),
}
# Each file of port/, without its ending, and the other ones that it may
# include. Only port/core.h includes src/ and include/.
PORT_INCLUDES = {
    "port": (), "ring": (), "text": (), "app": (), "choice": (), "core": (),
    "loop": ("app", "port"),
    "main": ("app", "loop", "port"),
    "sim": ("app", "core", "port"),
    "telemetry_csv": ("sim", "text"),
    "telemetry_frames": ("port", "sim"),
    "telemetry_plotter": ("sim", "text"),
    "firmware": ("app", "sim", "telemetry_csv", "telemetry_frames",
                 "telemetry_plotter"),
}
# What the folder of a board may include of other folders; the module for
# WebAssembly is the core itself and has no loop.
BOARD_INCLUDES = ("arch", "port", "ring")
CHIP_INCLUDES = ("port", "ring")  # what boards share that have one chip
MODULE = "port/wasm32/module/module"
# Has all public headers, so that nothing of the core may include it.
UMBRELLA = "include/twofold.h"

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
# Lines that the core may not have: of headers, and of the preprocessor.
OTHER_HEADER = re.compile(
    r"^\s*#\s*include(?! (?:<(?:stdint|stdbool|stddef|float|limits)\.h>"
    r'|"[^"]*")(?: +//.*)?$).*', re.M)
BRANCH = re.compile(
    r"^\s*#\s*(?:if|elif|ifdef|ifndef)\b"
    r"(?!.*(?:TF_\w+_H|TWOFOLD_\w*H|__cplusplus|TF_STEP_\w+)$"
    r"|.*(?:TF_REAL_FLOAT|TF_API)).*", re.M)
# They ask the compiler for its arithmetic.
ASKING = ("include/twofold/real.h", "src/num/rounding.h")


def files_of():
    patterns = ("src/*/*.[ch]", "include/**/*.h", "tools/**/*.[ch]",
                "port/**/*.[ch]", "tests/reference/**/*.[ch]")
    return sorted(str(path) for pattern in patterns
                  for path in Path().glob(pattern))


def is_core(file):
    return file.startswith(("src/", "include/"))


def own_sources(files):
    """The source of each name in src/, by that name, and what is twice."""
    sources, found = {}, []
    for file in files:
        if re.fullmatch(r"src/\w+/\w+\.c", file):
            name = Path(file).stem
            if name in sources:
                found.append(f"{file}: {sources[name]} has the same name")
            sources[name] = file
    return sources, found


def place(file, sources):
    """(room, unit) of a file; a header and its source make one unit."""
    path = Path(file)
    unit = path.with_suffix("").as_posix()
    if file.startswith("src/"):
        return path.parts[1], unit
    if file.startswith("include/twofold/"):
        source = sources.get(path.stem)
        room = Path(source).parts[1] if source else HEADER_ONLY.get(path.stem)
        return room, unit
    return None, unit


def stood_on(room):
    """A room and all that it stands on."""
    while room:
        yield room
        room = STANDS_ON[room]


def included(file, files):
    """(name, file of the project or None) of every include of a file."""
    roots = ["include"] if is_core(file) else ["include", "tools", "port",
                                               "tests", "tests/reference"]
    for name in INCLUDE.findall(Path(file).read_text()):
        places = [posixpath.normpath(f"{folder}/{name}") for folder in (
            Path(file).parent.as_posix(), *roots)]
        yield name, next((one for one in places if one in files), None)


def cli_allows(file, target):
    """Whether a file of the command line may include another one of it."""
    room, below, _ = file[len(CLI):].partition("/")
    return not below or room in CLI_INCLUDES and any(
        f"{target}/".startswith(f"{CLI}{one}/")
        for one in (room, *CLI_INCLUDES[room]))


def port_allows(file, target):
    """Whether a file of port/ may include another one, of port/ or the core."""
    unit = Path(file).with_suffix("").as_posix()
    other = Path(target).with_suffix("").as_posix()
    if other == unit:
        return True
    if is_core(target):
        return unit == "port/core"
    if not target.startswith("port/"):
        return False
    parts, other_parts = unit.split("/")[1:], other.split("/")[1:]
    if len(parts) == 1:
        return other_parts[0] in PORT_INCLUDES.get(parts[0], ())
    if unit == MODULE:
        return other == "port/core"
    allowed = CHIP_INCLUDES if parts[0] == "arch" else BOARD_INCLUDES
    return parts[0] == other_parts[0] or other_parts[0] in allowed


def room_of(file):
    """Of a file of tools/; None where it lies in tools/ itself or elsewhere."""
    parts = file.split("/")
    return parts[1] if parts[0] == "tools" and len(parts) > 2 else None


def tools_allow(file, target):
    """Whether a file of tools/ may use another file."""
    room, other = room_of(file), room_of(target)
    if target.startswith("tests/"):
        return room in JUDGES and target.startswith((REFERENCE, MACHINES))
    if room is None or other is None:
        return other is None
    return room in ROOMS and other in ROOMS and \
        ROOMS.index(other) <= ROOMS.index(room)


def allows(file, target):
    """Of an include outside of the core."""
    if file.startswith(CLI) and target.startswith(CLI):
        return cli_allows(file, target)
    if file.startswith("tools/") and not is_core(target):
        return tools_allow(file, target)
    return not file.startswith("port/") or port_allows(file, target)


def imports():
    """(file, file that it imports) of what is Python in tools/ and in the
    reference: by a module's last name, of its own folder or else of any."""
    files = [str(path) for path in sorted([*Path().glob("tools/**/*"),
                                           *Path(REFERENCE).glob("**/*.py")])
             if path.is_file() and (path.suffix == ".py" or not path.suffix and
                                    path.read_bytes()[:99].split(b"\n")[0]
                                    .find(b"python3") > 0)]
    for file in files:
        folder = file.rsplit("/", 1)[0]
        for node in ast.walk(ast.parse(Path(file).read_text("utf-8"))):
            names = [alias.name for alias in node.names] if isinstance(
                node, (ast.Import, ast.ImportFrom)) else []
            if isinstance(node, ast.ImportFrom) and node.module:
                names = [node.module] + [f"{node.module}.{n}" for n in names]
            for name in names:
                stem = name.replace(".", "/") + ".py"
                found = [one for one in files if one.endswith("/" + stem)]
                own = [one for one in found if one.startswith(folder + "/")]
                yield from ((file, one) for one in own or found)


def judge_header(file, room, sources):
    """What is wrong with a public header as such."""
    own = Path(file).stem in sources
    if own and Path(file).stem in HEADER_ONLY:
        yield f"{file}: has a source, so it is in no table"
    if room is None:
        yield f"{file}: neither a source nor a room"


def judge_core(file, room, target, sources):
    """What is wrong with an include of the core."""
    if target is None:
        yield f"{file}: includes what is not there"
    elif target == UMBRELLA:
        yield f"{file}: includes all public headers"
    elif file != UMBRELLA and place(target, sources)[0] not in stood_on(room):
        yield f"{file} ({room}) includes {target}, on which it does not stand"


def judge(files):
    """All that is wrong, and how many includes and imports were read."""
    sources, found = own_sources(files)
    edges, count = {}, 0
    for file in files:
        room, unit = place(file, sources)
        if file.startswith("src/") and room not in STANDS_ON:
            found.append(f"{file}: {room} is no room that arrows.py knows")
            continue
        if file.startswith("include/twofold/"):
            found += judge_header(file, room, sources)
        if is_core(file):
            text = Path(file).read_text()
            found += [f"{file}: {line.strip()}" for line in [
                *OTHER_HEADER.findall(text),
                *(BRANCH.findall(text) if file not in ASKING else [])]]
        for _, target in included(file, files):
            count += 1
            if is_core(file):
                found += judge_core(file, room, target, sources)
            elif target and not allows(file, target):
                found.append(f"{file} may not include {target}")
            if target and place(target, sources)[1] != unit:
                edges.setdefault(unit, set()).add(place(target, sources)[1])
    for file, target in imports():
        count += 1
        if not tools_allow(file, target):
            found.append(f"{file} may not import {target}")
        if file != target:
            edges.setdefault(file, set()).add(target)
    try:
        graphlib.TopologicalSorter(edges).prepare()
    except graphlib.CycleError as circle:
        found.append("a circle: " + " < ".join(circle.args[1]))
    return found, count


there = files_of()
findings, arrows = judge(there)
for finding in findings:
    wrong(finding)
checked(f"{arrows} includes and imports of {len(there)} files in C and those "
        "in Python go one way")
