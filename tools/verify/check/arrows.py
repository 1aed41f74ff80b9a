#!/usr/bin/python3 -B
"""Files include and import one way. STANDS_ON names the places of the tree: a
folder with all in it, or a header and its source. A file may include what is in
its own folder, in a place that its place stands on, and in all that this one
stands on. The rooms of src/ are those of DESIGN.md, section 2, the folders of
the command line those of tools/cli/command.c. In port/ the loop stands neither
on the simulation nor on the core: it drives whatever app.h declares.

A public header belongs to the room that has the source of its name. Beside
these the core includes five headers that a compiler without a library has, and
branches of its preprocessor ask about the real type. Nothing includes or
imports itself through others. No two sources have one name, for an archive
would have two members of it.
"""
import ast
import graphlib
import posixpath
import re
from pathlib import Path

from findings import checked, files_in, wrong

STANDS_ON = {place: below.split() for place, below in re.findall(
    r"^(\S+)((?: +\S+)*)$", """
include/twofold/real
src/num/             include/twofold/real
src/friction/        src/num/
src/model/           src/friction/
src/moreau/          src/model/
src/event/           src/moreau/
src/analysis/        src/model/
src/scene/           src/moreau/
src/link/            src/scene/
src/ensemble/        src/moreau/
include/twofold      src/ include/twofold/real
tools/               include/ src/
tools/cli/text/      tools/motion tools/decimal tools/columns src/ include/
tools/cli/host/      tools/cli/text/
tools/cli/live/      tools/cli/host/ tools/cli/run/row
tools/cli/setup/     tools/cli/host/
tools/cli/analysis/  tools/cli/setup/
tools/cli/diverge/   tools/cli/setup/
tools/cli/run/       tools/cli/setup/ tools/cli/live/
tools/cli/sweep/     tools/cli/setup/ tools/cli/run/events
tools/cli/monitor/   tools/cli/setup/ tools/cli/live/ tools/cli/run/row
                     tools/cli/run/session
tools/cli/run/row    tools/cli/setup/
tools/cli/run/events tools/cli/setup/
tools/cli/           tools/cli/text/
tools/board/         tools/cli/ tools/driven
tools/package/       tools/board/
tools/page/          tools/package/
tools/study/         tools/page/ tests/reference/ tests/golden/population
tools/bench/         tools/study/
tools/verify/        tools/bench/ port/core port/port tests/support/same_state
tests/reference/     src/ include/
tests/reference/judge/library tests/reference/ tools/motion tools/columns
port/app
port/choice
port/hooks           port/port
port/port
port/ring            port/port
port/text
port/core            src/ include/
port/loop            port/app port/port
port/main            port/loop
port/sim             port/app port/port port/core
port/telemetry_csv   port/sim port/text tools/columns
port/telemetry_frames port/sim
port/telemetry_plotter port/sim port/text
port/firmware        port/telemetry_csv port/telemetry_frames
                     port/telemetry_plotter
port/arch/           port/port port/ring
port/wasm32/module/  port/core
""".replace("\n   ", "   "), re.M)}
STANDS_ON.update({f"{board}/": ["port/arch/"] for board in Path().glob("port/*")
                  if board.is_dir() and f"{board}/" not in STANDS_ON})
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

FILES = sorted({str(path) for room in ("src", "include", "tools", "port",
                                       "tests/reference")
                for pattern in ("*.[ch]", "*.py")
                for path in files_in(room, pattern=pattern)})
SOURCES = {Path(file).stem: file for file in FILES
           if re.fullmatch(r"src/\w+/\w+\.c", file)}


def unit_of(file):
    """A header and its source are one."""
    return posixpath.splitext(file)[0]


def home_of(file):
    """The unit, of a public header as if it lay beside its source."""
    source = SOURCES.get(Path(file).stem)
    return unit_of(source if source and file.startswith("include/twofold/")
                   else file)


def place_of(unit):
    """The smallest one that has it."""
    return max((place for place in STANDS_ON if is_in(unit, place)),
               key=len, default=None)


def is_in(unit, place):
    return unit.startswith(place) if place[-1] == "/" else unit == place


def below(place):
    """All that a place stands on."""
    for one in STANDS_ON.get(place, ()):
        yield one
        yield from below(one)


def judge(file, target):
    """An include or import."""
    unit, other = home_of(file), home_of(target)
    if posixpath.dirname(unit) == posixpath.dirname(other) != "port" or \
            unit == other:
        return
    place = place_of(unit)
    if target == UMBRELLA and file.startswith(("src/", "include/")) or \
            not any(is_in(other, one) for one in (place, *below(place))):
        wrong(f"{file} ({place}) may not include {target}")


def included(file, is_core):
    """Files of the project; what a tool makes is not among them."""
    roots = ["include"] if is_core else ["include", "tools", "port", "tests",
                                         "tests/reference"]
    for name in INCLUDE.findall(Path(file).read_text()):
        found = [one for one in (posixpath.normpath(f"{folder}/{name}")
                                 for folder in (Path(file).parent, *roots))
                 if Path(one).is_file()]
        if is_core and not found:
            wrong(f"{file} includes what is not there: {name}")
        yield from found[:1]


def imported(file):
    """By a module's last name, of its own folder or else of any."""
    for node in ast.walk(ast.parse(Path(file).read_text("utf-8"))):
        names = [alias.name for alias in node.names] if isinstance(
            node, (ast.Import, ast.ImportFrom)) else []
        if isinstance(node, ast.ImportFrom) and node.module:
            names = [node.module] + [f"{node.module}.{n}" for n in names]
        for name in names:
            stem = "/" + name.replace(".", "/") + ".py"
            found = [one for one in FILES if one.endswith(stem)]
            yield from [one for one in found if Path(one).parent ==
                        Path(file).parent] or found


edges, arrows = {}, 0
for file in FILES:
    in_core = file.startswith(("src/", "include/"))
    if not place_of(home_of(file)):
        wrong(f"{file} is in no place that arrows.py has")
    if in_core:
        known = SOURCES.get(Path(file).stem, file)
        if known != file and file.endswith(".c"):
            wrong(f"{file}: {known} has the same name")
        text = Path(file).read_text()
        for line in [*OTHER_HEADER.findall(text),
                     *(BRANCH.findall(text) if file not in ASKING else [])]:
            wrong(f"{file}: {line.strip()}")
    targets = [*(imported(file) if file.endswith(".py") else
                 included(file, in_core))]
    arrows += len(targets)
    for target in targets:
        judge(file, target)
        edges.setdefault(unit_of(file), set()).add(unit_of(target))
try:
    graphlib.TopologicalSorter({unit: others - {unit} for unit, others
                                in edges.items()}).prepare()
except graphlib.CycleError as circle:
    wrong("a circle: " + " < ".join(circle.args[1]))
checked(f"{arrows} includes and imports of {len(FILES)} files go one way")
