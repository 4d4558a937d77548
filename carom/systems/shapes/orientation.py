"""The one place where axes and quaternions change between carom (axis y, xyzw) and FCL and trimesh (axis z, wxyz)."""

from __future__ import annotations

import math

import numpy as np

from carom.ecs.column import Floats

HALF_TURN = math.sqrt(0.5)
Z_TO_Y = (-HALF_TURN, 0.0, 0.0, HALF_TURN)  # the rotation by -90 degrees about x takes +z to +y


def along_y(vertices: Floats) -> Floats:
    """Turn vertices (n, 3) of a shape along z so that it lies along y."""
    return np.ascontiguousarray(np.stack([vertices[:, 0], vertices[:, 2], -vertices[:, 1]], axis=1))


def wxyz_from_xyzw(rotation: Floats) -> Floats:
    """Reorder a quaternion for FCL and trimesh."""
    return np.array([rotation[3], rotation[0], rotation[1], rotation[2]])
