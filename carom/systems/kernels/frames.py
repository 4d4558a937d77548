"""Directions and places given in the frame of a row, in the world and back."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.spatial import turn


@inlined
def turned(rotation, row, x, y, z):
    """Return a direction of the row's frame in the world."""
    return turn(rotation[row, 0], rotation[row, 1], rotation[row, 2], rotation[row, 3], x, y, z)


@inlined
def turned_back(rotation, row, x, y, z):
    """Return a direction of the world in the row's frame."""
    return turn(-rotation[row, 0], -rotation[row, 1], -rotation[row, 2], rotation[row, 3], x, y, z)


@inlined
def placed(position, rotation, row, x, y, z):
    """Return a place of the row's frame in the world."""
    x, y, z = turned(rotation, row, x, y, z)
    return position[row, 0] + x, position[row, 1] + y, position[row, 2] + z
