"""Runs the checks, or those named: tools/run check [NAME...]. Ends with a
table of what was checked and how long it took (seconds, and those of
processors), and the line "N passed, N failed". Output of a check appears where
it fails; BUILD/NAME.log keeps all of it. A missing tool is a failure: what was
not checked is not known to hold. A signal ends every check with all that it has
started, and nothing temporary is left. With FULL=yes checks do all of what they
sample otherwise.

Environment: JOBS (checks at a time; default one a processor), BUILD, FULL.
"""
from __future__ import annotations

import os
import re
import subprocess
import sys
import time
from pathlib import Path

import driven

# Name, script and argument of each check: the quick ones first, and of the
# others no long one so late that it is left alone at the end.
CHECKS = {line.split()[0]: line.split()[1:] for line in """
format         sources.py layout
files          files.py
shell          sources.py shell
python         sources.py python
arrows         arrows.py
figures        compiled.py figures
gcc            compiled.py warnings gcc
clang          compiled.py warnings clang
stack          stack.py
cost           cost.py
sizes          ../../run bench sizes --check
loops          loops.py
vectors        vectors.py
freestanding   compiled.py freestanding
data           compiled.py data
readme         readme.py
reference      reference.py
cppcheck       sources.py cppcheck
misra          sources.py misra
tidy           sources.py tidy
sanitize-gcc   compiled.py sanitize gcc
bits           compiled.py bits
contraction    contraction.py
memory         compiled.py memory
eva            ../../run eva
hostile        compiled.py hostile
soak           soak.py
fuzz           compiled.py fuzz
mutation       compiled.py mutation
coverage       compiled.py coverage
sanitize-clang compiled.py sanitize clang
""".strip().splitlines()}
WRONG = re.compile("^not ok|wrong|fail|error", re.I)


def judged(name: str, place: Path) -> tuple[bool, str]:
    """Runs a check. Returns: whether it passed, and its line of the table."""
    script, *words = CHECKS[name]
    log, note = place / f"{name}.log", place / f"{name}.note"
    note.unlink(missing_ok=True)
    begin = time.time()
    with open(log, "wb") as out:
        # pylint: disable=consider-using-with
        child = subprocess.Popen(
            [f"tools/verify/check/{script}", *words], stdout=out, stderr=out,
            stdin=subprocess.DEVNULL,
            env={**os.environ, "CHECK_NOTE": str(note)})
        _, status, usage = os.wait4(child.pid, 0)
        code = child.returncode = os.waitstatus_to_exitcode(status)
    took, worked = time.time() - begin, usage.ru_utime + usage.ru_stime
    said = log.read_text("utf-8", "replace").splitlines()
    if code == 0:
        what = note.read_text("utf-8").strip() if note.exists() else said[-1]
    elif code == 3:
        what = said[-1] if said else ""
    else:  # The first line that tells what failed; the rest is in the log.
        what = next((line[:160] for line in said if WRONG.search(line)),
                    (said or ["no word"])[-1][:160]) + f" (see {log})"
    result = {0: "passed", 3: "not tried"}.get(code, "FAILED")
    print("\n".join([f"== {name}: {result}, {took:.0f} s",
                     *(said[-60:] if code else [])]))
    return code == 0, (f"{name:15s} {result:9s} {took:4.0f} {worked:4.0f}  "
                       f"{what}")


def main() -> None:
    wanted = sys.argv[1:] or list(CHECKS)
    unknown = set(wanted) - set(CHECKS)
    if unknown:
        print(f"no check is named {min(unknown)}; there are:", *CHECKS,
              sep="\n", file=sys.stderr)
        sys.exit(2)
    place = Path(os.environ.setdefault("BUILD", "build/check"))
    place.mkdir(parents=True, exist_ok=True)
    rows = driven.side_by_side(lambda name: judged(name, place),
                               [name for name in CHECKS if name in wanted])
    print("\ncheck           result       s  cpu  what was checked")
    for _, row in rows:
        print(row)
    failed = sum(not passed for passed, _ in rows)
    print(f"{len(rows) - failed} passed, {failed} failed")
    sys.exit(failed > 0)

