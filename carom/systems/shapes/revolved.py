"""Revolved: solids of revolution as polyhedra that hold just as much, for what lies below a plane."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.spatial.trigonometry import sine_cosine
from carom.systems.kernels.submersion import FOUND, submerge_polyhedra

HALF = 24  # flat sides of each half
CAP_RINGS = 8  # from the equator of a cap to its pole
_SINE = sine_cosine(math.pi / HALF)[0]
#: Radius of the regular polygon of the area of a circle of radius 1.
FULL = math.sqrt(math.pi / (HALF * _SINE))


class Rounded(NamedTuple):
    """Half a polyhedron about y, z at least 0: vertices (v, 3), ``lifted`` (v,) as it gets longer, faces (f, 3)."""

    vertices: Floats
    lifted: Floats
    faces: Integers

    def submerged(self, stretch: Floats, lift: Floats, normal: Floats, depth: Floats) -> Floats:
        """Return what lies below planes of solids of revolution of this kind, see `Shape.submerged`."""
        found = np.empty((len(depth), FOUND))
        submerge_polyhedra(*self, True, stretch, lift, normal, depth, found)
        return found


def revolve(*rings: tuple[float, float, float]) -> Rounded:
    """Return the solid between rings (radius, height, lifted) from the lowest to the highest, the ends points or flat.

    The radii are those of the round solid; the polygons have the areas of its circles.
    """
    turns = [sine_cosine(math.pi * k / HALF) for k in range(HALF + 1)]
    vertices = [(FULL * radius * c, height, FULL * radius * s) for radius, height, _ in rings for s, c in turns]
    lifted = [lift for _, _, lift in rings for _ in turns]
    faces = []
    step, top = HALF + 1, (HALF + 1) * (len(rings) - 1)  # from a vertex to the one above, and to the highest
    for low in range(0, top, step):
        for k in range(low, low + HALF):
            faces += [(k, k + step, k + 1), (k + 1, k + step, k + 1 + step)]
    for k in range(1, HALF):
        faces += [(0, k, k + 1), (top, top + k + 1, top + k)]
    points, kept = np.array(vertices), np.array(faces)
    a, b, c = (np.column_stack([points, lifted])[kept[:, k]] for k in range(3))
    none = (a == b).all(axis=1) | (b == c).all(axis=1) | (c == a).all(axis=1)  # about a ring that is a point
    return Rounded(points, np.array(lifted), np.ascontiguousarray(kept[~none]))


def cap() -> list[tuple[float, float]]:
    """Return (radius, height) of rings from the equator to the pole of a half ball of radius 1, of its volume."""
    rings = [sine_cosine(0.5 * math.pi * k / CAP_RINGS)[::-1] for k in range(CAP_RINGS)]
    rings.append((0.0, 1.0))
    volume = 0.0
    for (r, low), (s, high) in pairwise(rings):
        volume += math.pi / 3.0 * (high - low) * (r * r + r * s + s * s)
    scale = 2.0 * math.pi / 3.0 / volume
    for _ in range(60):  # cube root
        scale = math.sqrt(math.sqrt(2.0 * math.pi / 3.0 / volume * scale))
    return [(scale * radius, scale * height) for radius, height in rings]
