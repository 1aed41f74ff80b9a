#!/usr/bin/python3
"""Rooms of src/ and the one way between them. Each room stands on one room
earlier in the table of DESIGN.md, section 2, and through it on all that this
one stands on. A file may include what is in its own room and in those that it
stands on, so never what is in a room later in that table:

    num < model < friction < moreau < event
                  friction < analysis
                             moreau < scene < link

A public header belongs to the room that has the source of its name. Nothing
includes itself through others, in the core, the tools and the ports; a header
and the source beside it count as one there. The rooms of tools/ stand in a row,
and what they include and import goes one way (tool_rooms.py). All of src/ can
be compiled as one file: no name of a file is defined in another one, which
universal ctags tells, and no two sources have one name, for an archive would
have two members of it.

The folders of the command line are in the order that tools/cli/commands.c
describes. In port/ each file includes only what its line in a table allows, so
that the loop knows neither the simulation nor the core: it drives whatever
app.h declares.

What a program or a test begins with by the sign of h is coded once, in the
source of tf_begin_with_slip.

Before the project is judged, a tree with one violation of each kind is.
"""
import json
import posixpath
import re
import subprocess
import tempfile
from pathlib import Path

import tool_rooms
from findings import checked, need, wrong

# In the order of that table: the room that each one stands on.
STANDS_ON = {"num": None, "model": "num", "friction": "model",
             "moreau": "friction", "event": "moreau", "analysis": "friction",
             "scene": "moreau", "link": "scene"}
# Public headers without a source, and the lowest room that has a use for them.
HEADER_ONLY = {"real": "num", "wire": "link"}
# Each folder of tools/cli/, and the other folders, or single files, that it may
# include. Files in tools/cli/ itself may include all of them. The commands do
# not include each other, except that `monitor` writes the rows of `run` and
# `sweep` counts its events and ambiguous instants.
CLI = "tools/cli/"
CLI_INCLUDES = {
    "monitor": ("run/row.h", "live", "setup", "host", "text"),
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
    "sim": ("app", "core"),
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
PUBLIC_FUNCTION = re.compile(r"^TF_API\b[^;{]*\(", re.M)
LINK_NAME = re.compile(r"#define (\w+) TF_LINK\(\1\)")
START = "src/moreau/begin.c"
SIGN_OF_H = re.compile(r"\bTF_SLIP_PLUS\s*:\s*TF_NO_MODE\b|\bh\s*>\s*0\s*\)"
                       r"\s*\{?\s*\S*mode\s*=\s*(?:\(\w+\))?TF_SLIP_PLUS")


def files_of(root):
    patterns = ("src/*/*.[ch]", "include/**/*.h", "tools/**/*.[ch]",
                "port/**/*.[ch]", "tests/reference/**/*.[ch]")
    return sorted(p.relative_to(root).as_posix()
                  for pattern in patterns for p in root.glob(pattern))


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


def included(root, file, files):
    """(name, file of the project or None) of every include of a file."""
    roots = ["include"] if is_core(file) else ["include", "tools", "port",
                                               "tests", "tests/reference"]
    for name in INCLUDE.findall((root / file).read_text()):
        for folder in [Path(file).parent.as_posix()] + roots:
            target = posixpath.normpath(f"{folder}/{name}")
            if target in files:
                yield name, target
                break
        else:
            yield name, None


def cli_allows(file, target):
    """Whether a file of the command line may include another one of it."""
    parts, other = file[len(CLI):].split("/"), target[len(CLI):].split("/")
    if len(parts) == 1:
        return True
    return parts[0] in CLI_INCLUDES and (
        other[0] == parts[0] or
        len(other) > 1 and other[0] in CLI_INCLUDES[parts[0]] or
        "/".join(other) in CLI_INCLUDES[parts[0]])


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


def layer_finding(file, target):
    """What is wrong with an include outside of the core, or None."""
    if file.startswith(CLI) and target.startswith(CLI):
        allowed = cli_allows(file, target)
    elif file.startswith("tools/") and not is_core(target):
        allowed = tool_rooms.allows(file, target)
    elif file.startswith("port/"):
        allowed = port_allows(file, target)
    else:
        allowed = True
    return None if allowed else f"{file} may not include {target}"


def circles(edges):
    """One circle for each edge that closes one, as a list of units."""
    found, state = [], {}

    def visit(unit, path):
        state[unit] = "open"
        for other in sorted(edges.get(unit, ())):
            if state.get(other) == "open":
                found.append(path[path.index(other):] + [other])
            elif other not in state:
                visit(other, path + [other])
        state[unit] = "done"

    for unit in sorted(edges):
        if unit not in state:
            visit(unit, [unit])
    return found


def names_twice(root, files):
    """Names that two files of the core define: functions, types, variables,
    members of enumerations, macros. A macro that gives a function its linked
    name goes with the function."""
    core = [f for f in files if is_core(f)]
    tags = subprocess.run(
        ["ctags", "--sort=no", "--output-format=json", "--kinds-C=dfgstuev",
         "--language-force=C", "-D", "TF_API_DATA=extern", "-f", "-"] + core,
        cwd=root, check=True, stdout=subprocess.PIPE, text=True).stdout
    home, found, text = {}, [], {}
    for tag in map(json.loads, tags.splitlines()):
        name, file = tag["name"], tag["path"]
        if tag["kind"] == "macro":
            if file not in text:
                text[file] = set(LINK_NAME.findall((root / file).read_text()))
            if name in text[file]:
                continue
        if home.setdefault(name, file) != file:
            found.append(f"{file}: {name} is defined in {home[name]} as well")
    return len(home), sorted(set(found))


def starts_twice(root, files):
    """Files that decide by the sign of h in which slip a motion starts, as
    tf_begin_with_slip does."""
    return [f"{file}: the sign of h names the first mode in {START} alone"
            for file in [*files, *(p.relative_to(root).as_posix() for p in
                                   sorted(root.glob("tests/**/*.[ch]")))]
            if file != START and SIGN_OF_H.search((root / file).read_text())]


def judge(root):
    """All that is wrong in the tree at root, and a sum of what was read."""
    files = files_of(root)
    there = set(files)
    sources, found = own_sources(files)
    edges, count = {}, 0
    for file in files:
        room, unit = place(file, sources)
        if file.startswith("src/") and room not in STANDS_ON:
            found.append(f"{file}: {room} is no room that arrows.py knows")
            continue
        if file.startswith("include/twofold/"):
            own = Path(file).stem in sources
            if own and Path(file).stem in HEADER_ONLY:
                found.append(f"{file}: has a source, so it is in no table")
            if room is None:
                found.append(f"{file}: neither a source nor a room")
                continue
            if not own and PUBLIC_FUNCTION.search((root / file).read_text()):
                found.append(f"{file}: public functions, no source of its name")
        for name, target in included(root, file, there):
            count += 1
            if target is None:
                if is_core(file):
                    found.append(f"{file}: {name} is not there")
                continue
            other_room, other = place(target, sources)
            if is_core(file) and file != UMBRELLA:
                if target == UMBRELLA:
                    found.append(f"{file}: includes all public headers")
                elif other_room not in stood_on(room):
                    found.append(f"{file} ({room}) includes {target} "
                                 f"({other_room}), on which it does not stand")
            elif not is_core(file) and layer_finding(file, target):
                found.append(layer_finding(file, target))
            if other != unit:
                edges.setdefault(unit, set()).add(other)
    modules = {}
    for file, target in tool_rooms.imports(root):
        count += 1
        if not tool_rooms.allows(file, target):
            found.append(f"{file} may not import {target}")
        if file != target:
            modules.setdefault(file, set()).add(target)
    named = {}
    for file, target in tool_rooms.uses(root):
        named.setdefault(file, set()).add(target)
    found += ["a circle: " + " > ".join(c)
              for graph in (edges, modules, named) for c in circles(graph)]
    names, twice = names_twice(root, files)
    found += twice + starts_twice(root, files)
    return found, (f"{count} includes and imports of {len(files)} files in C "
                   f"and those in Python go one way, {names} names of the core "
                   "are of one file")


# A tree with one violation of each kind, and what is to be said of it.
SEEDS = {
    "src/num/low.c": '#include "low.h"\nstatic int twice(void) { return 1; }\n',
    "src/num/low.h": '#include "../model/high.h"\n',
    "src/model/high.h": '#include "../num/other.h"\n#define LIMIT 2\n',
    "src/num/other.h": '#include "low.h"\n',
    "src/model/user.c": '#include "twofold/lone.h"\n#define LIMIT 1\n'
                        "TF_INLINE int twice(int a) { return a; }\n",
    "src/event/low.c": '#include "../analysis/aside.h"\n'
                       "typedef struct { int a; } thing_t;\n",
    "src/analysis/aside.h": "typedef struct { int b; } thing_t;\n",
    "src/attic/old.c": "",
    "include/twofold/lone.h": "TF_API int lone(int of,\n  int two);\n",
    "include/twofold/real.h": "TF_API int real(void);\n",
    "tools/cli/one.c": '#include "one.h"\n#include "two.h"\n',
    "tools/cli/one.h": "",
    "tools/cli/two.h": "",
    "tools/cli/two.c": '#include "two.h"\n#include "one.h"\n',
    "tools/cli/text/words.h": '#include "../setup/names.h"\n',
    "tools/cli/setup/names.h": "",
    "tools/cli/run/loop.h": '#include "../diverge/draws.h"\n',
    "tools/cli/diverge/draws.h": "",
    "tools/cli/monitor/view.h": '#include "../run/row.h"\n'
                                '#include "../run/loop.h"\n',
    "tools/cli/run/row.h": '#include "../one.h"\n',
    "tools/verify/a/one.h": '#include "two.h"\n',
    "tools/verify/a/two.h": '#include "verify/a/one.h"\n',
    "tools/cli/host/line.h": '#include "verify/a/one.h"\n',
    "tools/page/model.c": '#include "reference/judge.h"\n'
                          "int own(void) { return 1; }\n"
                          "int run(void) { return start(); }\n",
    "tools/page/start.c": "int start(void) { return own(); }\n",
    "tools/bench/fast.c": '#include "reference/judge.h"\n',
    "tests/reference/judge.h": "",
    "tools/bench/rows.py": "import later\n",
    "tools/study/later.py": "import rows\n",
    "tools/verify/a/start.c": "if (h > 0) x.mode = TF_SLIP_PLUS;\n",
    "tests/law/side.c": "x.mode = h > 0 ? TF_SLIP_PLUS : TF_NO_MODE;\n",
    "port/core.h": "",
    "port/loop.h": '#include "core.h"\n',
    "port/board/board.c": '#include "../loop.h"\n',
}
SEEDED = [
    "src/attic/old.c: attic is no room",
    "src/num/low.c: src/event/low.c has the same name",
    "src/event/low.c (event) includes src/analysis/aside.h (analysis)",
    "src/num/low.h (num) includes src/model/high.h (model)",
    "include/twofold/lone.h: neither a source nor a room",
    "include/twofold/real.h: public functions, no source of its name",
    "a circle: src/model/high > src/num/other > src/num/low > src/model/high",
    "a circle: tools/cli/one > tools/cli/two > tools/cli/one",
    "tools/cli/text/words.h may not include tools/cli/setup/names.h",
    "tools/cli/run/loop.h may not include tools/cli/diverge/draws.h",
    "tools/cli/monitor/view.h may not include tools/cli/run/loop.h",
    "tools/cli/run/row.h may not include tools/cli/one.h",
    "a circle: tools/verify/a/one > tools/verify/a/two > tools/verify/a/one",
    "a circle: tools/page/model.c > tools/page/start.c > tools/page/model.c",
    "a circle: tools/bench/rows.py > tools/study/later.py > tools/bench/rows",
    "tools/bench/rows.py may not import tools/study/later.py",
    "tools/page/model.c may not include tests/reference/judge.h",
    "tools/cli/host/line.h may not include tools/verify/a/one.h",
    "tools/verify/a/start.c: the sign of h names the first mode",
    "tests/law/side.c: the sign of h names the first mode",
    "port/loop.h may not include port/core.h",
    "port/board/board.c may not include port/loop.h",
    "src/model/user.c: LIMIT is defined in src/model/high.h as well",
    "src/event/low.c: thing_t is defined in src/analysis/aside.h as well",
    "src/num/low.c: twice is defined in src/model/user.c as well",
]


def judge_seeds():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for file, text in SEEDS.items():
            (root / file).parent.mkdir(parents=True, exist_ok=True)
            (root / file).write_text(text)
        said, _ = judge(root)
    if any("fast.c" in line or "study/later.py may" in line for line in said):
        wrong("what is allowed is found")
    for want in SEEDED:
        if not any(want in line for line in said):
            wrong(f"a seeded violation is not found: {want}")
    return said


need("ctags", "universal-ctags")
seeded = judge_seeds()
findings, summary = judge(Path("."))
for finding in findings:
    wrong(finding)
checked(f"{summary}; {len(SEEDED)} seeded violations are found")
