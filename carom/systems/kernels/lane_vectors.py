"""Vectors of lanes: three rows of a group, and what can be done with them."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lanes import choose, load, spread, store

TINY = 1e-300  # keeps lanes that have nothing to divide free of NaN


@woven
def three(lanes, row):
    """Return three rows."""
    return load(lanes, row), load(lanes, row + 1), load(lanes, row + 2)


@woven
def keep(lanes, row, x, y, z):
    """Write three rows."""
    store(lanes, row, x)
    store(lanes, row + 1, y)
    store(lanes, row + 2, z)


@woven
def dot(a, b):
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@woven
def plus(a, b):
    """Return a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@woven
def cross(a, b):
    """Return a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@woven
def spanned(along, t, across, u):
    """Return the vector that has these parts along two others."""
    return along * t[0] + across * u[0], along * t[1] + across * u[1], along * t[2] + across * u[2]


@woven
def minus(a, b):
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@woven
def times(s, v):
    """Return s v."""
    return s * v[0], s * v[1], s * v[2]


@woven
def about(inertia, x, y, z):
    """Return I^-1 v; ``inertia`` begins with the upper half of I^-1."""
    return (
        inertia[0] * x + inertia[1] * y + inertia[2] * z,
        inertia[1] * x + inertia[3] * y + inertia[4] * z,
        inertia[2] * x + inertia[4] * y + inertia[5] * z,
    )


@woven
def where(there, x):
    """Return a vector, or nothing where ``there`` is not more than 0."""
    zero = spread(0.0)
    return choose(there, x[0], zero), choose(there, x[1], zero), choose(there, x[2], zero)


@woven
def swung(half, x):
    """Return what a turn by twice ``half`` (rad) adds to a vector, to second order: it stays as long (Cayley)."""
    across = cross(half, x)
    return times(2.0 / (1.0 + dot(half, half)), plus(across, cross(half, across)))
