"""Which triangles of a surface meet at its edges and corners, and which of its edges stand out."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.spatial.vector import cross, dot
from carom.systems.constants import COPLANAR, NO_AREA
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.welding import weld

Edges = tuple[Integers, Integers, Integers]


class Surface(NamedTuple):
    """Triangles whose corners are shared where their places are the same.

    Edge k of a triangle runs from its corner k to the next. The neighbours of corner v, along edges, are the entries
    of ``fan`` from ``fan_start[v]`` to ``fan_start[v + 1]``: twice their numbers, and 1 where the edge is active.
    """

    vertices: Floats  # (v, 3)
    faces: Integers  # (f, 3), those without an area left out
    source: Integers  # (f,) their numbers in the geometry
    normals: Floats  # (f, 3)
    across: Integers  # (f, 3) the neighbour's corner beyond each edge, -1 where there is none
    active: Integers  # (f,) bit k: edge k is convex or a rim, so that others may touch it with another normal
    fan_start: Integers
    fan: Integers


def linked(geometry: Geometry) -> Surface:
    """Return the surface of a geometry; an edge of more than two triangles counts as the rim of each."""
    vertices, faces = weld(geometry.vertices, geometry.faces)
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    spans = cross(b - a, c - a)
    lengths = np.sqrt(dot(spans, spans))
    longest = np.maximum(np.maximum(dot(b - a, b - a), dot(c - b, c - b)), dot(a - c, a - c))
    source = np.nonzero(lengths > NO_AREA * longest)[0]
    faces, normals = faces[source], spans[source] / lengths[source, None]
    starts, ends = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    across, active = np.full(len(starts), -1), np.ones(len(starts), np.bool_)
    edges, one, other = _edges(starts, ends, len(vertices))
    across[one], across[other] = faces[:, [2, 0, 1]].ravel()[other], faces[:, [2, 0, 1]].ravel()[one]
    along = vertices[ends[one]] - vertices[starts[one]]
    along /= np.sqrt(dot(along, along))[:, None]
    m, n = normals[one // 3], normals[other // 3]
    folded = (dot(m, n) < 0.0) & (dot(cross(m, n), along) > -COPLANAR)  # back to back: a sheet's edge
    active[one] = active[other] = (dot(cross(m, n), along) > COPLANAR) | folded
    bits = active.reshape(-1, 3) @ np.array([1, 2, 4])
    return Surface(vertices, faces, source, normals, across.reshape(-1, 3), bits, *_fans(*edges, active, len(vertices)))


def _edges(starts: Integers, ends: Integers, count: int) -> tuple[Edges, Integers, Integers]:
    """Return both ends of each edge and its first directed one; and pairs of those, forth and back, with no third."""
    keys = np.minimum(starts, ends) * count + np.maximum(starts, ends)
    order = np.argsort(keys, kind="stable")
    ranked = keys[order]
    repeated = ranked[:-1] == ranked[1:]
    first = np.nonzero(repeated)[0]
    alone = np.ones(len(first), np.bool_)  # a third one makes two such neighbours in a row
    alone[1:] &= np.diff(first) > 1
    alone[:-1] &= np.diff(first) > 1
    one, other = order[first[alone]], order[first[alone] + 1]
    opposed = starts[one] == ends[other]
    distinct = order[np.concatenate([[True], ~repeated])]
    lower, upper = np.minimum(starts, ends)[distinct], np.maximum(starts, ends)[distinct]
    return (lower, upper, distinct), one[opposed], other[opposed]


def _fans(lower: Integers, upper: Integers, edges: Integers, active: Booleans, count: int) -> tuple[Integers, Integers]:
    """Return where the neighbours of each vertex start among all, and those, in order."""
    from_, to = np.concatenate([upper, lower]), np.concatenate([lower, upper])
    starts = np.zeros(count + 1, np.int64)
    np.cumsum(np.bincount(from_, minlength=count), out=starts[1:])
    order = np.argsort(from_, kind="stable")  # edges come in order of both their ends
    return starts, (2 * to + np.tile(active[edges], 2))[order]
