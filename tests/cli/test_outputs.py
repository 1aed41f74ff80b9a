#!/usr/bin/python3 -B
"""What the command line writes is whole, or does not have the name of a whole
file: killed, interrupted and full, with a second writer, through links and into
what is not a file."""
import os
import signal
import subprocess
from pathlib import Path

from outputs import check_whole, ended, says, started
from tap import TWOFOLD, call, check, main, same

ROWS = ["run", "chaos", "--t-end", "0.01"]
ENDLESS = ["run", "chaos", "--t-end", "1e9", "--every", "1000"]


def is_whole(path, want):
    same(Path(path).read_text(), want)
    check(not Path(f"{path}.part").exists(), f"{path}: a part is left")


def test_whole_files():
    want = call(*ROWS)[0]
    os.umask(0o022)
    Path("private").write_text("old")
    Path("private").chmod(0o600)
    for path, mode in ("new", 0o644), ("private", 0o600):
        call(*ROWS, "--out", path)
        is_whole(path, want)
        same(Path(path).stat().st_mode & 0o777, mode)
    says(4, "step 2 was refused&its rows are in stop.part", "run",
         "frictionless", *"--set k2=0 --set v=4e8 --set omega=0 --set c1=0 "
         "--set c2=0 --dt 1 --t-end 10 --every 5 --out stop".split())
    same(Path("stop.part").read_text().splitlines()[2].split(",")[0], "1")
    check(not Path("stop").exists(), "a file of a run that was refused a step")
    size = Path("stop.part").stat().st_size
    says(0, f"note: stop.part: overwrites {size} bytes of rows of a command "
         "that was stopped", *ROWS, "--out", "stop")
    is_whole("stop", want)


def test_links():
    """They stay links; what they name is written, also where it is not there
    yet. A part that is a link of any kind is somebody's file."""
    want = call(*ROWS)[0]
    Path("room").mkdir()
    Path("link").symlink_to("room/target")
    for _ in range(2):
        call(*ROWS, "--out", "link")
        is_whole("room/target", want)
        check(Path("link").is_symlink(), "still a link")
    Path("again").symlink_to("again")
    says(4, "symbolic links", *ROWS, "--out", "again")
    Path("victim").write_text("precious")
    Path("trap.part").symlink_to("victim")
    says(4, "--out trap", *ROWS, "--out", "trap")
    os.link("victim", "hard.part")
    says(4, "hard link to another file", *ROWS, "--out", "hard")
    same(Path("victim").read_text(), "precious")


def test_what_is_no_file():
    """It is written as it is, and nothing around the rows is lost."""
    want = call(*ROWS)[0]
    os.mkfifo("pipe")
    with subprocess.Popen(["cat", "pipe"], stdout=subprocess.PIPE) as reader:
        call(*ROWS, "--out", "pipe")
        same(reader.communicate()[0].decode(), want)
    call(*ROWS, "--out", "/dev/null")
    same(call(*ROWS, "--out", "/dev/stdout")[0], want)
    for path in "/dev/stdout", "/dev/fd/3":
        done = subprocess.run(
            ["sh", "-c", 'echo before >got; "$@" >>got 3>&1; echo after >>got',
             "sh", TWOFOLD, *ROWS, "--out", path], check=False,
            stderr=subprocess.DEVNULL)
        same(done.returncode, 0)
        same(Path("got").read_text(), f"before\n{want}after\n")
    check(not list(Path().glob("*.part")), "a part of what is no file")


def test_one_writer_a_file():
    """Under whatever name."""
    child = started("x", *ENDLESS, "--out", "x")
    Path("other").symlink_to("x")
    for name in "x", "./x", Path.cwd() / "x", "other":
        says(4, f"--out {name}: another program writes this file", *ROWS,
             "--out", name)
    call(*ROWS, "--format", "frames", "--out", "stream")
    busy = "another program writes this file"
    says(4, busy, "monitor", "stream", "--format", "csv", "--out", "x")
    says(4, busy, "diverge", "chaos", "--samples", "1", "--patience", "0.01",
         "--exits", "y", "--returns", "x")
    check(not list(Path().glob("y*")), "what was not begun leaves a file")
    ended(child, signal.SIGTERM)
    check_whole("x.part", 11)
    child = started("x", *ENDLESS, "--out", "x")
    Path("x.part").rename("moved")
    ended(child, signal.SIGTERM)
    check(not Path("x").exists(), "a part that was moved away has its name")


def test_nohup():
    """Without it SIGHUP stops a run as SIGTERM does."""
    ended(started("x", *ENDLESS, "--out", "x"), signal.SIGHUP)
    child = started("x", *ENDLESS, "--out", "x", preexec_fn=lambda:
                    signal.signal(signal.SIGHUP, signal.SIG_IGN))
    child.send_signal(signal.SIGHUP)
    ended(child, signal.SIGTERM)


main(globals(), jobs=2)
