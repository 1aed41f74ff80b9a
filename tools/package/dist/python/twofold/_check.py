"""Checks arguments before they reach the core: ctypes itself takes a bool
for a number, and an integer modulo its size."""
from __future__ import annotations

import difflib
import functools
import math
import numbers
import operator
import pickle
import zlib
from typing import Any, Callable, TypeVar, cast

import numpy as np

VERSION = "@VERSION@"
Method = TypeVar("Method", bound=Callable[..., Any])

# Largest magnitude of a state and of an input, and number of steps at once.
LIMIT = 1e9
STEPS = 2 ** 53


def refuse(name, value, low, high, unit=""):
    raise ValueError(f"{name} = {value} must lie in [{low}, {high}] {unit}"
                     .rstrip())


def integer(name, value, low, high):
    """An integer in a range; a float is refused even if it is whole."""
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {value}, not an integer")
    try:
        whole = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}, not an integer") from None
    if not low <= whole <= high:
        refuse(name, whole, low, high)
    return whole


def number(name, value, low=-math.inf, high=math.inf, unit=""):
    """A real number in a range, as a float. Without a range NaN and infinities
    pass; the core judges them."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is {value!r}, not a number")
    try:
        real = float(value)
    except OverflowError:
        real = math.inf if value > 0 else -math.inf
    if low > -math.inf and not low <= real <= high:
        refuse(name, real, low, high, unit)
    return real


def flag(name, value):
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {value!r}, not True or False")
    return bool(value)


def word(name, value, words, hints={}, error=ValueError):
    """The value, if it is one of the words. Else raises, and suggests the
    closest word, or what the closest hint stands for."""
    if not isinstance(value, str):
        raise TypeError(f"{name} is {value!r}, not a str")
    if value in words:
        return value
    close = difflib.get_close_matches(
        value, [one for one in (*words, *hints) if one != value], 1)
    raise error(f"{name} is {value!r}, not one of " + ", ".join(words)
                + "".join(f"; did you mean {hints.get(one, one)!r}?"
                          for one in close))


def member(name, value, kind):
    """A member of an enumeration, or its name, here or on the command line."""
    if isinstance(value, kind):
        return value
    if isinstance(value, str) and value in kind.__members__:
        return kind[value]
    names = {str(one): one for one in kind}
    return names[word(name, value, names)]


def column(name, values, kinds, low, high, unit=""):
    """Numbers in a range, of the given numpy kinds: one, or a 1-d array."""
    if np.ma.is_masked(values):
        raise ValueError(f"{name} has masked values")
    try:
        array = np.asarray(values)
    except ValueError:  # rows of several lengths
        raise TypeError(f"{name} is not an array of numbers") from None
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name} is of {array.dtype}, not of "
                        + ("numbers" if "f" in kinds else "integers"))
    if array.ndim > 1 or array.size == 0:
        raise ValueError(f"{name} has the shape {array.shape}, not (n,)")
    allowed = (low <= array) & (array <= high)
    if not allowed.all():
        refuse(name, array.flat[np.argmin(allowed)], low, high, unit)
    return array


def columns(given):
    """Arrays of one length; single numbers are repeated."""
    length, first = 1, None
    for name, array in given.items():
        if array.ndim and first is None:
            length, first = array.size, name
        if array.ndim and array.size != length:
            raise ValueError(f"{name} has {array.size} values, {first} has "
                             f"{length}")
    return {name: np.broadcast_to(array, length)
            for name, array in given.items()}


def alone(method: Method) -> Method:
    """Decorates a method that neither another thread nor a signal handler may
    enter while a method of the same object runs. Deleting an item and assigning
    it back are not calls, so no signal can arrive between and keep the object
    locked."""
    @functools.wraps(method)
    def entered(self, *arguments, **named):
        try:
            del self._free[0]
        except IndexError:
            raise RuntimeError(
                f"{method.__qualname__}: this object is busy, in another "
                "thread or under a signal handler; give each a copy()"
            ) from None
        try:
            return method(self, *arguments, **named)
        finally:
            self._free[:] = [None]
    return cast(Method, entered)


def packed(held, sizes):
    """A state for pickle, with a proof that it is whole. Damaged lengths make a
    pickle end at a point or run on into text: the version has no point, and the
    text is no pickle."""
    text = zlib.compress(pickle.dumps(held), 1)
    return VERSION.split("."), text, sizes, len(text), zlib.crc32(text)


def unpacked(state, sizes):
    by = ".".join(state[0]) if isinstance(state, tuple) else "an older version"
    if by != VERSION:
        raise pickle.UnpicklingError(
            f"pickled by twofold {by}, not {VERSION}")
    _, text, layout, *whole = state
    if layout != sizes:
        raise pickle.UnpicklingError("pickled by a build of another layout: "
                                     f"{layout}, not {sizes}")
    if whole != [len(text), zlib.crc32(text)]:
        raise pickle.UnpicklingError("the pickle is damaged")
    return pickle.loads(zlib.decompress(text))
