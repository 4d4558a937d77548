"""Lanes without the JIT: NumPy arrays."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.kernels.lane_widths import WIDTH


def address(rows):
    """Return where an array of rows is, as the functions below take it."""
    return rows


def load(rows, row):
    """Return a row."""
    return rows[row].copy()


def store(rows, row, lane):
    """Write a row of eight."""
    rows[row] = lane


def spread(number):
    """Return one number in all lanes."""
    return np.full(WIDTH, number)


def larger(a, b):
    """Return the larger of two, lane by lane."""
    return np.where(a > b, a, b)


def smaller(a, b):
    """Return the smaller of two, lane by lane."""
    return np.where(a < b, a, b)


def choose(test, a, b):
    """Return a where the test is positive, b elsewhere."""
    return np.where(test > 0.0, a, b)


def root(a):
    """Return the square root."""
    return np.sqrt(a)


def whole(a):
    """Return the largest whole number up to a."""
    return np.floor(a)


def some(test):
    """Tell whether the test is positive in some lane."""
    return bool((test > 0.0).any())


def which(test):
    """Return the lanes in which the test is positive, each a bit, the first the lowest."""
    return int(((test > 0.0) << np.arange(WIDTH)).sum())


def planes(bodies):
    """Return where each plane (n, 8) of an array (4, n, 8) is, as `gather` takes it."""
    return tuple(bodies)


def gather(plane, index, group):
    """Return the eight numbers of each body of a group in a plane, each number a lane."""
    return tuple(plane[index[group]].T.copy())


def scatter(plane, index, group, lanes):
    """Write what `gather` returns."""
    plane[index[group]] = np.array(lanes).T


def gather_four(plane, index, group, at):
    """Return four of the numbers that `gather` returns, from the at-th on."""
    return tuple(plane[index[group], at : at + 4].T.copy())


def scatter_four(plane, index, group, at, lanes):
    """Write what `gather_four` returns."""
    plane[index[group], at : at + 4] = np.array(lanes).T


def fetch(plane, index, group):
    """Have the processor bring what `gather` returns into its cache: here, nothing."""
