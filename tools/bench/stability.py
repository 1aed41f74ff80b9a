"""Where the schemes are stable, and where they are accurate.

`judged`: a sweep drives one parameter or start from the mild to the extreme,
all else as in scene `chaos`. The energy balance judges every cell: a value, a
scheme and a step. The friction force acts along -grad h, so that of any motion
  dE/dt = -c2 v^2 - c1 w^2 - F h + F omega0 (r cos gamma - d sin gamma) + M w
and -F h <= 0. With |F| <= F_max, |M| <= M_max the contact has put in at most
  W_n = sum dt (F_max |omega0| |r cos gamma - d sin gamma| + M_max |w|)
up to step n, along the run's own path. No motion has E > E0 + W. A run with
E > 4 (E0 + W) has more than twice the amplitude that this allows: the scheme
created energy. Less than that is an error, not an instability. Steps that
return TF_COARSE, TF_STALLED or TF_DEGRADED admit what they gain: where E is
too large by that alone, the verdict is `told`.

`mapped`: how far a run ends from the motion, in the norm of the energy,
sqrt(E(x - y) / max(E(y), E(start))). So a spring that loses its energy is
wrong, and so is one that loses its phase. y is the end of the located step,
where that of half its step is within NEAR; where none is, the error is nan.
"""
import itertools
import sys

import numpy as np
import pandas as pd

import driven
from measure import BUILD, KEY, QUICK, REALS

sys.path.append(str(BUILD / "python"))
import twofold  # noqa: E402
from twofold import Status  # noqa: E402

SCHEMES = {"moreau-0.5": ("moreau", 0.5), "moreau-1": ("moreau", 1),
           "located": ("located", 0.5)}
STEPS = 4000  # of a cell: an instability grows by the step, not by the second
FINER = 1024  # parts of a refused step
FACTOR = 4    # of the energy
LENGTH = 0.4  # [s] of a run of the map
FIRST, HALVINGS, NEAR = 4000, 7, 1e-3  # steps of its motion
LIMIT = 1e9   # TF_STATE_LIMIT
# From the best to the worst that can be said of a cell.
VERDICTS = ("ok", "degraded", "physics", "too_long", "diverged", "told",
            "created", "bad_parameter", "touched", "non_finite")
FLAGGED = Status.COARSE, Status.STALLED, Status.DEGRADED
DTS = [10 ** (i / 2) for i in range(-12, -1)]  # [s]


def powers(low: int, count: int, per_decade: int, zero: bool = False
           ) -> np.ndarray:
    """Powers of ten; 0 before them."""
    return np.array([0.0] * zero + [10 ** (low + i / per_decade)
                                    for i in range(count - zero)])


FREE = {"law": "none", "c1": 0, "c2": 0}  # nothing takes or gives energy
# By name: the values, and the settings that one of them makes. `unit` is the
# least normal number of the real type: below 1 lie the subnormal ones.
SWEEPS = {
    **{name: (powers(*values), lambda y, unit, name=name: {name: y})
       for name, *values in (
           ("k2", -2, 16, 1, True), ("c1", -3, 14, 1, True),
           ("c2", -3, 14, 1, True), ("beta", -6, 13, 2), ("m", -9, 19, 1),
           ("d", -6, 14, 1, True), ("mu", -6, 14, 1, True),
           ("kappa", -6, 10, 1))},
    # The stiff spring without the violent start of 0.08 m of stretch.
    "k2_rest": (powers(-2, 16, 1, True), lambda y, unit: {
        "k2": y, "r0": 0.18}),
    "gamma": (np.arange(-165, 181, 15), lambda y, unit: {
        "gamma": np.radians(y)}),
    # The disc turns a little faster than the turntable, as in `chaos`.
    "omega0": (powers(-2, 14, 2, True), lambda y, unit: {
        "omega0": -y, "omega": -1.037 * y}),
    # A disc of nearly no inertia, and a slider that runs through the axis.
    "through": (powers(-3, 15, 2), lambda y, unit: {
        "beta": 1e-3, "c2": 0, "r": 0.1, "v": -y}),
    "far_r": (powers(0, 14, 2, True), lambda y, unit: {"r": y, "v": 0}),
    "far_v": (powers(0, 13, 2), lambda y, unit: {"v": y}),
    "far_w": (powers(0, 13, 2), lambda y, unit: {"omega": y, "v": 0}),
    "far": (powers(0, 14, 2, True), lambda y, unit: {
        "r": y, "v": y, "omega": y}),
    "tiny_state": (powers(-16, 24, 1, True), lambda y, unit: {
        name: share * (y * unit) for name, share in (
            ("r", 0.18), ("v", 0.02), ("omega", -1.037), ("r0", 0.1),
            ("omega0", -1))}),
    "tiny_params": (powers(-16, 24, 1, True), lambda y, unit: dict.fromkeys(
        ("mu", "k2", "c1", "c2"), y * unit)),
    # The spring against the centrifugal force: a heavy disc keeps its speed, so
    # that r grows as exp(sqrt(w^2 - k2/m) t) where the ratio is below 1.
    "centrifugal": (
        np.array([0, 1e-3, .5, .9, .99, 1, 1.01, 1.1, 2, 10, 1e3, 1e6]),
        lambda y, unit: {**FREE, "k2": 100 * y, "beta": 1000, "d": 0, "v": 0,
                         "omega": 10}),
    "smooth": (powers(-12, 15, 1), lambda y, unit: {
        "law": "smooth", "epsilon": y}),
    "string": (powers(-3, 15, 1), lambda y, unit: {
        "law": "string", "delta": 1, "sigma": 1, "a": 1, "rho": 2 / 3, "k": y}),
    "two_piece": (powers(-3, 15, 1), lambda y, unit: {
        "law": "two_piece", "k": y}),
    "conservative": (powers(-2, 16, 1, True), lambda y, unit: {
        **FREE, "k2": y}),
    "spinning": (powers(-2, 14, 2, True), lambda y, unit: {
        **FREE, "k2": 1, "omega": y, "v": 0}),
    "scenes": (np.array(list(twofold.scenes())), lambda y, unit: {"scene": y}),
}
# Of the map: the powers of ten.
MAPS = {"k2_rest": (-2, 8), "conservative": (-2, 8), "mu": (-4, 6)}


def machine_of(settings: dict, **more: object) -> twofold.Machine:
    """A machine at its start. Where no v gives the h of the scene, 0.1 m/s."""
    given = {**settings, **more}
    try:
        return twofold.Machine(**given)
    except ValueError:
        if "v" in given or abs(np.sin(given.get("gamma", 1))) > 1e-6:
            raise
        return twofold.Machine(**given, v=0.1)


def energy(k: dict, r, v, w, stretch) -> np.ndarray:
    """With k, the parameters."""
    return (k["m"] * ((v - k["d"] * w) ** 2 + (k["beta"] ** 2 + r * r) * w * w)
            + k["k2"] * stretch ** 2) / 2


def columns(rows: np.ndarray) -> list[np.ndarray]:
    """r, v and omega, wider than any real type of the core."""
    return [np.asarray(rows[name], np.longdouble)
            for name in ("r", "v", "omega")]


def largest_force(law: str, k: dict) -> tuple[float, float]:
    """|F| and |M| that a law never exceeds. String: the pressure is delta at
    most on a contact of length 2a; two_piece: the same with constants of its
    own."""
    mu = k["mu"]
    return {"none": (0, 0), "coulomb": (mu, 0),
            "string": (2 * k["a"] * k["delta"] * mu,
                       k["a"] ** 2 * k["delta"] * mu),
            "two_piece": (2 * mu, 3 * k["kappa"] * mu)}.get(
                law, (mu * 4 / 3, k["kappa"] * mu))


def put_in(law: str, k: dict, rows: np.ndarray, moves: bool) -> np.ndarray:
    """W_n of each row."""
    s, c = np.sin(np.longdouble(k["gamma"])), np.cos(np.longdouble(k["gamma"]))
    r, _, w = columns(rows)
    omega0 = k["omega0"]
    if moves:  # r (w - omega0) = g sin - h cos
        omega0 = w - (rows["g"] * s - rows["h"] * c) / np.where(r, r, 1)
    F, M = largest_force(law, k)
    power = np.abs(F * omega0 * (r * c - k["d"] * s)) + np.abs(M * w)
    return np.concatenate([[0], np.cumsum(
        k["dt"] * np.maximum(power[:-1], power[1:]))])


def of_rounding(k: dict, rows: np.ndarray, real: np.finfo) -> np.ndarray:
    """The energy of 8 roundings, the least of which is of a subnormal."""
    r, v, w, r0 = (8 * real.eps * (np.abs(x) + real.tiny)
                   for x in (*columns(rows), k["r0"]))
    return energy({**k, "d": -abs(k["d"])}, np.abs(rows["r"]), v, w, r + r0)


def admitted(E: np.ndarray, room: np.ndarray, flagged: np.ndarray
             ) -> np.ndarray:
    """How far flagged steps have led beyond the room."""
    told = np.zeros_like(E)
    for i in range(1, len(E)):
        told[i] = told[i - 1]
        if flagged[i]:
            told[i] = max(told[i], min(told[i] + E[i] - E[i - 1],
                                       E[i] - room[i]))
    return told


def leaves(machine: twofold.Machine, settings: dict, scheme: str, k: dict
           ) -> bool:
    """Whether the motion itself leaves the range of states: a refused step in
    FINER parts is refused as well, and has come near the limit, or its
    accelerations leap there within one part."""
    more = {"theta": k["theta"], "dt": max(k["dt"] / FINER, 1e-9)}
    finer = machine_of(settings, **more)
    finer.state.r, finer.state.v, finer.state.w, finer.state.mode = (
        machine.state.r, machine.state.v, machine.state.w, machine.state.mode)
    finer.state.tick = machine.state.tick * FINER
    status = finer._rows(FINER * finer["dt"], FINER, scheme, None,
                         None)[2]
    r, v, w = finer.state.r, finer.state.v, finer.state.w
    pull = k["k2"] * (k["r0"] - r) - k["c2"] * v + k["m"] * r * w * w
    turn = -k["c1"] * w - 2 * k["m"] * r * w * v + k["d"] * pull
    spin = turn / k["m"] / (k["beta"] ** 2 + r * r)
    change = abs(v) + abs(pull / k["m"] + k["d"] * spin) + abs(spin)
    return status in (Status.DIVERGED, Status.BAD_STATE) and (
        abs(r) + abs(v) + abs(w) + finer["dt"] * change > LIMIT / 100)


def cell(settings: dict, scheme: str, theta: float, dt: float
         ) -> tuple[float, str]:
    """The largest energy in units of what the machine was given, and the
    verdict."""
    try:
        machine = machine_of(settings, theta=theta, dt=dt)
        rows, _, status = machine._rows(STEPS * machine["dt"], 1, scheme,
                                        None, None)
    except ValueError:
        return 0, "bad_parameter"
    k = {name: machine[name] for name in twofold.parameters()}
    law, found = str(twofold.Law(machine._params.law)), {"ok"}
    E = energy(k, *columns(rows), np.asarray(rows["r"], np.longdouble)
               - k["r0"])
    room = E[0] + put_in(law, k, rows, "scene" in settings) + of_rounding(
        k, rows, np.finfo(machine.core.dtype))
    ends = [getattr(machine.state, name) for name in ("r", "v", "w", "mode")]
    if status < 0:
        found.add("bad_parameter" if status == Status.BAD_PARAMETER else
                  "too_long" if status == Status.STEP_TOO_LONG else
                  "physics" if leaves(machine, settings, scheme, k) else
                  "diverged")
    if ends != [rows[name][-1] for name in ("r", "v", "omega", "mode")]:
        found.add("touched")
    if not all(np.isfinite(rows[name]).all() for name in (
            "r", "v", "omega", "phi", "F", "M", "h", "g", "delassus")):
        found.add("non_finite")
    said = np.where(np.arange(len(rows)) > 0, rows["status"], 0)
    if (said == Status.DEGRADED).any():
        found.add("degraded")
    if not (E <= FACTOR * room)[1:].all():
        beyond = room + admitted(E, room, np.isin(said, FLAGGED))
        found.add("told" if (E <= FACTOR * beyond)[1:].all() else "created")
    excess = (E / room)[1:].max(initial=0)
    return float(excess), max(found, key=VERDICTS.index)


def of_value(name: str, value: object, real: str) -> dict:
    """The settings of a value of a sweep."""
    unit = float(np.finfo({"float": "f4", "double": "f8"}[real]).tiny)
    return {"real": real, **SWEEPS[name][1](value, unit)}


def cells(task: tuple[str, str, object]) -> list[list[object]]:
    """A value in a real type, under all schemes and steps."""
    real, name, value = task
    text = value if isinstance(value, str) else f"{value:.3g}"
    return [[f"{name}={text}", shown + " float" * (real == "float"),
             f"dt={dt:.3g}", *cell(of_value(name, value, real), *scheme, dt)]
            for (shown, scheme), dt in itertools.product(
                SCHEMES.items(), DTS)]


def table(rows: list[list[list[object]]]) -> pd.DataFrame:
    return pd.DataFrame(itertools.chain(*rows),
                        columns=[*KEY, "error", "verdict"])


def judged() -> pd.DataFrame:
    """Every cell. Ends the program where a promise of the core is broken."""
    found = table(driven.side_by_side(cells, [
        (real, name, value) for real in REALS
        for name, (values, _) in SWEEPS.items()
        for value in values[::4 if QUICK else 1].tolist()]))
    broken = found.verdict.isin(["non_finite", "touched"])
    if broken.any():
        sys.exit(f"a promise is broken:\n{found[broken]}")
    return found


def end_of(settings: dict, scheme: str, theta: float, tolerance: float,
           n: int) -> tuple[twofold.Machine, int]:
    """A machine behind n steps, and the largest status; -1 where one is
    refused."""
    machine = machine_of(settings, theta=theta, dt=LENGTH / n,
                         tolerance=tolerance)
    try:
        rows = machine.run(n * machine["dt"], scheme=scheme)
    except ValueError:
        return machine, -1
    return machine, rows["status"][1:].max()


def distance(k: dict, at: twofold.Machine, end: twofold.Machine, E0: float
             ) -> float:
    """Of two states in the norm of the energy."""
    x, y = at.state, end.state
    E = energy(k, y.r, y.v, y.w, y.r - k["r0"])
    return float(np.sqrt(energy(k, y.r, x.v - y.v, x.w - y.w, x.r - y.r)
                         / max(E, E0)))


def end_of_motion(settings: dict, k: dict, E0: float
                  ) -> twofold.Machine | None:
    """None where it is not found."""
    coarse, said = None, -1
    for i in range(HALVINGS + 1):
        fine, now = end_of(settings, "located", 0.5, 1e-10, FIRST << i)
        if min(said, now) >= 0 and distance(k, coarse, fine, E0) < NEAR:
            return fine
        coarse, said = fine, now
    return None


def mapped_value(task: tuple[str, float]) -> list[list[object]]:
    name, value = task
    settings = of_value(name, value, "double")
    start = machine_of(settings)
    k = {one: start[one] for one in twofold.parameters()}
    x, rows = start.state, []
    E0 = energy(k, x.r, x.v, x.w, x.r - k["r0"])
    end = end_of_motion(settings, k, E0)
    for (shown, (scheme, theta)), dt in itertools.product(
            SCHEMES.items(), DTS):
        at, said = end_of(settings, scheme, theta, 1e-8, round(LENGTH / dt))
        error = np.nan if end is None else 1 if said < 0 else \
            distance(k, at, end, E0)
        rows.append([f"map {name}={value:.3g}", shown, f"dt={dt:.3g}", error,
                     "refused" if said < 0 else Status(said).name.lower()])
    return rows


def mapped() -> pd.DataFrame:
    """What a run says and how far it ends from the motion, over its step and
    one parameter. The verdict is the worst that a step said; of a refusal the
    error is 1."""
    return table(driven.side_by_side(mapped_value, [
        (name, 10.0 ** power) for name, (low, high) in MAPS.items()
        for power in range(low, high + 1, 4 if QUICK else 1)]))
