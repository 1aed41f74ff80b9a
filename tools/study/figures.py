"""`make figures`: the pictures of scene `chaos` in docs/figures. Each is a
function; FIGURES in the environment names some of them, QUICK takes coarser
grids and fewer samples.
"""
import math
import os
from pathlib import Path

import numpy as np
import pandas as pd
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import pictures
import table
from chaos import OFF, QUICK, Chart, branches, departure, field, fold, \
    fold_place, futures_back, rows_of, samples, stick_out, trajectory
from pictures import INK, LINE, MODES, REGIONS, SERIES, SOFT, colors, \
    pyplot

WINDOW = (0.10, 0.28), (-1.16, -0.88)  # r, omega of the regions
CORNER = 0.17  # r of the portrait
# Without a mode in the picture: BLUE, GREEN and RED are like colours of modes.
BLUE, _, GREEN, RED, SKY, PINK = SERIES[:6]


def draw(axes, x, y, **style) -> None:
    """A curve or points, of which there have to be some."""
    good = np.isfinite(np.asarray(x, float)) & np.isfinite(np.asarray(y, float))
    if not good.any():
        raise table.TableError(f"panel '{axes.get_title()}': nothing to draw")
    axes.plot(x, y, **style)


def streams(axes, x, y, u, v, **style) -> None:
    """Streamlines, each one path: streamplot has a path for each segment."""
    grid = pyplot.figure().subplots()
    grid.axis((x[0], x[-1], y[0], y[-1]))
    found = grid.streamplot(x, y, u, v, density=style.pop("density", 1),
                            minlength=style.pop("shortest", 0.1),
                            broken_streamlines=style.pop("broken", True))
    pyplot.close(grid.figure)
    lines = [[]]
    for a, b in found.lines.get_segments():
        if lines[-1] and not np.array_equal(lines[-1][-1], a):
            lines.append([])
        lines[-1] += [a, b] if not lines[-1] else [b]
    for line in map(np.array, lines):
        if len(line) < 6:
            continue
        draw(axes, *line.T, **style)
        middle = len(line) // 3
        axes.annotate("", line[middle + 1], line[middle], arrowprops={
            "arrowstyle": "-|>", "color": style["color"], "lw": 0.6})


def by_mode(axes, rows: pd.DataFrame, *names: str, scale=(1, 1, 1),
            modes=tuple(MODES), **style) -> None:
    """A motion in the colours of its modes."""
    for mode in modes:
        here = rows["mode"] == mode
        here |= here.shift(fill_value=False)  # to the row that ends it
        if here.any():
            axes.plot(*(rows[name].where(here) * by
                        for name, by in zip(names, scale)),
                      color=MODES[mode], **style)


def panels(lines: int, columns: int, size: tuple[float, float],
           keys: list[tuple[str, dict]], **more):
    """Panels below a key; `keys` are names and styles of lines."""
    figure, axes = pyplot.subplots(lines, columns, figsize=size, **more)
    figure.legend([pyplot.Line2D([], [], **style) for _, style in keys],
                  [name for name, _ in keys], loc="upper center",
                  ncols=(len(keys) + 1) // 2 if len(keys) > 5 else len(keys))
    return figure, axes


def mode_keys(*modes: str, **style) -> list[tuple[str, dict]]:
    return [(mode, {"color": MODES[mode], "lw": 2, **style}) for mode in modes]


def points(colour: str, marker: str = "o", size: float = 4) -> dict:
    return {"color": colour, "marker": marker, "ls": "", "ms": size,
            "mew": 0.8}


def fold_at(axes) -> None:
    axes.plot(*fold_place(), "o", color=INK, ms=5)
    axes.annotate("two-fold", fold_place(), (6, 6), textcoords="offset points")


def surface():
    """Slip next to h = 0 at three places, over 2 ms."""
    figure, axes = panels(1, 3, (9, 3.8), [
        *mode_keys("slip+", "slip-"), *mode_keys("stick+", lw=4)], sharey=True)
    steps = range(-4, 5)
    starts = {
        "(a) crossing": [(0.183, -1.058, -i * 2e-6 - 6e-6, 0) for i in steps],
        "(b) sliding": [(0.188, -1.059, i * 2e-6, 0) for i in steps],
        # Stick, and one after the other, off either side.
        "(c) escaping": [(0.1838, -1.016, math.copysign(OFF, i) if i else 0,
                          max(abs(i) - 1, 0) * 4e-4) for i in steps]}
    for panel, (title, motions) in zip(axes, starts.items()):
        panel.axhline(0, color=SOFT, lw=1)
        for r, omega, h, begin in motions:
            rows = trajectory(r, omega, h, 2e-3 - begin, 2e-5)
            rows = rows.assign(t=rows.t + begin)
            for modes, lw in ((("slip+", "slip-"), 1.5), (("stick+",), 4)):
                by_mode(panel, rows, "t", "h", scale=(1e3, 1e6), lw=lw,
                        modes=modes)
        panel.set(title=title, xlabel="time t [ms]", xlim=(0, 2),
                  ylim=(-16, 16))
    axes[0].set(ylabel="slip speed h [µm/s]")
    return figure


def normal():
    """The paper's figure 3: stick next to the two-fold, and the loop."""
    J1, J2 = fold()["J1"], fold()["J2"]
    figure, (left, right) = panels(1, 2, (9, 5), [
        ("(a) true stick", {"color": MODES["stick+"]}),
        ("normal form", {"color": INK, "ls": "--"}),
        ("its straight orbit", {"color": PINK, "lw": 2}),
        ("f+ tangent", {"color": MODES["slip+"]}),
        ("f\u2212 tangent", {"color": MODES["slip-"]}),
        *mode_keys("slip+", "slip-", "stick+", "stick-")])
    left.set(title=f"(a) next to the two-fold: J1 = {J1:.3f}, J2 = {J2:.3f}",
             xlabel="ξ  (1 is 0.02 rad/s in ω)", ylabel="η", xlim=(-1, 1),
             ylim=(-1, 1))
    grid = np.linspace(-1, 1, 81)
    xi, eta = np.meshgrid(grid, grid)
    chart, inside = Chart(), xi * eta > 0
    for sign, shade, name in ((1, "sliding", "S sliding"),
                              (-1, "escaping", "E escaping")):
        left.fill_between([0, sign], 0, sign, color=REGIONS[shade], lw=0)
        left.annotate(name, (0.7 * sign, 0.92 * sign), ha="center")
        left.annotate("C crossing", (-0.75 * sign, 0.92 * sign), ha="center")
    for way, style in ((chart.stick(xi, eta), {
            "color": MODES["stick+"]}), (
            np.sign(xi + eta) * np.array([J1 * xi + eta, xi + J2 * eta]),
            {"color": INK, "ls": "--", "lw": 0.8})):
        u, v = np.where(inside, way / np.hypot(*way), np.nan)
        streams(left, grid, grid, u, v, broken=False, density=0.35, **style)
    value = fold()["eigenvalues"][0] - J2
    end = np.array([value, 1]) / max(abs(value), 1)
    draw(left, *np.array([-end, end]).T, color=PINK, lw=2)
    left.axhline(0, color=MODES["slip+"])
    left.axvline(0, color=MODES["slip-"])
    right.set(title="(b) two motions from the two-fold: the thick one\n"
              "returns to it at once", xlim=(0.1815, 0.1875),
              ylim=(-1.056, -0.988), xlabel="slider displacement r [m]",
              ylabel="disc speed ω [rad/s]")
    rows = branches()
    early = stick_out()[lambda one: one.stick_time <= 0.28]
    r, omega = fold_place()
    draw(right, [r, *early.exit_r], [omega, *early.exit_omega],
         color=MODES["stick+"], lw=3)
    ends = rows[rows.end == "codim2"]
    for picked, end_t, lw in ((ends.windings == 7, 2.1, 1), (
            (ends.windings > 0) & (ends.end_r < 0.1821), 4, 3)):
        motion = trajectory(*departure(ends[picked].iloc[0]), end_t, 2e-4)
        by_mode(right, motion, "r", "omega", lw=lw)
    fold_at(right)
    return figure


def atlas():
    """The paper's figure 4: where a prescribed two-fold is a Teixeira
    singularity."""
    fine = 20 if QUICK else 200
    rows = rows_of("atlas", "chaos", "--r", f"0.0025:0.5:{fine}",
                   f"--omega=-1.4975:-0.5:{fine}")
    names = {"overlap": "(a) all of (b) to (g)", "K--_positive": "(b) K-- > 0",
             "K++_negative": "(c) K++ < 0", "J1_negative": "(d) J1 < 0",
             "J2_negative": "(e) J2 < 0", "J1J2_above_1": "(f) J1 J2 > 1",
             "k2_positive": "(g) k2 > 0; dots: κ > 0"}
    figure = pyplot.figure(figsize=(10, 6))
    axes = figure.subplot_mosaic("aabcd;aaefg")
    for (letter, panel), (name, title) in zip(axes.items(), names.items()):
        def grid(column):
            return rows.pivot(index="omega", columns="r", values=column) == 1

        holds, x, y = grid(name), sorted(set(rows.r)), sorted(set(rows.omega))
        shade = GREEN if letter == "a" else SKY
        panel.pcolormesh(x, y, holds, rasterized=True,
                         cmap=colors.ListedColormap(["white", shade]))
        if letter == "g":
            there = rows[rows.kappa_positive == 1]
            some = there[there.r.isin(x[::16]) & there.omega.isin(y[::8])]
            panel.plot(some.r, some.omega, ".", color=INK, ms=1,
                       rasterized=True)
        panel.plot(*fold_place(), "o", color=INK, ms=4)
        panel.set(title=title, xlabel="r* [m]", xticks=(0, 0.2, 0.4))
    axes["a"].annotate("figure 5", fold_place(), (6, -12),
                       textcoords="offset points")
    axes["a"].set(ylabel="prescribed ω* [rad/s]")
    return figure


def regions():
    """The paper's figure 5, top left: regions of h = 0, and stick on it."""
    figure, axes = panels(1, 1, (9, 6.4), [
        ("stick", {"color": SOFT}), ("stick that may end", {
            "color": SOFT, "ls": "--"}),
        ("stick from the two-fold", {"color": MODES["stick+"], "lw": 3}),
        ("f+ tangent", {"color": MODES["slip+"], "lw": 2}),
        ("f\u2212 tangent", {"color": MODES["slip-"], "lw": 2})])
    omega0 = field().of["omega0"]
    axes.set(title="the surface h = 0", xlim=WINDOW[0], ylim=WINDOW[1],
             xlabel="slider displacement r [m]", ylabel="disc speed ω [rad/s]")
    r = np.linspace(*WINDOW[0], 361)
    for low, high in ((WINDOW[1][0], omega0 - 1e-9),
                      (omega0 + 1e-9, WINDOW[1][1])):
        omega = np.linspace(low, high, 141)
        plus, minus, v, dz = field().surface(*np.meshgrid(r, omega))
        number = np.select([(plus < 0) & (minus > 0), (plus > 0) & (minus < 0),
                            plus > 0], [0, 1, 2], 3)
        axes.pcolormesh(r, omega, number, vmin=0, vmax=3, rasterized=True,
                        cmap=colors.ListedColormap(
                            list(REGIONS.values())))
        for which, dash, density in ((0, "-", 1), (1, "--", 1.8)):
            if (number == which).sum() > 400:
                streams(axes, r, omega, *(np.where(number == which, way, np.nan)
                                          for way in (v, dz)), color=SOFT,
                        ls=dash, lw=0.8, density=density,
                        shortest=0.05 / density)
        for slip, colour in ((plus, "slip+"), (minus, "slip-")):
            axes.contour(r, omega, slip, [0], colors=MODES[colour],
                         linewidths=2)
    draw(axes, stick_out().exit_r, stick_out().exit_omega,
         color=MODES["stick+"], lw=3)
    for name, place in (("S sliding", (0.235, -1.125)),
                        ("S sliding", (0.235, -0.905)),
                        ("C down", (0.235, -1.025)), ("C up", (0.113, -1.1))):
        axes.annotate(name, place, bbox={"fc": "white", "ec": "none"})
    axes.annotate("E escaping", (0.148, -1.017), (0.12, -1.06), arrowprops={
        "arrowstyle": "-"}, bbox={"fc": "white", "ec": "none"})
    fold_at(axes)
    return figure


def outlines(x, y, values) -> list[np.ndarray]:
    """Of where values over a grid are positive."""
    figure, axes = pyplot.subplots()
    found = axes.contourf(x, y, values, [0, np.inf]).collections[0].get_paths()
    pyplot.close(figure)
    return [way for path in found for way in path.to_polygons()]


def set_of_futures():
    """The paper's figure 5, the blocks: futures of the two-fold until they are
    back at it. They stay within 0.2 mm/s of h = 0, so v is drawn 150 times as
    far from it."""
    far, (r_low, r_high), (w_low, w_high) = 150, (0.1812, 0.188), (-1.056,
                                                                   -0.99)
    motions = []
    for start, time in futures_back():
        rows = trajectory(*start, time, 2e-4)
        ends = rows["mode"] != rows["mode"].shift(-1)
        slips = rows["mode"].str.startswith("slip")
        motions += [rows[ends | (rows.index % np.where(slips, 8, 100) == 0)],
                    pd.DataFrame([{"mode": ""}])]
    rows = pd.concat(motions)  # one path a mode
    figure, axes = panels(1, 2, (10, 5.4), [
        *mode_keys("slip+", "slip-", "stick+", "stick-"),
        ("sliding", {"color": REGIONS["sliding"], "lw": 6}),
        ("escaping", {"color": REGIONS["escaping"], "lw": 6})],
        subplot_kw={"projection": "3d", "computed_zorder": False})
    grid = np.meshgrid(np.linspace(r_low, r_high, 60),
                       np.linspace(w_low, w_high, 60))
    plus, minus, _, _ = field().surface(*grid)
    inside = {"sliding": (-plus, minus), "escaping": (plus, -minus),
              "crossing_up": (plus, minus), "crossing_down": (-plus, -minus)}

    def on(r, omega):
        return 1e3 * (omega + 1) * (1 - r)

    for panel, title, tilt, turn, order in (
            (axes[0], "(a) from above", 32, -65, ("slip-", "slip+")),
            (axes[1], "(b) from below", -18, 125, ("slip+", "slip-"))):
        for name, both in inside.items():
            for way in outlines(*grid, np.minimum(*both)):
                panel.add_collection3d(Poly3DCollection(
                    [np.column_stack([way, on(*way.T)])], zorder=2,
                    color=REGIONS[name], alpha=0.6))
        v = on(rows.r, rows.omega) + 1e3 * far * math.sqrt(2) * rows.h
        for level, modes in ((1, order[:1]), (3, (*order[1:], "stick+",
                                                  "stick-"))):
            by_mode(panel, rows.assign(v=v), "r", "omega", "v", modes=modes,
                    lw=0.8, zorder=level)
        out = stick_out()[lambda rows: rows.stick_time <= 0.36]
        panel.plot(out.exit_r, out.exit_omega, on(out.exit_r, out.exit_omega),
                   color=MODES["stick+"], lw=2, zorder=3)
        panel.plot(*fold_place(), on(*fold_place()), "o", color=INK, ms=4,
                   zorder=4)
        panel.view_init(tilt, turn)
        panel.set(title=f"{title}; h is drawn {far}-fold",
                  xlabel="r [m]", ylabel="ω [rad/s]", zlabel="v [mm/s]",
                  xlim=(r_low, r_high), ylim=(w_low, w_high), zlim=(-52, 25),
                  xticks=(0.182, 0.184, 0.186, 0.188))
    return figure


def tyre():
    """The paper's figure 8: force and moment of the tyre over the slip
    angle."""
    string = ("tyre", "chaos", "--set", "law=string", "--set", "a=1", "--set",
              "rho=0.6666666666666667")
    wide = rows_of(*string, *(word for name in ("k", "delta", "sigma")
                              for word in ("--set", f"{name}=1")), "--angle",
                   "0:90:181")
    stiff = rows_of(*string, "--set", "k=1e3", "--set", "delta=1e-3", "--set",
                    "sigma=1e-3", "--angle", "1:90:2")
    jump = rows_of("tyre", "chaos")
    figure, (left, right) = panels(1, 2, (9, 4), [
        ("force F", {"color": BLUE, "ls": "--", "lw": 2}),
        ("moment M", {"color": RED, "lw": 2}),
        ("1000 F/μ of the string, k = 1000, δ = σ = 0.001; its M is 0",
         {"color": INK, "ls": ":"})], sharex=True)
    for panel, rows, most in ((left, wide, 1), (right, jump, jump.M.max())):
        draw(panel, rows.angle, rows.F, color=BLUE, ls="--", lw=2)
        draw(panel, rows.angle, rows.M / most, color=RED, lw=2)
        panel.grid(color=LINE)
    draw(right, stiff.angle, 1e3 * stiff.F, color=INK, ls=":")
    left.set(title="(a) stretched string, k = δ = σ = a = 1",
             ylabel="F/μ [1],  M/μ [m]", xlabel="slip angle φ [degrees]",
             xticks=(0, 30, 60, 90))
    right.set(title="(b) the law that jumps", ylabel="F/μ [1],  M/(μκ) [1]",
              xlabel="slip angle φ [degrees]")
    return figure


def exits():
    """When, where and in which phase trajectories leave after the two-fold,
    where the exit is drawn at a constant rate, side by side evenly."""
    figure, ((when, where), (phase, bins)) = panels(2, 2, (9, 7.4), [
        ("exit by slip+", points(MODES["slip+"])),
        ("exit by slip\u2212", {**points(MODES["slip-"]), "mfc": "none"}),
        ("all exits", {"color": SOFT, "lw": 4}),
        ("(a) 1 \u2212 exp(\u221210 t), (d) even", {"color": INK, "ls": "--"})])
    rows = samples()[0]
    times = np.sort(rows.time)
    t = np.linspace(0, 0.5)
    draw(when, times, np.arange(1, len(times) + 1) / len(times), color=SOFT,
         lw=4)
    draw(when, t, 1 - np.exp(-10 * t), color=INK, ls="--")
    draw(where, stick_out().stick_time, stick_out().exit_r, color=INK)
    passed = rows[rows.phase.notna()]
    for mode, fill in (("slip+", MODES["slip+"]), ("slip-", "none")):
        for panel, of, column in ((where, rows[8::20], "r"),
                                  (phase, passed[::3], "phase")):
            here = of[of.side == mode]
            draw(panel, here.time, here[column], **points(MODES[mode], size=3),
                 mfc=fill, rasterized=True)
    share = np.histogram(passed.phase, np.linspace(0, 1, 11))[0] / len(passed)
    bins.bar(np.arange(0.05, 1, 0.1), share, 0.09, color=SKY, capsize=3,
             yerr=1.96 * np.sqrt(share * (1 - share) / len(passed)))
    bins.axhline(0.1, color=INK, ls="--")
    late = "time from the two-fold to the exit [s]"
    when.set(title="(a) when", xlabel=late, xlim=(0, 0.5), ylim=(0, 1),
             ylabel="share that has left")
    where.set(title="(b) where", xlabel=late, ylabel="exit at r [m]",
              xlim=(0, 0.5), ylim=(0.182, 0.186))
    phase.set(title="(c) in which phase, by the time", xlabel=late,
              xlim=(0, 0.04), ylim=(0, 1),
              ylabel="phase 1 mm behind the two-fold")
    bins.set(title="(d) in which phase, all", xlim=(0, 1), ylim=(0, 0.3),
             xlabel="phase 1 mm behind the two-fold",
             ylabel="share in a bin of 0.1")
    return figure


def returns():
    """The return map: from an exit to the first landing on the upper sliding
    region, and from there to the two-fold."""
    figure, (left, right) = panels(1, 2, (9, 5), [
        ("(a) exit by slip+", points(MODES["slip+"])),
        ("by slip\u2212", points(MODES["slip-"], "s")),
        ("sampled, with rests", points(SOFT, size=2)),
        ("r of rest", {"color": INK, "ls": "--"}),
        ("(b) 1 landing", points(SKY)), ("2 landings", points(INK, "s")),
        ("3 or more", points(PINK, "^"))])
    left.set(title="(a) from the exit to the first landing", xlim=(0, 0.4),
             ylim=(0.1816, 0.1836), ylabel="landing on upper sliding at r [m]",
             xlabel="time from the two-fold to the exit [s]")
    right.set(title="(b) from the landing to the next two-fold", yscale="log",
              xlim=(0.1816, 0.1836), ylim=(1.5, 200),
              xticks=(0.182, 0.1825, 0.183, 0.1835),
              xlabel="first landing at r [m]", ylabel="exit to return [s]")
    out, back = samples()
    both = back.merge(out[["sample", "cycle", "time"]], on=["sample", "cycle"],
                      suffixes=("", "_out")).dropna(subset="landing_r")[::2]
    rest = stick_out().exit_r.iloc[-1]
    draw(left, both.time_out, both.landing_r, **points(SOFT, size=1.5),
         rasterized=True)
    ends = branches()[lambda rows: rows.end == "codim2"]
    for mode, marker in (("slip+", "o"), ("slip-", "s")):
        here = ends[(ends["mode"] == mode) & (ends.stick_time < 0.4)]
        draw(left, here.stick_time, here.end_r, rasterized=True,
             **points(MODES[mode], marker, 2.5))
    for low, high, style in ((1, 1, points(SKY, size=2.5)),
                             (2, 2, points(INK, "s", 2.5)),
                             (3, 99, points(PINK, "^", 3))):
        here = both[both.landings.between(low, high)]
        draw(right, here.landing_r, here.time, **style, rasterized=True)
    left.axhline(rest, color=INK, ls="--")
    right.axvline(rest, color=INK, ls="--")
    return figure


def portrait():
    """Slip next to h = g = 0, where the direction of the force depends on the
    direction of slip alone."""
    kinds = {("falls in, attracts"): (True, True, INK, "o"),
             ("falls in, repels"): (True, False, INK, "x"),
             ("leaves, attracts"): (False, True, PINK, "o"),
             ("leaves, repels"): (False, False, PINK, "x")}
    figure, (left, right) = panels(1, 2, (10, 5.4), [
        *mode_keys("stick-", "stick+", lw=4),
        *((name, points(colour, marker)) for name, (_, _, colour, marker)
          in kinds.items()),
        ("turns to larger angles", {"color": LINE, "lw": 6})])
    left.set(title=f"(a) slip in the plane of (g, h), r = {CORNER} m",
             xlim=(-1, 1), ylim=(-1, 1), xlabel="rolling speed g [any unit]",
             ylabel="lateral speed h [the same]")
    right.set(title="(b) limit directions at every r", xlim=WINDOW[0],
              ylim=(-135, 225), yticks=range(-135, 226, 45),
              xlabel="slider displacement r [m]",
              ylabel="direction atan2(h, g) [degrees]")
    left.plot([-1, 0], [0, 0], color=MODES["stick-"], lw=4)
    left.plot([0, 1], [0, 0], color=MODES["stick+"], lw=4)
    grid = np.linspace(-1, 1, 80)  # without h = 0
    g, h = np.meshgrid(grid, grid)
    phi = np.arctan2(h, g)
    radial, angular = field().corner(CORNER, phi)
    u, v = (radial * np.cos(phi) - angular * np.sin(phi),
            radial * np.sin(phi) + angular * np.cos(phi))
    for half in (h > 0, h < 0):
        streams(left, grid, grid, np.where(half, u, np.nan),
                np.where(half, v, np.nan), color=SOFT, lw=0.8, density=0.7)
    edges = np.linspace(-135, 225, 721)
    r, low = np.meshgrid(np.linspace(*WINDOW[0], 91), edges[:-1] + 1e-7)
    before, after = (field().corner(r, np.radians(at))[1]
                     for at in (low, low + 0.5 - 2e-7))
    right.pcolormesh(r, low + 0.25, np.where(before > 0, 1.0, np.nan),
                     rasterized=True, cmap=colors.ListedColormap([LINE]))
    at = (before > 0) != (after > 0)
    place, angle = r[at], low[at] + 0.5 * (before / (before - after))[at]
    falls = field().corner(place, np.radians(angle))[0] < 0
    attracts = (after - before)[at] < 0
    for inward, pulls, colour, marker in kinds.values():
        here = (falls == inward) & (attracts == pulls)
        right.plot(place[here], angle[here], **points(colour, marker, 2.5),
                   rasterized=True)
        for one in np.radians(angle[here & np.isclose(place, CORNER)]):
            left.plot([0, 1.5 * math.cos(one)], [0, 1.5 * math.sin(one)],
                      color=colour, lw=2)
    right.axvline(CORNER, color=INK, ls="--")
    right.annotate("r of (a)", (CORNER, 205), (-4, 0), ha="right",
                   textcoords="offset points")
    return figure


FIGURES = {"surface": surface, "atlas": atlas, "normal": normal,
           "regions": regions, "set": set_of_futures, "tyre": tyre,
           "exits": exits, "return": returns, "portrait": portrait}


def count(_: Path, kept: Path) -> dict[str, str]:
    """Draws them; they have no table."""
    for name in os.environ.get("FIGURES", "").split() or FIGURES:
        pictures.save(FIGURES[name](), kept / f"{name}.svg")
    return {}
