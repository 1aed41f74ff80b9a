"""The figures that the report should reach, each judged by what was measured.
"""
from __future__ import annotations

import math
from collections import defaultdict
from typing import Iterable, NamedTuple, Optional

from kilohertz import Kilohertz
from series import least_time, read_sweep, timed
from step import Bench, Ensembles
from tables import markdown, read
from tables.markdown import row

PROBLEMS = {"codim2": "chaos", "crossings": "crossings",
            "stickslip": "stickslip"}
RACES = *PROBLEMS.values(), "driven"
OWN = {"twofold-located": "located", "twofold-loc-dt": "located",
       "twofold-moreau": "moreau"}
LEVELS = 1e-3, 1e-6, 1e-9
WORST = 8  # times the median, at most


class Best(NamedTuple):
    """The least time [ns] of a series, and which it is."""
    time: float
    who: str

    def __str__(self) -> str:
        return "never" if self.time == math.inf else f"{us(self)} ({self.who})"


def us(best: Best) -> str:
    """The time alone."""
    return "never" if best.time == math.inf else f"{best.time / 1e3:.3g} us"


class Race:
    """Times and errors of a problem's series, of this project or of peers."""

    def __init__(self) -> None:
        self.series: dict[tuple[str, str], list[tuple[float, float]]] = \
            defaultdict(list)

    def best(self, problem: str, scheme: str, error: float) -> Best:
        """The least time to an error, of series whose name begins so."""
        found = Best(math.inf, "")
        for (where, who), runs in self.series.items():
            time = least_time(runs, error)
            if where == problem and who.startswith(scheme) and \
                    time < found.time:
                found = Best(time, who)
        return found


def own_race(sweep: str, peers: Optional[str]) -> Race:
    """The schemes of this project; under moving inputs as bench-peers has
    measured them, beside the others."""
    race = Race()
    for one in read.read_csv(peers) if peers else ():
        if one["problem"] == "driven" and one["peer"] in OWN:
            words = one["setting"].split()
            who = ",".join([OWN[one["peer"]], one["peer"], *words[:-1]])
            race.series["driven", who].append(
                (one.number("ns"), one.number("error")))
    for series in read_sweep(sweep):
        if series.real != "double" or series.part not in PROBLEMS:
            continue
        who = f"{series.scheme},{series.dial}"
        if series.dial == "order":
            who = "located,coarse tolerance"
        race.series[PROBLEMS[series.part], who] += timed(series.settings)
    return race


def peer_race(path: str) -> Race:
    """Other tools, as bench-peers has measured them; a width is a series."""
    race = Race()
    for one in read.read_csv(path):
        if one["peer"].startswith("twofold"):
            continue
        words = one["setting"].split()
        who = " ".join([one["peer"], *words[:1]] if len(words) > 1
                       else [one["peer"]])
        race.series[one["problem"], who].append(
            (one.number("ns"), one.number("error")))
    return race


def best_peers(path: str, most: int = 4) -> list[str]:
    """Peers that reach 1e-6 on all problems in the least time.

    They are ordered by the product of their times.
    """
    least: dict[str, dict[str, float]] = defaultdict(dict)
    for one in read.read_csv(path):
        if one["peer"].startswith("twofold") or one.number("error") > 1e-6:
            continue
        times = least[one["peer"]]
        times[one["problem"]] = min(one.number("ns"),
                                    times.get(one["problem"], math.inf))
    product = {peer: math.prod(times[problem]
                               for problem in RACES)
               for peer, times in least.items()
               if times.keys() >= set(RACES)}
    return sorted(product, key=product.__getitem__)[:most]


def versus(own: Race, peers: Race, problem: str, scheme: str,
           error: float, factor: float) -> str:
    """One scheme against the best peer."""
    mine = own.best(problem, scheme + ",", error)
    best = peers.best(problem, "", error)
    share = "all" if factor == 1 else "a third"
    if mine.time == math.inf:
        verdict = "not reached: no setting keeps this error"
    elif best.time == math.inf:
        verdict = "reached: no peer keeps this error"
    elif mine.time <= best.time * factor:
        verdict = "reached"
    else:
        times = mine.time / best.time
        verdict = (f"not reached: {times:.2g} of the best peer's time, "
                   f"{times / factor:.3g} times too slow")
    return row([f"`{scheme}` at {error:.0e} on `{problem}`, at most {share} "
                "of the best peer's time", mine, best, verdict])


def races(own: Race, peers: Optional[Race]) -> Iterable[str]:
    """Rows of work and precision."""
    for problem in RACES:
        for scheme, levels, factor in (("located", LEVELS, 1 / 3),
                                       ("moreau", LEVELS[:1], 1)):
            for level in levels:
                if peers:
                    yield versus(own, peers, problem, scheme, level, factor)
                    continue
                share = "all" if factor == 1 else "a third"
                yield row([f"`{scheme}` at {level:.0e} on `{problem}`, at "
                           f"most {share} of the best peer's time",
                           us(own.best(problem, scheme + ",", level)), "-",
                           "not known: no peers of this commit; `make report`"])


class Digits:
    """What float keeps, from the rows of digits.py."""

    def __init__(self, path: str) -> None:
        self.short: dict[str, list[read.Row]] = defaultdict(list)
        self.long: dict[str, list[read.Row]] = defaultdict(list)
        for one in read.read_csv(path):
            scene, _, steps = one["run"].partition("/")
            if steps:
                self.long[steps].append(one)
            else:
                self.short[scene].append(one)

    def rows(self) -> Iterable[str]:
        """Rows of the table of figures."""
        for name, runs in self.short.items():
            worst = max(runs, key=lambda one: one.number("ratio"))
            ratio, last = worst.number("ratio"), runs[-1]
            yield row([f"compensated float on `{name}` ends within 3 times "
                       "the scheme's error in double",
                       f"{last.number('ratio'):.2f} at dt = "
                       f"{last.number('dt'):.3g} s; largest {ratio:.2f} at "
                       f"{worst.number('dt'):.3g} s", 3,
                       "reached" if ratio <= 3 else
                       f"not reached: {ratio / 3:.2g} times too far"])
        for steps, runs in self.long.items():
            within = sum(one["verdict"] == "within 3" for one in runs)
            below = sum("ulp" in one["verdict"] for one in runs)
            missed = len(runs) - within
            yield row([f"compensated float over {steps} steps of 1 us, "
                       f"{len(runs)} scenes, ends within 3 times the scheme's "
                       "error in double", f"so in {within}, else below one "
                       f"ulp of a float in {below}", 3,
                       "reached" if missed == 0 else
                       f"not reached in {missed}; in {below} of these both "
                       "errors are less than a float resolves (table below)"])

    def why(self) -> Iterable[str]:
        """Runs that a float could follow and did not."""
        shorter: dict[str, read.Row] = {}
        for one in (one for runs in self.long.values() for one in runs):
            scene = one["run"].partition("/")[0]
            before, shorter[scene] = shorter.get(scene), one
            if one["verdict"] != "not reached":
                continue
            text = (f"* Compensated float on `{one['run']}` is "
                    f"{one['float compensated']} off, {one['ratio']} times the "
                    "scheme's error.")
            if before:
                grown = [one.number(name) / before.number(name)
                         for name in ("float compensated", "scheme")]
                text += (" The motion spreads what rounding F and M to floats "
                         f"begins: since `{before['run']}` that error has "
                         f"grown {grown[0]:.2g} times and the scheme's own "
                         f"{grown[1]:.2g} times.")
            yield text


class Costs:
    """Steps of the located scheme in double, from the rows of costs.py."""

    def __init__(self, path: str) -> None:
        self.runs = [one for one in read.read_csv(path)
                     if (one["real"], one["scheme"], one["build"])
                     == ("double", "located", "generic")]

    def rows(self) -> Iterable[str]:
        """Rows of the table of figures."""
        for one in self.runs:
            times = one.number("max") / one.number("median")
            yield row([f"located's worst step at most {WORST} times its "
                       f"median (`{one['part']}` in {one['steps']} steps, in "
                       f"{one['unit']})", f"{times:.1f}", WORST,
                       "reached" if times <= WORST else
                       f"not reached: {times / WORST:.2g} times too long"])

    def usual_and_longest(self, part: str) -> Optional[tuple[float, float]]:
        """Median and largest time [us] of the steps of 20 ms of a part."""
        for one in self.runs:
            if (one["part"], one["steps"], one["unit"]) == (part, "100", "ns"):
                return one.number("median") / 1e3, one.number("max") / 1e3
        return None

    def why(self, own: Race) -> Iterable[str]:
        """Where the time of the located scheme goes."""
        step = self.usual_and_longest("cycle")
        run = own.best("chaos", "located,", 1e-6).time / 1e3
        if step and run < math.inf:
            yield ("* `located` on `chaos`: at the tolerance 1e-8 and steps of "
                   f"20 ms the longest step takes {step[1]:.2g} us, a usual "
                   f"one {step[0]:.2g} us: it goes through h = g = 0. The run "
                   f"to 1e-6, in a longer step, takes {run:.2g} us in all.")
        step = self.usual_and_longest("crossings")
        run = own.best("crossings", "located,", 1e-6).time / 1e3
        if step and run < math.inf:
            yield ("* `located` on `crossings`: a step of 20 ms takes "
                   f"{step[0]:.2g} us in the median and {step[1]:.2g} us at "
                   f"most; the run to 1e-6 takes {run:.3g} us.")


def tables(sweep: str, costs: str, digits: str, steps: str, ensemble: str,
           kilohertz: str, peers: Optional[str]) -> Iterable[str]:
    """The table of figures and the reasons below it."""
    own, cost, kept = own_race(sweep, peers), Costs(costs), Digits(digits)
    bench, ensembles = Bench(steps), Ensembles(ensemble)
    located = Kilohertz(kilohertz)
    yield markdown.header(["figure", "measured", "against", "verdict"])
    yield from races(own, peer_race(peers) if peers else None)
    for part in kept, cost, located, ensembles, bench:
        yield from part.rows()
    yield "\nWhy, where a figure is not reached:\n"
    yield from cost.why(own)
    yield from located.why()
    yield ("* `moreau` on `crossings`: across a switch its error falls with "
           "the first power of dt, while a peer that locates switches has its "
           "order.")
    if peers:
        yield ("* The peers `events-dp5` and `events-rk4` are written by hand "
               "for this law alone, without solution set, rule or report, and "
               "compiled for this processor with contracted operations; the "
               "core is not, to keep its bits.")
    for part in kept, bench, ensembles:
        yield from part.why()


def peers_table(path: str) -> str:
    """Least time of each peer."""
    rows = []
    for (problem, who), runs in peer_race(path).series.items():
        rows.append([f"`{problem}`", who,
                     *(us(Best(least_time(runs, level), who))
                       for level in LEVELS), len(runs)])
    return markdown.table(["problem", "peer", "1e-3", "1e-6", "1e-9",
                           "settings"], rows)
