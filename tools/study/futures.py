#!/usr/bin/python3
"""A moving picture of what is not deterministic: three copies of one machine,
which start alike, each with another of the modes that are possible there. A
colour is the mode at that time, by which a future changes its colour.

    futures.py TWOFOLD OUT.svg

It moves by CSS alone, stands still at its end where the reader asks for less
motion, and its numbers are those of `twofold run`."""
import math
import subprocess
import sys
from pathlib import Path

sys.path[:0] = map(str, Path(__file__).resolve().parents[:2])
import table  # noqa: E402
from pictures import INK, LINE, SOFT  # noqa: E402
from pictures import MODES as COLOURS  # noqa: E402

# In the escaping region of h = 0; kappa so that the futures part visibly.
START = {"kappa": "1", "r": "0.3", "omega": "-1.3", "h": "0"}
T_END, DT, EVERY = 0.9, 1e-4, 150
RULES = [("slip+", "it slips one way"), ("persist", "it rolls on"),
         ("slip-", "it slips the other way")]
# Seconds of the picture: at the start, moving, at the end.
HOLD, MOVE, REST = 1.0, 4.5, 1.5
LOOP = HOLD + MOVE + REST
WIDTH, HEIGHT, RADIUS = 960, 506, 128
D, GAMMA, OMEGA0, R0 = 1.0, -3 * math.pi / 4, -1.0, 0.1
PLOT = {"left": 66, "right": 926, "top": 388, "bottom": 474}


def motion(program, rule):
    """t, r, angle of the disc, mode of each row."""
    sets = [word for name, value in START.items()
            for word in ("--set", f"{name}={value}")]
    out = subprocess.run(
        [program, "run", "chaos", "--t-end", str(T_END), "--dt", str(DT),
         "--select", rule, "--every", "10", *sets], check=True,
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    rows, angle, before = [], 0.0, None
    for number, row in table.parsed(out).iterrows():
        t, r, omega = row.t, row.r, row.omega
        if before:
            angle += (t - before[0]) * (omega + before[1]) / 2
        before = t, omega
        if number % (EVERY // 10) == 0:
            rows.append((t, r, angle, row["mode"]))
        assert number or row.choices == 3, "not one start, three futures"
    return rows


def number(x):
    text = f"{x:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def signed(mode):
    return mode.replace("-", "\u2212")


def share(t):
    return number(100 * (HOLD + MOVE * t / T_END) / LOOP)


def keyframes(name, steps, hold=False):
    """A rule, and the style of what moves by it. steps: (time, value)."""
    text = f"@keyframes {name}{{0%{{{steps[0][1]}}}"
    last = None
    for t, value in steps:
        if value != last or t == T_END:
            text += f"{share(t)}%{{{value}}}"
        last = value
    timing = "step-end" if hold else "linear"
    return (f"{text}to{{{steps[-1][1]}}}}}\n"
            f".{name}{{{steps[-1][1]};animation:{name} {LOOP}s {timing} "
            "infinite}\n")


def turned(rows, name, angle):
    return keyframes(name, [(row[0], f"transform:rotate("
                             f"{number(-math.degrees(angle(row)))}deg)")
                            for row in rows])


def style(number_, rows, scale, half):
    """Everything of one machine that moves."""
    text = turned(rows, f"disc{number_}", lambda row: row[2])
    text += turned(rows, f"table{number_}", lambda row: OMEGA0 * row[0])
    text += keyframes(f"slider{number_}", [
        (row[0], f"transform:translateX({number(scale * row[1])}px)")
        for row in rows])
    text += keyframes(f"spring{number_}", [
        (row[0], f"transform:scaleX({(row[1] + half) / half:.4f})")
        for row in rows])
    text += keyframes(f"mode{number_}", [
        (row[0], f"fill:{COLOURS[row[3]]}") for row in rows], hold=True)
    return text


def machine(number_, x, y, scale, size, half):
    """Turntable, disc, rail, spring, slider and wheel."""
    disc = scale * size * 1.13
    ticks = "".join(
        f"M{number(RADIUS * c)} {number(RADIUS * s)}L"
        f"{number(k * RADIUS * c)} {number(k * RADIUS * s)}"
        for i in range(36) for k in [0.88 if i % 9 == 0 else 0.95]
        for c, s in [(math.cos(i * math.pi / 18), math.sin(i * math.pi / 18))])
    rail = -scale * D
    turns = 9
    spring = f"M0 {number(rail)}" + "".join(
        f"L{number(scale * half * i / (2 * turns))} "
        f"{number(rail + (5 if i % 2 else -5))}"
        for i in range(1, 2 * turns))
    spring += f"L{number(scale * half)} {number(rail)}"
    wheel = number(math.degrees(GAMMA))
    return f"""<g transform="translate({x} {y})">
<circle r="{RADIUS}" fill="#eceae4" stroke="{LINE}"/>
<path class="table{number_}" d="{ticks}" stroke="{SOFT}" fill="none"/>
<circle r="{number(disc)}" fill="#d9dcdf" stroke="{SOFT}" stroke-width="1.3"/>
<g class="disc{number_}">
<path d="M{number(-scale * half)} {number(rail)}H{number(scale * half)}" \
stroke="#fffefb" stroke-width="7" stroke-linecap="round"/>
<path d="M0 0V{number(rail)}" stroke="{SOFT}" stroke-dasharray="3 4"/>
<g transform="translate({number(-scale * half)} 0)"><path \
class="spring{number_}" d="{spring}" stroke="{INK}" fill="none" \
vector-effect="non-scaling-stroke"/></g>
<g class="slider{number_}"><g transform="translate(0 {number(rail)})">
<rect x="-14" y="-12" width="28" height="24" rx="4" fill="#fffefb" \
stroke="{INK}"/>
<rect class="mode{number_}" x="-11" y="-4" width="22" height="8" rx="2" \
transform="rotate({wheel})"/>
</g></g></g>
<circle r="4" fill="{INK}"/>
</g>
"""


def parts(rows):
    """(mode, its rows with the one that it begins from) in the order of time.
    The mode of a row is that of the step which ends there."""
    found = []
    for before, row in zip(rows, rows[1:]):
        if not found or found[-1][0] != row[3]:
            found.append((row[3], [before]))
        found[-1][1].append(row)
    return found


def plot(motions):
    """r over time, with a point for each machine."""
    left, right = PLOT["left"], PLOT["right"]
    top, bottom = PLOT["top"], PLOT["bottom"]
    values = [row[1] for rows in motions for row in rows]
    low, high = min(values), max(values)

    def x(t):
        return left + t / T_END * (right - left)

    def y(r):
        return bottom - (r - low) / (high - low) * (bottom - top)

    text, rules = "", ""
    for tick in (0, 0.2, 0.4, 0.6, 0.8):
        text += (f'<path d="M{number(x(tick))} {top - 6}V{bottom + 6}" '
                 f'stroke="{LINE}"/><text x="{number(x(tick))}" '
                 f'y="{bottom + 22}" text-anchor="middle">{tick:g}'
                 f'{" s" if tick == 0.8 else ""}</text>')
    for tick in (0, 0.3, 0.6):
        if low < tick < high:
            text += (f'<text x="{left - 8}" y="{number(y(tick) + 4)}" '
                     f'text-anchor="end">{tick:g}{" m" if tick else ""}</text>')
    text += (f'<text x="{left - 8}" y="{top - 10}" text-anchor="end" '
             f'fill="{INK}">r</text>')
    place = -math.inf  # of a number at the end of a path
    for number_, rows in sorted(enumerate(motions),
                                key=lambda item: -item[1][-1][1]):
        place = max(y(rows[-1][1]) + 4, place + 13)
        for mode, part in parts(rows):
            path = "M" + "L".join(f"{number(x(row[0]))} {number(y(row[1]))}"
                                  for row in part)
            text += (f'<path d="{path}" stroke="{COLOURS[mode]}" '
                     'stroke-width="2" fill="none" stroke-linejoin="round"/>')
        text += (f'<text x="{right + 8}" y="{number(place)}" '
                 f'fill="{INK}">{number_ + 1}</text><g class="point{number_}">'
                 f'<circle class="mode{number_}" r="5" stroke="#fffefb" '
                 'stroke-width="1.5"/></g>')
        rules += keyframes(f"point{number_}", [
            (row[0], f"transform:translate({number(x(row[0]))}px,"
                     f"{number(y(row[1]))}px)") for row in rows])
    return text, rules


def main(program, out):
    motions = [motion(program, rule) for rule, _ in RULES]
    most = max(abs(row[1]) for rows in motions for row in rows)
    size = math.hypot(D, most)
    scale = RADIUS / (1.32 * size)
    half = math.sqrt((1.13 * size) ** 2 - D ** 2) * 0.96
    graph, rules = plot(motions)
    rules += "".join(style(i, rows, scale, half)
                     for i, rows in enumerate(motions))
    drawings = ""
    for i, (_, words) in enumerate(RULES):
        x = 166 + 314 * i
        name = signed(motions[i][1][3])
        drawings += machine(i, x, 222, scale, size, half)
        drawings += (f'<text x="{x}" y="72" text-anchor="middle" '
                     f'fill="{INK}" font-weight="600">{i + 1}  {name}<tspan '
                     f'font-weight="400" dx="8">{words}</tspan></text>')
    modes = {row[3] for rows in motions for row in rows}
    keys = "".join(
        f'<rect x="{x}" y="362" width="22" height="8" rx="2" fill="{colour}"/>'
        f'<text x="{x + 28}" y="370" font-size="12">'
        f'{signed(mode)}</text>'
        for x, (mode, colour) in zip(range(640, 960, 74), (
            item for item in COLOURS.items() if item[0] in modes)))
    text = f"""<svg xmlns="http://www.w3.org/2000/svg" \
viewBox="0 0 {WIDTH} {HEIGHT}" font-family="system-ui,'Segoe UI','DejaVu Sans',\
sans-serif" font-size="14" fill="{SOFT}" role="img">
<title>The same start, three futures</title>
<style>
{rules}@media (prefers-reduced-motion:reduce){{*{{animation:none!important}}}}
</style>
<rect width="{WIDTH}" height="{HEIGHT}" rx="10" fill="#fffefb"/>
<text x="24" y="36" font-size="18" font-weight="600" fill="{INK}">The same \
start, three futures<tspan font-size="14" font-weight="400" fill="{SOFT}" \
dx="14">\
r = {START["r"]} m, ω = \u22121.3 rad/s, h = 0, κ = {START["kappa"]} m; \
{MOVE / T_END:g} times slower</tspan></text>
{drawings}{graph}{keys}
</svg>
"""
    with open(out, "w", encoding="utf-8") as file:
        file.write(text)


main(*sys.argv[1:])
