"""What stands between the tables and pictures of the report."""

HEAD = """\
# What error a microsecond buys

Made by `make bench` in {seconds} s from commit {commit}, compiler
{compiler}, `{opt} -ffp-contract=off`, on
{processor}.

Schemes: `moreau` is `tf_step` with theta = 1/2, `compensated` the same with
compensated summation, `located` is `tf_step_located`. Dials: `dt` the step
(of `located` at the tolerance 1e-8), `order` the step of `located` at a
tolerance that never splits it, `tolerance@1s`, `@100ms`, `@20ms` and `@5ms`
the tolerance of `located` at that step. The grids have random shifts, from one
seed. The time of an event is that of the end of the step in which the mode
changes; of `located`, whose switches lie inside, of the shortest step from the
same state that ends in another mode. A path that is off shifts its events, so
the figure for long runs may exceed dt. Errors are the largest of r [m], v
[m/s] and w [rad/s]. Times are those of a whole run from nothing, preparation
included, the median of up to 25 runs. A setting is *flagged* where a step was
degraded, fell back or was coarse, on *another branch* where it ends in another
mode or further off than half the way to another future, *refused* where a step
was.
"""

AFTER = """
## (f) After the two-fold

Beyond the two-fold two schemes cannot follow one path. Runs begin at the
two-fold with a kick, h uniform within 1e-3 m/s, under the rule `random` at
20/s, every run with a seed of its own; compared is the distribution of r some
time later. The distance is Kolmogorov and Smirnov's; below the band (95 %) two
samples cannot be told apart, and the true distance lies within the band of the
measured one. The reference is an ensemble of `located` at the tolerance 1e-12,
in double, with other seeds. By 0.15 s wheels have come back to h = g = 0,
where the rule draws again when and how they leave; that choice is the same in
both schemes (tf_rule_t in include/twofold/machine.h).
"""

DIGITS = """
## What float keeps

Parameters, start, step and inputs rounded to float first, so that nothing but
the step differs; errors of the end state against `located` in double at its
finest tolerance, of the laws `smooth` and `string` against the compensated
step in double at an eighth of the step. `scheme` is the error of the
compensated step in double, `ratio` that of the compensated step in float by
it, `ulp` what a float resolves at the largest number of the end state: an
error below it cannot be seen in a float, and a ratio of two such errors says
nothing. `SCENE/N` are N steps of 1 us from the scene's start; of `chaos` they
end before its two-fold, and there are no more, because from there on its path
is open.
"""

COSTS = """
## Cost of a step

Every step of a run, in `ns` (the least of 9 batches of 60 times the same step
from a saved state: caches and branch prediction warm, the copy of the state
included) and in `instructions` (callgrind). `cycle` is chaos to t = 2, with its
passages through codimension two; the tolerance is 1e-8. `specialised` is one
translation unit, the sources of one scheme inlined into one function, with the
machine as a constant; it ends in the same bits as `generic`, or its row is left
out.
"""

KILOHERTZ = """
## A step of 1 ms

Instructions of a millisecond, in the mean, and the error at the end: of
`tf_step`, of three of its steps of a third, and of `tf_step_located` at the
tolerance 1e-9 within budgets of segments (tools/bench/report/kilohertz.py, by
callgrind). The problems are those of the peers; `rolling` is the scene, which
sticks throughout and has no reference.
"""

ENSEMBLES = """\
`tf_ensemble_step` against a loop of `tf_step` over the same 256 states, in
turns in one run, both compiled with `-mavx2` (tools/bench/steps/ensemble.c):
`spread` has all phases of `chaos` in every block, `seeds` the rule `random`.
Times are ns for a step of one state; `alone` is the share of lanes that left
the common path.
"""

PEERS = """\
From `make bench-peers` on the same machine ({stamp}): the least time at which
a peer keeps an error, the next two finer settings included. A smoothed law is
there once for every width (eps). All settings are in the picture above. In
`driven` the turntable is accelerated from -1 to 1 rad/s; `rk4-smooth` is
written for a constant speed and fails there.

h = g = 0 is in no peer's model: without a rule it would leave the branch of
the reference there. So each that locates switches (`events-*`, CVODE, ARKODE,
`ode45`) is given a rule (`capture` in tools/bench/peers/model.h): within a radius it
goes there on a straight line and leaves by the stick that attracts. The radius
is sqrt(tol) / 10 in m/s; of `events-dp5` that many seconds left, of
`events-rk4` dt^2 / 10. Those on a smoothed law, Euler's rule and Siconos have
no such rule and go where their scheme takes them.
"""

NO_PEERS = """\
Left out: peers.csv has to be of this commit and compiler, and is of
{stamp}. `make report` makes both in one go.
"""

STABILITY = """\
See [STABILITY.md](STABILITY.md), made by `make stability`.
"""

NO_STABILITY = """\
Not made in this build; `make stability` writes STABILITY.md beside this.
"""
