"""Of the check `published`: docs/RECURRENCE.md and docs/FINER.md by small runs
of their tools, other machines and other seeds than those of the pages."""
import importlib.machinery
import importlib.util
import os
import re
import subprocess
import sys

from findings import ROOT, wrong

sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tools/study/recurrence")]
MACHINES = 36  # of each space
KICKED = (1e-12, 22), (1e-8, 20), (1e-8, 22), (1e-8, 24)  # kick, power/4
SAMPLES = 12


def script(path):
    """A script as a module, which finds those beside it."""
    sys.dont_write_bytecode = True
    sys.path.insert(0, str(path.parent))
    loader = importlib.machinery.SourceFileLoader(path.name, str(path))
    module = importlib.util.module_from_spec(
        importlib.util.spec_from_loader(path.name, loader))
    loader.exec_module(module)
    sys.path.remove(str(path.parent))
    return module


def rows_of(text, columns):
    """Cells of the rows of all tables with these first columns."""
    for table in re.findall(r"((?:^\|.*\n)+)", text, re.M):
        head, _, *rows = [[cell.strip() for cell in line.split("|")[1:-1]]
                          for line in table.splitlines()]
        if head[:len(columns)] == columns:
            yield from (dict(zip(head, row)) for row in rows)


def interval(cell):
    """The interval of a cell `VALUE [LOW, HIGH]`."""
    found = re.fullmatch(r"\S+ \[(\S+), (\S+)\]", cell)
    return float(found[1]), float(found[2])


def recurrence(place, meets):
    """Shares of a few machines. Returns: how many were judged."""
    os.environ["BUILD"] = str(place)
    tool = script(ROOT / "tools/study/recurrence/recurrence")
    import driven
    import machines
    from random import Random
    from report import CLASSES, class_of
    from tables.read import Row
    text = (ROOT / "docs/RECURRENCE.md").read_text(encoding="utf-8")
    said = {(row["machines"], row["exits by"]): row for row in
            rows_of(text, ["machines", "exits by", "drawn"])}
    numbers = [number for name in machines.SPACES
               for number in Random(77).sample(
                   [i for i in range(machines.MACHINES)
                    if machines.space_of(i) == name], MACHINES)]
    found = [Row("", machines.COLUMNS, tool.line_of(row).split(","))
             for row in driven.side_by_side(tool.row, numbers)]
    judged = 0
    for name, space in machines.SPACES.items():
        here = [row for row in found
                if row["space"] == name and not row["reason"]]
        for kind in machines.KINDS:
            row = said.get((space.title, kind))
            if row is None:
                wrong(f"docs/RECURRENCE.md has no row of {space.title}, {kind}")
                continue
            for one in CLASSES:
                k = sum(class_of(machine, kind) == one for machine in here)
                judged += 1
                if not meets(interval(row[one]), k, len(here)):
                    wrong(f"{space.title}, exits by {kind}: {k} of {len(here)} "
                          f"are {one}; docs/RECURRENCE.md has {row[one]}")
    return judged


def motions(place, *words):
    """What the tool of finer laws prints of motions in x87's long double."""
    said = subprocess.run([place / "finer/finer-64", *words], check=True,
                          text=True, stdout=subprocess.PIPE).stdout
    head, *lines = [line.split(",") for line in said.splitlines()]
    return [dict(zip(head, line)) for line in lines]


def finer(place, meets, exact):
    """Sides under a disturbance, and how much a kick grows. Returns: how many
    were judged."""
    from finer import theory
    text = (ROOT / "docs/FINER.md").read_text(encoding="utf-8")
    fold = theory.TwoFold(str(place / "double/twofold"))
    spread = {(float(row["disturbance [m/s]"]),
               float(row["effective width [m/s]"])): row for row in
              rows_of(text, ["disturbance [m/s]", "effective width [m/s]"])}
    for kick, power in KICKED:
        row = spread[kick, float(f"{10 ** (-power / 4):.2g}")]
        sides = [one["side"] for one in motions(
            place, "form=algebraic", f"samples={SAMPLES}", "seed=77",
            f"width={fold.width('algebraic', 10 ** (-power / 4)):.17g}",
            f"kick={kick:g}")]
        left, n = (int(word) for word in row["leave"].split(" of "))
        for what, k, of, among, all_of in (
                ("leave", left, n, len(sides) - sides.count("0"), len(sides)),
                ("to slip+", int(row["to slip+"]), left, sides.count("1"),
                 len(sides) - sides.count("0"))):
            if not meets(exact(k, of), among, all_of):
                wrong(f"a kick of {kick:g} m/s, 10^(-{power}/4) m/s: {among} "
                      f"of {all_of} {what}; docs/FINER.md has {k} of {of}")
    kicks = [row for row in rows_of(text, ["effective width [m/s]",
                                           "kick [m/s]"])
             if row["effective width [m/s]"] == "1e-07"]
    for row in kicks:
        width = f"width={fold.width('algebraic', 1e-7):.17g}"
        one = motions(place, "form=algebraic", width,
                      f"kick={row['kick [m/s]']}")[0]
        if abs(float(one["behind"]) - float(row["exponent"])) > 0.02:
            wrong(f"a kick of {row['kick [m/s]']} m/s grows by exp("
                  f"{one['behind']}); docs/FINER.md has {row['exponent']}")
    return 2 * len(KICKED) + len(kicks)
