"""Arguments that the module twofold refuses: each argument of each public
function and method, with each kind of bad value. Run by in_python.py, where the
module is installed."""
import ctypes
import math
import pickle
from fractions import Fraction

import numpy as np

import twofold

HUGE = 10 ** 400
# What is of another type, by what is asked for.
NO_NUMBER = (True, np.bool_(True), "1", b"1", 1j, [1.0], np.ones(2), {})
NO_INTEGER = (*NO_NUMBER, 2.0, 2.5, math.nan, math.inf, np.float64(3),
              Fraction(5, 2), np.array([1, 2]))
NO_WORD = (0, True, 1.5, b"chaos", ["chaos"], np.arange(2))
NO_COLUMN = (True, [True, False], "1", ["1", "2"], 1j, [1j, 2], [None, 1.0],
             [[1.0], [1.0, 2.0]], {}, [HUGE, 1])
BAD_SHAPE = (np.ones((2, 2)), np.ones((1, 3)), np.ones((3, 1)), np.ones(0), [],
             np.ones(2))


def integer(low, high):
    """Bad values of an integer in a range."""
    return ([(value, TypeError) for value in (None, *NO_INTEGER)]
            + [(value, ValueError)
               for value in (low - 1, -5, high + 1, 2 ** 64, HUGE, -HUGE,
                             np.int64(-5))])


def number(low, high):
    """Bad values of a real number in a range."""
    return ([(value, TypeError) for value in NO_NUMBER]
            + [(value, ValueError)
               for value in (math.nan, math.inf, -math.inf, low * 1.001 - 1e-3,
                             high * 1.001 + 1e-3, HUGE, -HUGE,
                             np.float64("nan"), Fraction(HUGE))])


def column(low, high):
    """Bad values of a column of real numbers; the others have 3."""
    return ([(value, TypeError) for value in (None, *NO_COLUMN)]
            + [(value, ValueError) for value in BAD_SHAPE]
            + [([0.1, bad, 0.2], ValueError)
               for bad in (math.nan, math.inf, 2 * low, 2 * high)]
            + [(math.nan, ValueError), (2 * high, ValueError)])


SEEDS = ([(value, TypeError) for value in (*NO_COLUMN, 1.0, 2.5, np.ones(3))]
         + [(value.astype(int) if isinstance(value, np.ndarray) else
             np.array(value, int), ValueError) for value in BAD_SHAPE]
         + [(value, ValueError) for value in (-1, 2 ** 32, [0, 1, -1],
                                              [0, 1, 2 ** 32])])
WORD = ([(value, TypeError) for value in NO_WORD]
        + [(value, ValueError) for value in ("", "half", "CHAOS", "chaos ")])
FLAG = [(value, TypeError) for value in (0, 1, 0.0, "yes", [], np.ones(1))]
SEED = integer(0, 2 ** 32 - 1)
PLACE = number(-1e9, 1e9)
COLUMN = column(-1e9, 1e9)
# None says that neither v nor h is given.
WITHOUT_NONE = [pair for pair in COLUMN if pair[0] is not None]


def raises(kind, words, call, *arguments, **named):
    """Whether a call raises this kind of error, which has the words."""
    try:
        call(*arguments, **named)
    except (TypeError, ValueError) as error:
        # Those of ctypes are other classes, or say nothing.
        assert type(error) is kind, (words, arguments, named, repr(error))
        assert words in str(error), (words, arguments, named, str(error))
    else:
        raise AssertionError(f"accepted: {words} {arguments} {named}")


def altered(machine, name, value):
    """Inputs that were altered after they were made."""
    inputs = machine.input()
    setattr(inputs, name, value)
    return inputs


def table(real):
    """Rows: name of a callable, it, arguments that it accepts, and by the name
    of an argument its bad values."""
    machine = twofold.Machine(real=real)
    other = twofold.Machine(real="float" if real == "double" else "double")
    ensemble = twofold.Ensemble(machine, r=[0.1, 0.2, 0.3], omega=-1, v=0)
    inputs = ([(value, TypeError) for value in
               (1, b"u", (), [0.0] * 5, other.input(), ctypes.c_int(1))]
              + [(altered(machine, name, value), ValueError)
                 for name in twofold.INPUTS
                 for value in (math.nan, math.inf, -2e9)])
    three = {"r": [0.1, 0.2, 0.3], "omega": [-1, -1.0, -1]}
    return machine, ensemble, (
        ("Machine", twofold.Machine, {"real": real},
         {"scene": WORD, "real": [(None, TypeError), *WORD], "law": WORD,
          "rule": WORD, "rest": WORD, "with_angle": FLAG, "seed": SEED,
          **dict.fromkeys(("r", "v", "omega", "h", "phi"), PLACE),
          **{name: number(low, high) for name, (_, low, high) in
             twofold.parameters().items()}}),
        ("Machine.place", machine.place, {"r": 0.1, "omega": -1, "v": 0},
         {"r": [(None, TypeError), *PLACE],
          "omega": [(None, TypeError), *PLACE], "v": PLACE}),
        ("Machine.place", machine.place, {"r": 0.1, "omega": -1, "h": 0},
         {"h": PLACE}),
        ("Machine.input", machine.input, {},
         {name: [(None, TypeError), *PLACE] for name in twofold.INPUTS}),
        ("Machine.run", machine.run, {"t_end": 1e-3},
         {"t_end": number(0, 2 ** 53 * machine["dt"]),
          "every": integer(1, 2 ** 53),
          "scheme": WORD, "inputs": inputs}),
        ("Machine.run", machine.run,
         {"t_end": 1e-3, "inputs": {"t": [0], "force": [0]}, "between": "held"},
         {"between": WORD, "inputs": [
             *((value, TypeError) for value in (None, 1, np.ones(3))),
             *(({"t": [0], "force": value}, kind)
               for value, kind in COLUMN if value is not BAD_SHAPE[-1]),
             ({"force": [0]}, ValueError), ({"t": [0, -1]}, ValueError)]}),
        ("Machine.step", machine.step, {},
         {"steps": integer(1, 2 ** 53), "scheme": WORD, "inputs": inputs}),
        ("Machine.futures", machine.futures, {},
         {"scheme": WORD, "inputs": inputs}),
        ("Machine.regions", machine.regions, {"r": 0.1, "omega": -1},
         dict.fromkeys(("r", "omega"), [pair for pair in COLUMN if
                                        pair[0] is not BAD_SHAPE[-1]])),
        ("Ensemble", twofold.Ensemble, {"machine": machine, **three, "v": 0},
         {"machine": [(value, TypeError) for value in
                      (None, "chaos", 1, twofold.Machine, machine._motion)],
          "r": COLUMN, "omega": COLUMN, "v": WITHOUT_NONE, "seed": SEEDS}),
        ("Ensemble", twofold.Ensemble, {"machine": machine, **three, "h": 0},
         {"h": WITHOUT_NONE}),
        ("Ensemble.step", ensemble.step, {},
         {"steps": integer(0, 2 ** 53), "inputs": inputs}),
    )


def bits(machine, ensemble):
    """All that a refused call must leave as it is."""
    return (bytes(machine._motion), bytes(machine._params),
            ensemble.states.tobytes(), ensemble.reports.tobytes())


def judge(real):
    """Every row; how many bad values are refused."""
    count = 0
    machine, ensemble, rows = table(real)
    before = bits(machine, ensemble)
    for _, call, good, bad in rows:
        for name, values in bad.items():
            for value, kind in values:
                raises(kind, name, call, **{**good, name: value})
                count += 1
    assert bits(machine, ensemble) == before
    for key, kind in ((0, TypeError), (None, TypeError), ("x", ValueError)):
        raises(kind, "name of a parameter", machine.__getitem__, key)
        raises(kind, "name of a quantity", ensemble.__getitem__, key)
    raises(TypeError, "name of a parameter", twofold.Machine, mass=1)
    # What the law that is asked for needs, and the scene does not give.
    raises(ValueError, "epsilon = 0.0 must lie in", twofold.Machine,
           law="smooth")
    raises(ValueError, "name of an input", machine.input, thrust=1)
    raises(TypeError, "between", machine.run, inputs={"t": [0], "r0": [0]})
    raises(ValueError, "rows", twofold.diverge, rows="exit")
    raises(TypeError, "did you mean 'samples'?", twofold.diverge, sampels=1)
    raises(ValueError, "--samples -1", twofold.diverge, samples=-1)
    raises(ValueError, "not both", twofold.Machine, v=0, h=0)
    raises(ValueError, "did you mean 'chaos'?", twofold.Machine, "choas")
    raises(ValueError, "not law", twofold.Machine("smooth").regions, 0.1, -1)
    raises(ValueError, "needs law", twofold.simulate, "smooth", 0, 1, "located")
    raises(ValueError, "no speed v gives", twofold.Machine, gamma=0)
    for kind, hint, over, settings in (
            (ValueError, "kappa", {"kapa": 1}, {}),
            (TypeError, "omega", None, {"omga": 1}),
            (ValueError, "chaos", None, {"scene": "chaso"}),
            (TypeError, "t_end", None, {"tend": 1})):
        raises(kind, f"did you mean {hint!r}?", twofold.sweep,
               **{"over": over, **settings})
    for kind, over in (
            (TypeError, ["r"]), (TypeError, {"r": [1, None]}),
            (ValueError, {"r": np.ma.array([1, 2], mask=[0, 1])}),
            (ValueError, {"r": BAD_SHAPE[0]}), (ValueError, {"law": "jmp"}),
            (ValueError, {"mu": 1})):
        raises(kind, [*over][0], twofold.sweep, over=over, mu=2)
    for given in ({}, {"v": 0, "h": 0}):
        raises(ValueError, "either v or h", machine.place, 0.1, -1, **given)
        raises(ValueError, "either v or h", twofold.Ensemble, machine, 0.1, -1,
               **given)
    machine.seed = -1  # set later, and used by these
    raises(ValueError, "seed", machine.start)
    raises(ValueError, "seed", machine.place, 0.1, -1, 0)
    assert bits(machine, ensemble) == before
    return count


def judge_good():
    """What is taken: the ends of the ranges, and numbers of numpy."""
    machine = twofold.Machine("driven", seed=2 ** 32 - 1, with_angle=True,
                              rule="random", m=np.float32(1), mu=1)
    assert machine.state.seed == 2 ** 32 - 1
    machine.place(np.float64(0.1), Fraction(-1), v=np.int64(0))
    assert len(machine.run(t_end=0, every=2 ** 53)) == 1
    assert len(machine.run(t_end=1e-3, every=np.uint8(3),
                           inputs=machine.input(force=-3))) == 5
    many = twofold.Ensemble(machine, [0.1, 0.2], -1, v=0,
                            seed=np.array([0, 2 ** 32 - 1], "u4"))
    many.step(np.int16(2))
    many.step(0)
    assert [*many["seed"]] == [0, 2 ** 32 - 1] and [*many["tick"]] == [2, 2]
    assert len(twofold.Ensemble(machine, 0.1, -1, v=0)) == 1
    assert [len(twofold.simulate(t_end=t)) for t in (5e-5, 2.5e-4)] == [2, 4]
    rows = twofold.sweep("chaos", {
        "law": [*twofold.Law][:2], "rule": "SLIP_PLUS", "kappa": [1, -5]}, 1e-3)
    assert "refused" in repr(rows) and len(rows) == 2
    for held in (machine, many):
        same = pickle.loads(pickle.dumps(held))
        assert repr(held) == repr(same)
    assert set(twofold.scenes()) and len(twofold.parameters()) == 22


judge_good()
print(judge("double") + judge("float"), "bad values are refused")
