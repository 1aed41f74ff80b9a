"""The opening and the tour. Numbers that are told are those of the command
line, in as many digits as the page shows."""
import ast
import csv
import json
import re

from page import (ROOT, arrived, check, command, leads_there, opened, settled,
                  shown, step)
from tap import until
from test_setup import ENTER

TWO_FOLD = 20471  # the first step of `chaos` that has three futures in stick+


def told(tab, place):
    """Words of the tour, with plain spaces and minus signs."""
    return shown(tab, place).replace("\u00a0", " ").replace("\u2212", "-")


def says(tab, words, place="says"):
    check(words in told(tab, place), f"{words} is not in {told(tab, place)}")


def figure(x, digits=4):
    return f"{float(x):.{digits}g}"


def rows_of(*words):
    return list(csv.DictReader(command("run", "chaos", *words).splitlines()))


def test_opening():
    """The start of README's picture with its futures, each to be chosen."""
    text = (ROOT / "tools/study/futures.py").read_text()
    start = ast.literal_eval(re.search(r"^START = (.*)", text, re.M)[1])
    sets = [f"--set={name}={value}" for name, value in start.items()]
    row = rows_of("--t-end", "0", *sets)[0]
    tab = opened("")
    arrived(tab)
    words = tab.value("twofold.write()").split("&")
    check(set(words) >= {"=".join(item) for item in start.items()}, words)
    modes = tab.value("twofold.fan.futures.map((future) => future.mode)")
    check(str(len(modes)) == row["choices"], modes)
    says(tab, "same instant: three motions, all allowed by the laws")
    for key, mode in enumerate(modes, 1):
        step(tab, 0)
        tab.key(str(key))
        until(lambda: told(tab, "then").startswith("You chose"), "is told")
        check(tab.value("twofold.motion.log[0].mode") == mode, mode)


def test_tour_has_the_numbers_of_the_command_line():
    tab = opened("")
    step(tab, 1)
    mu = re.search(r"^mu\s+(\S+)", command("scene", "chaos"), re.M)[1]
    force = abs(float(rows_of("--t-end", "0.2")[-1]["F"]))
    says(tab, f"with {figure(force, 2)} N now; it can hold "
              f"{figure(mu)} N")
    fold = json.loads(command("singularities", "chaos"))["two_folds"][0]
    step(tab, 2)
    says(tab, f"past r = {figure(fold['r'])} m", "asks")
    for r, verb in (("0.19", "brakes a slip"), ("0.18", "speeds a slip up")):
        tab.value(f"({ENTER})('r', '{r}')")
        settled(tab)
        map_ = command("regions", "chaos", "--r", f"{r}:{r}:1",
                       "--omega=-1.03:-1.03:1").splitlines()
        brake = 1000 * abs(float(next(csv.DictReader(map_))["delassus"]))
        says(tab, f"At r = {r} m, 1 N of friction {verb} by "
                  f"{figure(brake, 3)} mm")
        check((told(tab, "then") != "") == (r == "0.18"), r)
    rows = rows_of("--t-end", "2.3", "--every", "1")
    step(tab, 3)
    says(tab, f"r = {figure(fold['r'])} m, ω = {figure(fold['omega'])} rad/s")
    tab.key(" ")
    until(lambda: told(tab, "then"), "it is there")
    row = rows[TWO_FOLD]
    check(rows[TWO_FOLD - 1]["choices"] == "1", "there are several before")
    says(tab, f"at t = {figure(row['t'], 5)} s it has {row['choices']} future",
         "then")
    step(tab, 4)
    check(str(tab.value("twofold.fan.futures.length")) == row["choices"], row)
    step(tab, 5)
    tab.key(" ")
    until(lambda: told(tab, "then"), "it sticks again")
    modes = [row["mode"] for row in rows[TWO_FOLD:]]
    end = modes.index("stick-")
    turns = sum(a != b and a[:4] == b[:4] == "slip"
                for a, b in zip(modes[:end], modes[1:end]))
    row = rows[TWO_FOLD + end]
    says(tab, f"At t = {figure(row['t'], 5)} s, after {turns} changes of side"
              f", it sticks again, at r = {figure(row['r'], 5)} m", "then")


def test_tour_by_keyboard():
    """Through all steps; gestures have keys; the address keeps the step, and
    has none when the tour is left."""
    tab = opened("")
    arrived(tab)
    for number in range(1, 6):
        tab.key("n")
        arrived(tab)
        check(told(tab, "part") == f"{number} of 5", told(tab, "part"))
        check(told(leads_there(tab), "title") == told(tab, "title"), number)
    tab.key("p")
    tab.value("document.getElementById('surface').focus()")
    tab.key("ArrowRight")
    check(abs(tab.value("twofold.views[1].round") + 0.4) < 1e-9, "not turned")
    step(tab, 1)
    tab.value("document.querySelector('#grip input').focus()")
    for _ in range(40):
        tab.key("ArrowRight")
    until(lambda: "It slips" in told(tab, "then"), "it slips")
    tab.value("document.getElementById('leave').focus()")
    tab.key(" ")
    check(tab.value("twofold.tour.number") is None
          and "tour=" not in tab.value("twofold.write()"), "not left")
    tab.key("?")
    check("play, pause" in shown(tab, "said"), "the keys are not told")


def test_another_scene():
    """It ends the tour, plays on, and what was said of the last is gone."""
    tab = opened("scene=frictionless&tour=3&kapa=1")
    check(tab.value("twofold.tour.number") is None, "the tour goes on")
    check("kapa" in shown(tab, "said"), "nothing is said")
    tab.key(" ")
    tab.value("(({ scene }) => { scene.selectedIndex = 2; scene.onchange(); })"
              "(document.all)")
    until(lambda: tab.value("twofold.motion.tick > 100"), "it plays")
    check(shown(tab, "said") == "", shown(tab, "said"))
