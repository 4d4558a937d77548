"""Hulls: the polyhedra of a world in flat arrays, as kernels read them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.spatial.scalars import Vector
from carom.systems.detection.packed import Packed
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.polyhedron import Polyhedron, from_loops, hull_faces

POINT = Polyhedron([(0.0, 0.0, 0.0)], [], [], [])  # what a ball is around
SEGMENT = Polyhedron([(0.0, -1.0, 0.0), (0.0, 1.0, 0.0)], [], [], [(0, 1, -1, -1)])  # what a capsule is around
BOX = from_loops(
    [(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)],
    [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)],
)
BUILT_IN = (POINT, SEGMENT, BOX)  # in the order of the numbers kernels know them by, of unit half extent


class Hulls(NamedTuple):
    """Polyhedron p has the vertices from ``vertex_start[p]`` to ``vertex_start[p + 1]``; likewise faces and edges.

    The loop of face f are the entries from ``loop_start[f]`` on: vertices and the edges that leave them. Loops and
    edges name vertices, edges and faces from 0 in each polyhedron.
    """

    polyhedron: Integers  # of a geometry, -1 where none of a hull
    vertex_start: Integers
    face_start: Integers
    edge_start: Integers
    loop_start: Integers
    vertices: Floats
    normals: Floats
    offsets: Floats  # of the outermost vertex of all along each normal
    loop_vertex: Integers
    loop_edge: Integers
    edges: Integers


class PackedHulls(Packed[Polyhedron, Hulls]):
    """The polyhedra of a world's convex colliders."""

    shapes = (Convex,)

    def make(self, geometry: Geometry) -> Polyhedron:
        """Return the faces of a hull."""
        return hull_faces(geometry)

    def pack(self, made: dict[int, Polyhedron]) -> Hulls:
        """Return all of them, after those of carom's own shapes."""
        return pack(made)


def pack(polyhedra: dict[int, Polyhedron]) -> Hulls:
    """Return polyhedra by geometry as arrays, those of carom's own shapes first."""
    every = [*BUILT_IN, *(polyhedra[number] for number in sorted(polyhedra))]
    polyhedron = np.full(1 + max(polyhedra, default=-1), -1)
    polyhedron[sorted(polyhedra)] = np.arange(len(BUILT_IN), len(every))
    loops = [loop for one in every for loop in one.loops]
    leaving = []
    for one in every:
        edge_of = {side: number for number, (u, v, _, _) in enumerate(one.edges) for side in ((u, v), (v, u))}
        leaving += [edge_of[u, v] for loop in one.loops for u, v in zip(loop, loop[1:] + loop[:1], strict=True)]
    return Hulls(
        polyhedron,
        _starts([len(one.vertices) for one in every]),
        _starts([len(one.loops) for one in every]),
        _starts([len(one.edges) for one in every]),
        _starts([len(loop) for loop in loops]),
        np.array([vertex for one in every for vertex in one.vertices]),
        np.array([normal for one in every for normal in one.normals]),
        np.array([_outermost(one, normal) for one in every for normal in one.normals]),
        np.array([vertex for loop in loops for vertex in loop]),
        np.array(leaving),
        np.array([edge for one in every for edge in one.edges]),
    )


def _starts(counts: list[int]) -> Integers:
    return np.concatenate([[0], np.cumsum(counts)])


def _outermost(one: Polyhedron, normal: Vector) -> float:
    nx, ny, nz = normal
    return max(nx * x + ny * y + nz * z for x, y, z in one.vertices)
