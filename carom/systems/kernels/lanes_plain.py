"""Lanes without the JIT: NumPy arrays."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.systems.kernels.lane_widths import BLOCK, WIDTH


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


def gather(bodies, index, group, block):
    """Return the eight numbers of a block of each body of a group, each number a lane."""
    return tuple(bodies[index[group], BLOCK * block : BLOCK * block + BLOCK].T.copy())


def scatter(bodies, index, group, block, lanes):
    """Write what `gather` returns."""
    bodies[index[group], BLOCK * block : BLOCK * block + BLOCK] = np.array(lanes).T
