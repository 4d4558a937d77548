"""Grid: points that fill a box evenly, where fields are looked at."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs import Collider, Transform, World
from carom.ecs.column import Floats
from carom.systems.compound import bounding_radii

ACROSS = 9  # points along the longest edge
MOST = ACROSS**3
FLATTEST = 0.5  # of the longest edge: so that there is something to see around what lies flat
AROUND = 0.25  # of the box around all who are there, which is shown on each side of it


class Grid(NamedTuple):
    """Points (n, 3) in m, and how far apart they are along the longest edge."""

    points: Floats
    spacing: float


def grid(lower: Floats, upper: Floats) -> Grid:
    """Return the middles of cells, nearly cubes, of a box between two corners (3,) in m; flat ones are made thicker."""
    middle, edges = 0.5 * (lower + upper), upper - lower
    edges = np.maximum(edges, FLATTEST * edges.max())
    spacing = float(edges.max()) / ACROSS
    counts = np.maximum(np.rint(edges / spacing), 1.0)
    cells = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), axis=-1).reshape(-1, 3)
    return Grid(middle + ((cells + 0.5) / counts - 0.5) * edges, spacing)


def extent(world: World) -> tuple[Floats, Floats]:
    """Return the corners (3,) in m of a box well around all who are somewhere and have an end; of 1 m around nobody."""
    rows = world.row_numbers(Transform)
    position, reach = world[Transform].position[rows], np.zeros(len(rows))
    touched = world.table(Collider).present[rows]
    reach[touched] = bounding_radii(world, rows[touched])
    position, reach = position[np.isfinite(reach)], reach[np.isfinite(reach), None]
    if not len(position):
        return np.full(3, -0.5), np.full(3, 0.5)
    lower, upper = (position - reach).min(axis=0), (position + reach).max(axis=0)
    more = AROUND * (upper - lower) if (upper > lower).any() else 0.5
    return lower - more, upper + more
