"""Revolved: solids of revolution as polyhedra that hold just as much, for what lies below a plane."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.spatial.trigonometry import sine_cosine
from carom.systems.kernels.submersion import FOUND, submerge_polyhedra

SIDES = 32  # flat sides
CAP_RINGS = 8  # from the equator of a cap to its pole
_SINE = sine_cosine(2.0 * math.pi / SIDES)[0]
#: Radius of the regular polygon of the area of a circle of radius 1.
FULL = math.sqrt(2.0 * math.pi / (SIDES * _SINE))


class Rounded(NamedTuple):
    """A polyhedron about y: vertices (v, 3), those ``lifted`` (v,) when it gets longer, outward faces (f, 3)."""

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
    turns = [sine_cosine(2.0 * math.pi * k / SIDES) for k in range(SIDES)]
    vertices = [(FULL * radius * c, height, FULL * radius * s) for radius, height, _ in rings for s, c in turns]
    lifted = [lift for _, _, lift in rings for _ in turns]
    faces = []
    for ring in range(len(rings) - 1):
        for k in range(SIDES):
            low, beside = ring * SIDES + k, ring * SIDES + (k + 1) % SIDES
            faces += [(low, low + SIDES, beside), (beside, low + SIDES, beside + SIDES)]
    for k in range(1, SIDES - 1):
        top = (len(rings) - 1) * SIDES
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
