"""Welding: the triangles of a file made into one surface, by arrays alone."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs.column import Booleans, Floats, Integers
from carom.systems.constants import NO_AREA


class Seams(NamedTuple):
    """How many edges of a surface do not join two faces, and how many join two that are turned opposite ways."""

    loose: int
    twisted: int


def weld(vertices: Floats, faces: Integers) -> tuple[Floats, Integers]:
    """Return the triangles with vertices of one place made one, and those that join no face left out.

    STL repeats each vertex for each face, glTF for each normal. Places must be equal to the last bit; the first of them
    stays, so that the order is that of the file.
    """
    used = np.zeros(len(vertices), np.bool_)
    used[faces.ravel()] = True
    places = vertices[used] + 0.0  # no -0
    order = np.lexsort((places[:, 2], places[:, 1], places[:, 0]))
    begins = np.ones(len(order), np.bool_)
    begins[1:] = (places[order[1:]] != places[order[:-1]]).any(axis=1)
    first = np.minimum.reduceat(order, np.nonzero(begins)[0])  # of each place, the vertex that comes first
    rank = np.argsort(np.argsort(first))
    number = np.zeros(len(vertices), np.int64)
    found = np.empty(len(order), np.int64)
    found[order] = rank[np.cumsum(begins) - 1]
    number[used] = found
    return places[np.sort(first)], number[faces]


def is_collapsed(faces: Integers) -> Booleans:
    """Tell for each face whether two of its corners are one vertex: leaving it out opens nothing."""
    a, b, c = faces.T
    return np.asarray((a == b) | (b == c) | (c == a))


def is_sliver(vertices: Floats, faces: Integers) -> Booleans:
    """Tell for each face whether its corners lie on a line, so that it has no area and no normal."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    longest = np.max([((b - a) ** 2).sum(axis=1), ((c - b) ** 2).sum(axis=1), ((a - c) ** 2).sum(axis=1)], axis=0)
    return np.asarray((across * across).sum(axis=1) <= (NO_AREA * longest) ** 2)


def seams(faces: Integers, count: int) -> Seams:
    """Return what keeps a surface over ``count`` vertices from being closed and turned one way all over.

    In a surface that is both, the edges from each vertex to another are as many as those back, and one each way.
    """
    start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    low, high = np.minimum(start, end), np.maximum(start, end)
    _, edge, uses = np.unique(low * count + high, return_inverse=True, return_counts=True)
    forward = np.bincount(edge, start < end, len(uses))
    return Seams(int((uses != 2).sum()), int(((uses == 2) & (forward != 1)).sum()))
