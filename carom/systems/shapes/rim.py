"""Rims: the round edges of cylinders and cones, as points."""

from __future__ import annotations

import math

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial.trigonometry import sine_cosine
from carom.ecs.spatial.vector import normalise
from carom.systems.constants import UPRIGHT

RIM_POINTS = 16  # corners that stand for each rim; the one that a half space touches first is always among them
#: Cosine and sine of the angles of those corners.
RIM_TURNS = tuple(sine_cosine(2.0 * math.pi * k / RIM_POINTS)[::-1] for k in range(RIM_POINTS))

#: Which number each corner has: any four in a row, which are solved together, are all around the rim.
RIM_NUMBERS = tuple(int(f"{k:0{RIM_POINTS.bit_length() - 1}b}"[::-1], 2) for k in range(RIM_POINTS))


def rim_points(radius: float, height: float, towards: tuple[float, float, float]) -> Floats:
    """Return points (16, 3) of the circle about y at ``height`` (m), the first being its farthest ``towards``."""
    x, _, z = towards
    across = math.sqrt(x * x + z * z)
    first, second = (x / across, z / across) if across > UPRIGHT else (1.0, 0.0)
    return np.array(
        [
            (radius * (cosine * first - sine * second), height, radius * (cosine * second + sine * first))
            for cosine, sine in RIM_TURNS
        ]
    )


def farthest_on_rim(radius: float, directions: Floats) -> Floats:
    """Return the points (n, 3) of the circle about y at height 0 farthest along directions (n, 3); x where none is."""
    return radius * normalise(directions * [1.0, 0.0, 1.0], otherwise=(1.0, 0.0, 0.0))
