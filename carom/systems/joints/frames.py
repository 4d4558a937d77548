"""Frames of joints in the world, from one axis or two; by + - * / and sqrt alone, since they are state."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion, vector

X = (1.0, 0.0, 0.0)
OPPOSITE = 1e-9  # 1 + cosine below which two directions count as opposite: a turn about any axis across them will do


def along_axes(x: npt.ArrayLike, z: npt.ArrayLike | None = None) -> Floats:
    """Return the rotation whose x axis is along ``x`` and whose z axis is as near ``z`` as can be.

    Without ``z`` it is the shortest turn that takes x there.
    """
    if z is None:
        return shortest_turn(X, x)
    ahead = vector.normalise(x)
    across = vector.normalise(vector.cross(z, ahead))
    return quaternion.from_matrix(np.stack([ahead, across, vector.cross(ahead, across)], axis=-1))


def shortest_turn(start: npt.ArrayLike, end: npt.ArrayLike) -> Floats:
    """Return the rotation by the least angle that takes the direction of ``start`` to that of ``end``."""
    one, other = vector.normalise(start), vector.normalise(end)
    scalar = 1.0 + vector.dot(one, other)
    if scalar < OPPOSITE:
        across = vector.cross(one, (0.0, 0.0, 1.0) if abs(one[2]) < 0.9 else X)  # half a turn about it
        return np.array([*vector.normalise(across), 0.0])
    return quaternion.normalise(np.array([*vector.cross(one, other), scalar]))
