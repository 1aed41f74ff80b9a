#!/usr/bin/python3 -B
"""What rounding costs at small steps, and what the compensated step saves.

Columns are errors of r, v, w (the largest) against a run in double whose step
is finer: of the scheme (double, carried), of double, float and carried float;
then carried float by scheme. Runs for about three minutes.
"""
from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

import valgrind

# Problem, its length [us], the reference's step as 2^A us / B, and the steps
# of the rows as 2^C us.
PROBLEMS = (
    ("rolling", 10485760, 5, 1, (0, 3, 6, 8, 10, 12)),
    ("coulomb-slip", 10485760, 0, 2, (0, 3, 6, 8)),
    ("slip", 10485760, 0, 2, (0, 2, 3, 4, 6, 8)),
    ("frictionless", 10485760, 0, 2, (0, 3, 6, 8)),
    ("chaos", 1048576, 0, 32, (0, 2, 4, 6, 8, 10)),
    ("chaos", 1900544, 0, 16, (0, 2, 4, 6, 8, 10)),
)
RUNS = (("double", "carried"), ("double", "plain"), ("float", "plain"),
        ("float", "carried"))


class Programs:
    """The program `compensated` in both real types."""

    def __init__(self, build: Path) -> None:
        self.build = build

    def command(self, real: str, *arguments: object) -> list[str]:
        """The program and its arguments."""
        return [str(self.build / real / "tools/bench/compensated"),
                *map(str, arguments)]

    def run(self, real: str, *arguments: object) -> list[float]:
        """r, v, w, phi at the end, the largest h in stick, changes."""
        command = self.command(real, *arguments)
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True,
                              check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)} fails")
        return [float(word) for word in done.stdout.split()]

    def print_table(self, problem: str, length: int, doublings: int,
                    refinement: int, rows: tuple[int, ...]) -> None:
        """One problem, a line a step."""
        reference = self.run("double", problem, doublings, length, "carried",
                             refinement)
        print(f"\n{problem} to t = {length * 1e-6:.6g} s")
        print("     dt [s]    scheme    double     float   carried  / scheme  "
              "|h| stick")
        for step in rows:
            ends = [self.run(real, problem, step, length, way)
                    for real, way in RUNS]
            errors = [max(abs(a - b) for a, b in zip(end[:3], reference))
                      for end in ends]
            ratio = errors[3] / errors[0] if errors[0] > 0 else float("inf")
            print(f"{2 ** step * 1e-6:11.4g}"
                  + "".join(f" {error:9.1e}" for error in errors)
                  + f" {ratio:9.3g} {ends[3][4]:10.1e}", flush=True)

    def print_cost(self, real: str) -> None:
        """Mean instructions of 1000 steps, plain and carried."""
        suffix = "f64" if real == "double" else "f32"
        for problem in "rolling", "slip":
            costs = [valgrind.total(
                self.build, f"{function}_{suffix}",
                self.command(real, problem, 10, 1024000, way)) / 1000
                for way, function in (("plain", "tf_step"),
                                      ("carried", "tf_step_compensated"))]
            print(f"{real}, {problem}: {costs[0]:.0f} instructions a step "
                  f"plain, {costs[1]:.0f} carried")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="folder of the build")
    programs = Programs(parser.parse_args().build)
    print("errors of r [m], v [m/s], w [rad/s]; parameters and start as in "
          "float")
    for problem in PROBLEMS:
        programs.print_table(*problem)
    print()
    if valgrind.have():
        for real in "double", "float":
            programs.print_cost(real)
    else:
        print("instructions need valgrind: apt-get install valgrind")


if __name__ == "__main__":
    main()
