#!/usr/bin/python3 -B
"""`twofold sweep` in shards under the real GNU parallel and Snakemake, and
`twofold diverge` by tasks of Slurm's script started by hand: the bytes of one
run, also where tasks were lost and started again; and the map of a sweep. With
them go the laws of the studies (tests/study). A program that is missing is
skipped by name, or fails where it is required."""
import importlib
import os
import shutil
import sys
from pathlib import Path

for room in "support", "study":
    sys.path.append(str(Path(__file__).resolve().parents[1] / room))
from tap import ROOT, TWOFOLD, check, lacks, run  # noqa: E402
from tap import call as tap_call  # noqa: E402

TOOLS = ROOT / "tools/study" / "shards"
SWEEP = ["chaos", "--over", "kappa=0.2:0.4:12", "--over",
         "gamma=-0.6:0.6:5", "--dt", "1e-3", "--outcome",
         "modes,ambiguous,arrivals"]
DIVERGE = ["chaos", "--samples", "7", "--cycles", "3", "--seed", "4"]
SHARDS = 5


def needs(package, *programs):
    """Skips a test, or fails it where the package is required."""
    if not all(map(shutil.which, programs)):
        lacks(package)


def call(*words, code=0, **options):
    """All that a command writes."""
    return "".join(tap_call(*words[1:], program=words[0], code=code,
                            **options))


def whole(folder, *more):
    """The file of one run."""
    path = folder / "whole.csv"
    call(TWOFOLD, "sweep", *SWEEP, *more, "--out", path)
    return path


def files(folder, name="out"):
    return [folder / f"{name}.{i}.csv" for i in range(1, SHARDS + 1)]


def joined(paths):
    return b"".join(path.read_bytes() for path in paths)


def lose(folder, i):
    """What a task leaves that was lost before it began."""
    for path in folder.glob(f"out.{i}.csv*"):
        path.unlink()


def under_parallel(folder):
    needs("parallel", "parallel")
    command = ["parallel", "--joblog", folder / "log", TWOFOLD, "sweep",
               *SWEEP, "--shard", f"{{}}/{SHARDS}", "--out",
               f"{folder}/out.{{}}.csv", "--resume", ":::",
               *range(1, SHARDS + 1)]
    environment = dict(os.environ, PARALLEL_HOME=str(folder))
    want = whole(folder).read_bytes()
    call(*command, env=environment)
    check(joined(files(folder)) == want, "not the bytes of one run")
    before = [path.stat().st_mtime_ns for path in files(folder)]
    lose(folder, 4)
    call(*command, env=environment)
    check(joined(files(folder)) == want, "not the bytes of one run")
    after = [path.stat().st_mtime_ns for path in files(folder)]
    check([a == b for a, b in zip(before, after)] ==
          [True, True, True, False, True], "only the lost shard is done again")


def under_slurm(folder):
    def task(i):
        call("sh", TOOLS / "shards.sbatch", folder / "part", "diverge",
             *DIVERGE, env={**os.environ, "TWOFOLD": TWOFOLD,
                            "SLURM_ARRAY_TASK_ID": str(i),
                            "SLURM_ARRAY_TASK_MAX": str(SHARDS)})

    kinds = "exits", "returns"
    call(TWOFOLD, "diverge", *DIVERGE, *(
        word for kind in kinds for word in (f"--{kind}", folder / kind)))
    for i in (*range(1, SHARDS + 1), 2):
        task(i)  # one again: it has all
    for kind in kinds:
        check(joined(files(folder, f"part-{kind}")) ==
              (folder / kind).read_bytes(), f"{kind}: not those of one run")


def under_snakemake(folder):
    needs("snakemake", "snakemake")
    command = ["snakemake", "-s", TOOLS / "Snakefile", "--cores", "2",
               "--nolock", "--config", "out=out", f"shards={SHARDS}",
               f"twofold={TWOFOLD}", "sweep=" + " ".join(SWEEP),
               "map=kappa gamma modes"]
    environment = dict(os.environ, XDG_CACHE_HOME=str(folder / "cache"))
    want = whole(folder).read_bytes()
    call(*command, cwd=folder, env=environment)
    check((folder / "out.csv").read_bytes() == want, "not those of one run")
    check((folder / "out.png").read_bytes().startswith(b"\x89PNG"), "no map")
    lose(folder, 3)
    (folder / "out.csv").unlink()
    call(*command, cwd=folder, env=environment)
    check((folder / "out.csv").read_bytes() == want, "not those of one run")
    said = call(*command, cwd=folder, env=environment)
    check("Nothing to be done" in said, "what is whole is not done again")
    call(*command[:8], "out=out", code=1, cwd=folder, env=environment)


def draw(*words, code=0):
    return call(TOOLS / "map.py", *words, code=code)


def maps(folder):
    table, picture = whole(folder), folder / "map.svg"
    for outcome in "modes", "ambiguous", "status":
        draw(table, "kappa", "gamma", outcome, picture)
        text = picture.read_text()
        check("<svg" in text and "pattern" in text, "refused points are "
              f"hatched in the map of {outcome}")
    line = folder / "line.csv"
    call(TWOFOLD, "sweep", "chaos", "--over", "kappa=0.2:0.4:9", "--out", line)
    for outcome in "energy", "modes":
        draw(line, "kappa", outcome, folder / "line.png")


def maps_refuse(folder):
    table, picture = whole(folder), folder / "no.png"
    for words, text in [
            (["kappa", "gamma", "mode"], "there is no column 'mode'"),
            (["kappa", "modes"], "another axis was swept, too"),
            (["kappa", "reason", "modes"], "words, not numbers")]:
        said = draw(table, *words, picture, code=3)
        check(text in said and "Traceback" not in said, said)
    first, second = folder / "first.csv", folder / "second.csv"
    for path, shard in (first, "1/2"), (second, "2/2"):
        call(TWOFOLD, "sweep", *SWEEP, "--shard", shard, "--out", path)
    lines = table.read_text().splitlines(keepends=True)
    for text in ("".join([*lines[:20], *lines[25:]]),
                 joined([first, first]).decode(),
                 lines[0] + second.read_text()):
        bad = folder / "bad.csv"
        bad.write_text(text)
        said = draw(bad, "kappa", "gamma", "modes", picture, code=3)
        check("a shard is missing" in said and "Traceback" not in said, said)
    said = draw(table, "kappa", "gamma", "modes", folder / "x.what", code=3)
    check("x.what" in said and "Traceback" not in said, said)
    draw(table, code=2)
    check(not picture.exists(), "a table that is refused has no picture")


TESTS = [("parallel: the bytes of one run", under_parallel),
         ("Slurm: the bytes of one run", under_slurm),
         ("Snakemake: the bytes of one run", under_snakemake),
         ("map: words, numbers, refused points, one axis", maps),
         ("map: what it refuses", maps_refuse),
         *(test for path in sorted(ROOT.glob("tests/study/test_*.py"))
           for test in importlib.import_module(path.stem).TESTS)]


# Two at a time: each is one process most of the time, or waits.
sys.exit(run([(name, lambda test=test: test(Path.cwd()))
              for name, test in TESTS], jobs=2))
