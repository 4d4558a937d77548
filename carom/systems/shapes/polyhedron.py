"""Polyhedron: the flat faces, edges and vertices of a convex body."""

from __future__ import annotations

import math
from typing import NamedTuple
from weakref import WeakKeyDictionary

from carom.ecs.errors import DeclarationError
from carom.ecs.spatial.scalars import Vector, cross
from carom.systems.constants import FACE_COARSER, FACE_COSINE, FACE_FLAT
from carom.systems.shapes.geometry import Geometry

OPTIONS = "QbB Pp Qt"  # of Qhull: scaled to a cube, silent about thin bodies, triangles only

Loop = tuple[int, ...]


class Polyhedron(NamedTuple):
    """Faces are loops of vertices, counter-clockwise from outside; an edge is (from, to, face left of it, face right).

    Left is as seen from outside, so that the cross product of the two faces' normals lies along the edge.
    """

    vertices: list[Vector]
    loops: list[Loop]
    normals: list[Vector]
    edges: list[tuple[int, int, int, int]]

    def closes(self) -> bool:
        """Tell whether the faces close a volume: one to either side of every edge, and Euler's formula.

        A face of fewer than three corners has no side, and both may hold without it.
        """
        closed = all(right >= 0 for *_, right in self.edges) and all(len(loop) > 2 for loop in self.loops)
        return closed and len(self.vertices) - len(self.edges) + len(self.loops) == 2


def from_loops(vertices: list[Vector], loops: list[Loop]) -> Polyhedron:
    """Return the polyhedron of planar faces; vertices of no face are left out."""
    used = sorted({vertex for loop in loops for vertex in loop})
    renamed = {vertex: k for k, vertex in enumerate(used)}
    kept = [vertices[vertex] for vertex in used]
    named = [tuple(renamed[vertex] for vertex in loop) for loop in loops]
    left = {side: face for face, loop in enumerate(named) for side in _sides(loop)}
    edges = [(u, v, face, left.get((v, u), -1)) for (u, v), face in left.items() if u < v or (v, u) not in left]
    return Polyhedron(kept, named, [_scaled(*_span(kept, loop)) for loop in named], edges)


_KNOWN: WeakKeyDictionary[Geometry, Polyhedron] = WeakKeyDictionary()


def hull_faces(geometry: Geometry) -> Polyhedron:
    """Return the polyhedron of a hull's vertices, all of a plane joined to one face, found once.

    Raises DeclarationError where rounding has left no faces to tell.
    """
    if geometry not in _KNOWN:
        _KNOWN[geometry] = _faces_of_hull(geometry)
    return _KNOWN[geometry]


def _faces_of_hull(geometry: Geometry) -> Polyhedron:
    """Ask Qhull again, since trimesh drops slivers and leaves gaps there."""
    from scipy.spatial import ConvexHull, KDTree

    places: list[Vector] = [(x, y, z) for x, y, z in geometry.vertices.tolist()]
    x, y, z = (math.fsum(axis) / len(places) for axis in zip(*places, strict=True))
    vertices = [(px - x, py - y, pz - z) for px, py, pz in places]
    triangles: list[Loop] = [tuple(face) for face in ConvexHull(vertices, qhull_options=OPTIONS).simplices.tolist()]
    triangles = _wound_alike(vertices, triangles)
    width = max(max(axis) - min(axis) for axis in zip(*vertices, strict=True))
    for times in FACE_COARSER:
        found = from_loops(places, _joined(vertices, triangles, FACE_FLAT * times * width))
        if found.closes():
            return found
    nearest = KDTree(places).query(places, k=2)[0][:, 1].min()
    raise DeclarationError(
        f"{geometry.source}: rounding leaves the faces of the hull in doubt, of {len(places)} corners over "
        f"{width:.3g} m, the nearest {nearest:.3g} m apart; leave out those that nearly coincide, or that lie far off"
    )


def _wound_alike(vertices: list[Vector], triangles: list[Loop]) -> list[Loop]:
    """Return the triangles all wound as the largest one is, outward; slivers come as rounding has it."""
    beside: dict[frozenset[int], list[int]] = {}
    for number, loop in enumerate(triangles):
        for side in _sides(loop):
            beside.setdefault(frozenset(side), []).append(number)
    areas = [_length(*_span(vertices, loop)) for loop in triangles]
    seed = areas.index(max(areas))
    (x, y, z), (px, py, pz) = _span(vertices, triangles[seed]), vertices[triangles[seed][0]]
    wound = {seed: triangles[seed] if x * px + y * py + z * pz > 0.0 else triangles[seed][::-1]}
    for number in (reached := [seed]):
        for u, v in _sides(wound[number]):
            for other in beside[frozenset((u, v))]:
                if other not in wound:
                    loop = triangles[other]
                    wound[other] = loop[::-1] if (u, v) in _sides(loop) else loop
                    reached.append(other)
    return [wound[number] for number in sorted(wound)]


def _joined(vertices: list[Vector], triangles: list[Loop], within: float) -> list[Loop]:
    """Return the outlines of the faces that triangles make up.

    Faces grow from the largest triangle left over neighbours whose corners lie in its plane, so that slivers join the
    face beside them instead of giving it their normal.
    """
    left = {side: number for number, loop in enumerate(triangles) for side in _sides(loop)}
    spans = [_span(vertices, loop) for loop in triangles]
    areas = [_length(*span) for span in spans]
    longest = [max(_length(*_apart(vertices[u], vertices[v])) for u, v in _sides(loop)) for loop in triangles]
    joined: set[int] = set()
    loops: list[Loop] = []
    for seed in sorted(range(len(triangles)), key=lambda number: (-areas[number], number)):
        if seed in joined:
            continue
        nx, ny, nz = _scaled(*spans[seed])
        ox, oy, oz = vertices[triangles[seed][0]]
        joined.add(seed)
        region = [seed]
        for number in region:
            for u, v in _sides(triangles[number]):
                other = left.get((v, u), seed)
                x, y, z = spans[other]
                sliver = areas[other] <= within * longest[other]
                turned = not sliver and nx * x + ny * y + nz * z < FACE_COSINE * areas[other]
                corners = (vertices[vertex] for vertex in triangles[other])
                flat = all(abs(nx * (x - ox) + ny * (y - oy) + nz * (z - oz)) <= within for x, y, z in corners)
                if other not in joined and flat and not turned:
                    joined.add(other)
                    region.append(other)
        loops.append(_outline([triangles[number] for number in region]))
    return loops


def _sides(loop: Loop) -> list[tuple[int, int]]:
    return list(zip(loop, loop[1:] + loop[:1], strict=True))


def _outline(triangles: list[Loop]) -> Loop:
    """Return the loop around triangles that share sides, from its first corner on."""
    sides = {side for loop in triangles for side in _sides(loop)}
    following = {u: v for u, v in sides if (v, u) not in sides}
    loop = [min(following, default=-1)]
    while (vertex := following.get(loop[-1], loop[0])) not in loop:
        loop.append(vertex)
    return tuple(loop)


def _span(vertices: list[Vector], loop: Loop) -> Vector:
    """Return a normal as long as twice the area of a planar loop: the sum over the fan from its first vertex."""
    x = y = z = 0.0
    for u, v in _sides(loop)[1:-1]:
        dx, dy, dz = cross(*_apart(vertices[loop[0]], vertices[u]), *_apart(vertices[loop[0]], vertices[v]))
        x, y, z = x + dx, y + dy, z + dz
    return x, y, z


def _apart(start: Vector, end: Vector) -> Vector:
    return end[0] - start[0], end[1] - start[1], end[2] - start[2]


def _length(x: float, y: float, z: float) -> float:
    return math.sqrt(x * x + y * y + z * z)


def _scaled(x: float, y: float, z: float) -> Vector:
    """Return a vector at length 1; what has no length stays zero."""
    length = _length(x, y, z) or 1.0
    return x / length, y / length, z / length
