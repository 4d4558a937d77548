"""Hulls: the polyhedra of a world in flat arrays, as kernels read them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.spatial.scalars import Vector
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import Geometries
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


class PackedHulls(Resource):
    """The polyhedra of a world's convex colliders; a cache, packed anew when a geometry has become one."""

    def __init__(self) -> None:
        self.polyhedra: dict[int, Polyhedron] = {}
        self.packed = pack({})

    def holding(self, world: World) -> Hulls:
        """Return the arrays, with the geometry of every convex collider in them."""
        if not world[Geometries].items:
            return self.packed
        collider, rows = world[Collider], world.row_numbers(Collider)
        numbers = collider.geometry[rows[collider.shape[rows] == Convex.number]]
        known = len(self.packed.polyhedron)
        if len(numbers) and (numbers.max() >= known or (self.packed.polyhedron[numbers] < 0).any()):
            for number in sorted(set(numbers.tolist()) - self.polyhedra.keys()):
                self.polyhedra[number] = hull_faces(world[Geometries].items[number])
            self.packed = pack(self.polyhedra)
        return self.packed


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
