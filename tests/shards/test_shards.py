#!/usr/bin/python3 -B
"""`twofold sweep` in shards under the real GNU parallel and Snakemake: the rows
of one run, also where tasks were lost and started again; its map; and counts of
`twofold diverge`, by tasks of Slurm's script started by hand. With them go the
laws of the study's own integrators (tests/study). A program that is missing is
skipped by name, or fails where it is required."""
import csv
import os
import re
import shutil
import sys
import zlib
from collections import Counter
from pathlib import Path

for room in "support", "study":
    sys.path.append(str(Path(__file__).resolve().parents[1] / room))
from tap import ROOT, TWOFOLD, check, lacks, run  # noqa: E402
from tap import call as tap_call  # noqa: E402
import test_finer  # noqa: E402
import test_mechanisms  # noqa: E402
import test_noise  # noqa: E402
import test_trolley  # noqa: E402

TOOLS = ROOT / "tools/study" / "shards"
SWEEP = ["chaos", "--over", "kappa=0.2:0.4:12", "--over",
         "gamma=-0.6:0.6:5", "--dt", "1e-3", "--outcome",
         "modes,ambiguous,arrivals"]
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


def rows(*paths):
    return [line for path in paths for line in Path(path).read_text()
            .splitlines() if not line.startswith("#")]


def files(folder, name="out"):
    return [folder / f"{name}.{i}.csv" for i in range(1, SHARDS + 1)]


def same_rows(folder, *paths):
    check(rows(*paths) == rows(whole(folder)), "not the rows of one run")


def lose(path):
    """What a kill leaves of a file: a part of its rows with its check, and half
    of one."""
    lines = path.read_bytes().splitlines(keepends=True)
    kept = lines[:len(lines) * 2 // 3]
    told = [line for line in kept if not line.startswith(b"#")]
    count = sum(line[:1].isdigit() for line in told)
    check_line = re.sub(rb": \d+ rows, crc32 \w+", b": %d rows, crc32 %08x" %
                        (count, zlib.crc32(b"".join(told))), lines[-1])
    path.with_name(path.name + ".part").write_bytes(
        b"".join([*kept, check_line, lines[len(kept)][:20]]))
    path.unlink()


def under_parallel(folder):
    needs("parallel", "parallel")
    command = ["parallel", "--joblog", folder / "log", TWOFOLD, "sweep",
               *SWEEP, "--shard", f"{{}}/{SHARDS}", "--out",
               f"{folder}/out.{{}}.csv", "--resume", ":::",
               *range(1, SHARDS + 1)]
    environment = dict(os.environ, PARALLEL_HOME=str(folder))
    call(*command, env=environment)
    same_rows(folder, *files(folder))
    before = [path.stat().st_mtime_ns for path in files(folder)]
    lose(files(folder)[3])
    call(*command, env=environment)
    same_rows(folder, *files(folder))
    after = [path.stat().st_mtime_ns for path in files(folder)]
    check([a == b for a, b in zip(before, after)] ==
          [True, True, True, False, True], "only the lost shard is done again")


COUNTED = ["chaos", "--samples", "7", "--cycles", "3", "--seed", "4"]


def counted(*paths, out, code=0):
    """Merges files of counts. Returns: what was said."""
    return call(TWOFOLD, "merge", *paths, "--out", out, code=code)


def counts(folder):
    """Those of the rows; what is damaged, double or foreign is refused."""
    exits, returns = folder / "exits", folder / "returns"
    one = folder / "one"
    call(TWOFOLD, "diverge", *COUNTED, "--exits", exits, "--returns", returns,
         "--counts", one)
    expected = Counter()
    for row in csv.DictReader(rows(returns)):
        back = row["outcome"] == "returned"
        expected["outcome", row["outcome"]] += 1
        expected["begun", row["cycle"]] += 1
        if back:
            expected["returned", row["cycle"]] += 1
            width = 100 / 4096
            expected["time", str(int(float(row["time"]) // width))] += 1
        if row["landing_r"]:
            expected["landing",
                     str(int(float(row["landing_r"]) // 1e-4))] += 1
    for row in csv.DictReader(rows(exits)):
        expected["side", row["side"]] += 1
        if row["phase"]:
            expected["phase", str(int(float(row["phase"]) * 100))] += 1
    found = {(row["what"], row["key"]): int(row["count"])
             for row in csv.DictReader(rows(one))}
    check(found == dict(expected), "counts are not those of the rows")
    for i in range(1, SHARDS + 1):
        call("sh", TOOLS / "shards.sbatch", folder / "part", "counts",
             *COUNTED, env={**os.environ, "TWOFOLD": TWOFOLD,
                            "SLURM_ARRAY_TASK_ID": str(i),
                            "SLURM_ARRAY_TASK_MAX": str(SHARDS)})
    parts = files(folder, "part")
    counted(*parts[3:], out=folder / "some")
    said = counted(*reversed(parts[:3]), folder / "some", out=folder / "all")
    check("5 of 5" in said, said)
    check((folder / "all").read_bytes() == one.read_bytes(), "other bytes")
    text = parts[0].read_text()
    bad = folder / "bad"
    for wrong in (text[:len(text) // 2], text.replace(",1\n", ",2\n", 1),
                  "", text + text, text.rsplit("#", 1)[0]):
        bad.write_text(wrong)
        counted(bad, out=folder / "no", code=2)
    counted(parts[0], folder / "absent", out=folder / "no", code=2)
    said = counted(parts[0], folder / "some", parts[4], out=folder / "no",
                   code=3)
    check("shard 5 is in another file" in said, said)
    call(TWOFOLD, "diverge", *COUNTED[:-1], "5", "--counts", bad)
    said = counted(parts[0], bad, out=folder / "no", code=3)
    check("another run" in said, said)
    said = counted(one, parts[0], out=folder / "no", code=3)
    check("of the same run, cut into 5 shards and not 1" in said, said)
    check(not (folder / "no").exists(), "what is refused writes nothing")
    for wrong in (["--counts", one, "--exits", one], ["--exhaustive",
                                                      "--counts", one]):
        call(TWOFOLD, "diverge", *COUNTED, *wrong, code=2)
    call(TWOFOLD, "diverge", "chaos", "--cycles", "65537", "--counts", bad,
         code=3)


def under_snakemake(folder):
    needs("snakemake", "snakemake")
    command = ["snakemake", "-s", TOOLS / "Snakefile", "--cores", "2",
               "--nolock", "--config", "out=out", f"shards={SHARDS}",
               f"twofold={TWOFOLD}", "sweep=" + " ".join(SWEEP),
               "map=kappa gamma modes"]
    environment = dict(os.environ, XDG_CACHE_HOME=str(folder / "cache"))
    call(*command, cwd=folder, env=environment)
    same_rows(folder, folder / "out.csv")
    check((folder / "out.png").read_bytes().startswith(b"\x89PNG"), "no map")
    lose(files(folder)[2])
    (folder / "out.csv").unlink()
    said = call(*command, cwd=folder, env=environment)
    same_rows(folder, folder / "out.csv")
    check("were there" in said, "the lost shard goes on behind its last row")
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
    draw(table, "kappa", "gamma", "modes", folder / "again.svg")
    line = folder / "line.csv"
    call(TWOFOLD, "sweep", "chaos", "--over", "kappa=0.2:0.4:9", "--out", line)
    for outcome in "energy", "modes":
        draw(line, "kappa", outcome, folder / "line.png")


def maps_refuse(folder):
    table, picture = whole(folder), folder / "no.png"
    lines = table.read_text().splitlines(keepends=True)
    cut = folder / "cut.csv"
    cut.write_text("".join(lines[:-9] + lines[-1:]))
    for words, text in [
            (["kappa", "gamma", "mode"], "there is no column 'mode'"),
            (["kappa", "modes"], "another axis was swept, too"),
            (["kappa", "reason", "modes"], "not a number")]:
        said = draw(table, *words, picture, code=3)
        check(text in said and "Traceback" not in said, said)
    said = draw(cut, "kappa", "gamma", "modes", picture, code=3)
    check("shard 1/1 is damaged" in said, said)
    shard = folder / "shard.csv"
    call(TWOFOLD, "sweep", *SWEEP, "--shard", "1/2", "--out", shard)
    said = draw(shard, "kappa", "gamma", "modes", picture, code=3)
    check("shard 2/2 is missing" in said, said)
    for other, text in ((["--shard", "2/2", "--set", "mu=1.1"],
                         "of another run"),
                        (["--shard", "1/2"], "shard 2 is missing")):
        call(TWOFOLD, "sweep", *SWEEP, *other, "--out", folder / "other.csv")
        joined = folder / "joined.csv"
        joined.write_text(shard.read_text() +
                          (folder / "other.csv").read_text())
        said = draw(joined, "kappa", "gamma", "modes", picture, code=3)
        check(text in said, said)
    said = draw(table, "kappa", "gamma", "modes", folder / "x.what", code=3)
    check("x.what" in said and "Traceback" not in said, said)
    draw(table, code=2)
    check(not picture.exists(), "a table that is refused has no picture")


TESTS = [("parallel: the rows of one run", under_parallel),
         ("Snakemake: the rows of one run", under_snakemake),
         ("map: words, numbers, refused points, one axis", maps),
         ("map: what it refuses", maps_refuse),
         ("counts: those of the rows, merged in any order", counts),
         *test_finer.TESTS, *test_mechanisms.TESTS,
         *test_noise.TESTS, *test_trolley.TESTS]


# Two at a time: each is one process most of the time, or waits.
sys.exit(run([(name, lambda test=test: test(Path.cwd()))
              for name, test in TESTS], jobs=2))
