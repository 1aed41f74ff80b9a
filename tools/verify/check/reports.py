#!/usr/bin/python3
"""Reports say of which core they are: each has the line of `tools/stamp core`,
"Of commit HASH of src/ and include/.", and where src/ or include/ is another
now, the line after it says so, and whether that matters.

    reports.py                 holds that this is so
    reports.py --write         writes or removes the lines that say so
    reports.py --remade FILE   says that a report is of the present core

Reports are not remade for every change, so one of an older core is told, and
is no failure. A clone without the commit cannot tell; it says that instead.
Comments make no other core, and no motion depends on the serial line, which is
src/link and five headers: such a change is told as one that no number depends
on; the line makes a report of sizes, times and costs older.
"""
import re
import subprocess
import sys
from pathlib import Path

from findings import checked, need, wrong

OF_MOTIONS = [f"docs/{name}.md" for name in (
    "statistics", "RECURRENCE", "FIGURES", "FINDINGS", "FINER")]
REPORTS = OF_MOTIONS
LINE = ["src/link"] + [f"include/twofold/{name}.h" for name in (
    "wire", "frame", "command", "telemetry", "link")]
ORIGIN = re.compile(r"Of commit (.*) of src/ and include/(.*)\.")
OLDER = "The core has changed since: what follows is of the older one."
ALIKE = ("Since then comments or the serial line alone have changed: no number "
         "here depends on them.")


def git(*arguments):
    return subprocess.run(["git", *arguments], stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL).returncode


def change_since(name, commit):
    """What a report has to say of the changes since its commit: "", ALIKE or
    OLDER; None where git does not know."""
    if git("cat-file", "-e", commit + "^{commit}") != 0:
        return None
    if git("diff", "--quiet", commit, "--", "src", "include") == 0:
        return ""
    but = [f":(exclude){path}" for path in LINE] if name in OF_MOTIONS else []
    changed = subprocess.run(
        ["git", "diff", "--name-only", commit, "--", "src", "include", *but],
        stdout=subprocess.PIPE, text=True, check=True).stdout.split()
    return OLDER if any(is_other_code(commit, path) for path in changed) \
        else ALIKE


def words_of(text):
    """Code without comments and white space. Strings of src/ and include/ have
    no comment in them."""
    return re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.S).split()


def is_other_code(commit, path):
    """Whether a file of that commit had other code than now; one that is not
    there has none."""
    before = subprocess.run(["git", "show", f"{commit}:{path}"],
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                            text=True, check=False).stdout
    now = Path(path).read_text() if Path(path).exists() else ""
    return words_of(before) != words_of(now)


def origin(lines):
    """(number of the line, commit, what it says of changes since) or None."""
    for i, line in enumerate(lines):
        found = ORIGIN.fullmatch(line)
        if found:
            said = [line for line in lines[i + 1:i + 2]
                    if line in (OLDER, ALIKE)]
            return i, found, "".join(said)
    return None


def judge(name, lines, changed=change_since):
    """(what is wrong or None, what it has to say) of one report."""
    there = origin(lines)
    if there is None:
        return f"{name}: no line \"Of commit HASH of src/ and include/.\"", None
    _, found, says = there
    if not re.fullmatch("[0-9a-f]{7,40}", found[1]) or found[2]:
        return f"{name}: is of no commit: {found[0]}", None
    change = changed(name, found[1])
    if change is not None and says != change:
        return (f"{name}: says \"{says}\" behind its commit and has to say "
                f"\"{change}\": make stale"), change
    return None, change


def write(name):
    lines = Path(name).read_text().split("\n")
    there = origin(lines)
    change = there and change_since(name, there[1][1])
    if change is None:
        print(f"{name}: not known of which core it is")
        return
    at, _, says = there
    if change != says:
        lines[at + 1:at + 1 + bool(says)] = [change] if change else []
        Path(name).write_text("\n".join(lines))
    print(f"{name}: {change or 'of the present core'}")


def remade(name):
    lines = Path(name).read_text().split("\n")
    at, _, says = origin(lines)
    lines[at:at + 1 + bool(says)] = [subprocess.run(
        ["tools/stamp", "core"], stdout=subprocess.PIPE, text=True,
        check=True).stdout.strip()]
    Path(name).write_text("\n".join(lines))


def judge_seeds():
    """What is planted here must be found."""
    for one, other, want in (("int a; // b", "int a; /* c\n */", True),
                             ("int a;", "int b;", False),
                             ("a / b", "a", False)):
        if (words_of(one) == words_of(other)) != want:
            wrong(f"planted: {one!r} and {other!r} are judged wrongly")
    line = "Of commit 0123456 of src/ and include/."
    for lines, change, want in (
            (["# Title"], "", "no line"),
            ([line[:-1] + ", with changes."], "", "is of no commit"),
            ([line], OLDER, "has to say"), ([line], ALIKE, "has to say"),
            ([line, OLDER], "", "has to say"),
            ([line, OLDER], ALIKE, "has to say"),
            ([line, ALIKE], OLDER, "has to say"),
            ([line, OLDER], OLDER, None), ([line, ALIKE], ALIKE, None),
            ([line], "", None), ([line], None, None)):
        said, _ = judge("planted", lines, lambda *_, change=change: change)
        if (want or "") not in (said or "") or (want is None) != (said is None):
            wrong(f"a planted report is judged \"{said}\", not \"{want}\"")


need("git", "git")
for gone in LINE:
    if not Path(gone).exists():
        wrong(f"{gone}: excepted, and not there")
if sys.argv[1:] == ["--write"]:
    for report in REPORTS:
        write(report)
elif sys.argv[1:2] == ["--remade"]:
    for report in sys.argv[2:]:
        remade(report)
else:
    judge_seeds()
    old, unknown = [], []
    for report in REPORTS:
        said, change = judge(report, Path(report).read_text().split("\n"))
        if said:
            wrong(said)
        if change == OLDER:
            old.append(Path(report).stem)
        if change is None:
            unknown.append(Path(report).stem)
    if unknown:
        print("not in this clone's history:", *unknown)
    checked(f"{len(REPORTS)} reports; of an older core and saying so: "
            f"{' '.join(old) or 'none'}; not known without more history: "
            f"{' '.join(unknown) or 'none'}")
