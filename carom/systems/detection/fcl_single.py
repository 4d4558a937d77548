"""FCL's answers pair by pair: of triangle meshes, and of shapes that are not carom's own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from carom.ecs import ColliderPose, World
from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.scalars import turn
from carom.systems.compound import shape_at
from carom.systems.constants import LEAST_PART, PARTED, TRIANGLE_CONTACTS
from carom.systems.detection.fcl_objects import FclObjects
from carom.systems.detection.manifolds import merge_triangles, reduce_points, under_plane
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.orientation import Z_TO_Y, wxyz_from_xyzw
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere

if TYPE_CHECKING:
    from carom.systems.detection.narrow import Points

PARTINGS = 3  # each leaves about a tenth of the error of the one before
Manifold = list[tuple[Floats, Floats, float]]  # (point, unit normal from the first to the second, depth)


class Side:
    """One collider of a pair: its shape and pose, and FCL's object of it."""

    def __init__(self, world: World, row: int) -> None:
        pose = world[ColliderPose]
        self.shape = shape_at(world, row)
        self._geometry = world[FclObjects].geometry_of(world, row)
        self.position: Floats = pose.position[row]
        self.rotation: Floats = pose.rotation[row]

    def fcl(self, margin: float = 0.0, moved: Any = 0.0) -> Any:
        """Return the FCL collision object, grown by ``margin`` (m) where that is exact, and moved (m)."""
        import fcl

        turned = quaternion.multiply(self.rotation, Z_TO_Y) if self.shape.along_z else self.rotation
        placed = fcl.Transform(wxyz_from_xyzw(turned), self.position + moved)
        geometry = self.shape.fcl_geometry(margin) if margin else self._geometry
        return fcl.CollisionObject(geometry, placed)

    def local(self, vector: Floats) -> tuple[float, float, float]:
        """Return a direction of the world in the frame of the shape."""
        x, y, z, w = self.rotation.tolist()
        found: tuple[float, float, float] = turn(-x, -y, -z, w, *vector.tolist())
        return found

    def farthest(self, direction: Floats) -> Floats:
        """Return the point farthest along a direction."""
        reached: Floats = self.shape.support(np.array([self.local(direction)]))[0]
        return self.position + quaternion.rotate(self.rotation, reached)


def measure_alone(world: World, which: Integers, pairs: Integers, reaches: Floats, points: Points, taken: int) -> int:
    """Measure the pairs ``which`` one by one; return how many points are taken now."""
    for p in which.tolist():
        a, b = (Side(world, row) for row in pairs[p].tolist())
        measured = measure(a, b, float(reaches[p]))
        points.start[p], points.count[p] = taken, len(measured)
        features = corner_features([a.local(place - a.position) for place, _, _ in measured])
        for feature, (place, normal, depth) in zip(features, measured, strict=True):
            points.feature[taken], points.depth[taken] = feature, depth
            points.normal[taken], points.point[taken] = normal, place
            taken += 1
    return taken


def corner_features(places: list[tuple[float, float, float]]) -> list[int]:
    """Return a number per point: the octant of the first shape it lies in, the same while the pair moves little."""
    if len(places) < 2:
        return [0] * len(places)  # a lone point is the pair itself, however the bodies roll
    taken: dict[int, int] = {}
    features = []
    for x, y, z in places:
        octant = (x > 0.0) + 2 * (y > 0.0) + 4 * (z > 0.0)
        features.append(octant + 8 * taken.get(octant, 0))
        taken[octant] = taken.get(octant, 0) + 1
    return features


def measure(a: Side, b: Side, reach: float) -> Manifold:
    """Return up to eight points (point, normal from a to b, depth) of a pair nearer than ``reach``."""
    if isinstance(b.shape, Plane) or (isinstance(b.shape, Mesh) and not isinstance(a.shape, Plane)):
        return [(point, -normal, depth) for point, normal, depth in measure(b, a, reach)]
    if isinstance(a.shape, Mesh):
        return _on_mesh(a, b, reach)
    if isinstance(a.shape, Plane):
        return _on_plane(a, b, reach)
    return _between(a, b, reach)


def collide(one: Any, two: Any) -> Manifold:
    """Return FCL's contacts; normals point from one to two, depth is positive."""
    import fcl

    request = fcl.CollisionRequest(num_max_contacts=TRIANGLE_CONTACTS, enable_contact=True)
    result = fcl.CollisionResult()
    fcl.collide(one, two, request, result)
    return [(np.array(c.pos), np.array(c.normal), abs(c.penetration_depth)) for c in result.contacts]


def direction_apart(one: Any, two: Any) -> tuple[float, Floats]:
    """Return FCL's distance, -1 for an overlap, and the unit vector to the second; zero where they barely part.

    Never to be called with a half space or a mesh, where it crashes, nor signed, which hangs.
    """
    import fcl

    result = fcl.DistanceResult()
    distance = fcl.distance(one, two, fcl.DistanceRequest(enable_nearest_points=True), result)
    way = np.array(result.nearest_points[1]) - np.array(result.nearest_points[0])
    length = float(np.sqrt((way * way).sum()))
    return float(distance), way / length if distance > LEAST_PART and length > LEAST_PART else np.zeros(3)


def _between(a: Side, b: Side, reach: float) -> Manifold:
    """Measure two solids along the direction that parts them, by how far each reaches along it.

    That of an overlap is asked for at PARTED from one another, along FCL's normal, which may be 30 degrees off, and
    then along each answer.
    """
    points = collide(a.fcl(), b.fcl())
    if points:
        _, normal, depth = points[0]
        if not normal.any():
            normal = np.array([0.0, 1.0, 0.0])
        for _ in range(PARTINGS):
            better = direction_apart(a.fcl(), b.fcl(moved=normal * (depth + PARTED)))[1]
            if better.any():
                normal, depth = better, _overlap(a, b, better)
    else:
        distance, normal = direction_apart(a.fcl(), b.fcl())
        if distance > reach or not normal.any():
            return []
    depth = _overlap(a, b, normal)
    if -depth > reach:
        return []
    return [((a.farthest(normal) + b.farthest(-normal)) / 2.0, normal, depth)]


def _overlap(a: Side, b: Side, normal: Floats) -> float:
    """Return how far (m) two shapes overlap along a unit vector from the first to the second."""
    return float(((a.farthest(normal) - b.farthest(-normal)) * normal).sum())


def _on_plane(plane: Side, other: Side, reach: float) -> Manifold:
    """Measure against a half space moved out by ``reach``, then complete the manifold from the shape's corners."""
    shape = plane.shape
    assert isinstance(shape, Plane)
    points = collide(plane.fcl(reach), other.fcl())
    if not points:
        return []
    normal = points[0][1]
    corners, radius = other.shape.corners(other.local(-normal))
    if len(corners) < 2:
        return [(p - normal * reach / 2.0, n, d - reach) for p, n, d in points]
    placed = other.position + quaternion.rotate(other.rotation, corners)
    origin = plane.position + shape.offset * normal
    return reduce_points(under_plane(placed, radius, normal, origin, reach))


def _on_mesh(mesh: Side, other: Side, reach: float) -> Manifold:
    """Measure against a triangle mesh; balls are grown so that they are seen before they touch.

    The growth is taken out again: the surface moves back by the margin. Triangles through the middle of a body have no
    normal.
    """
    grown = reach if isinstance(other.shape, Sphere | Point) else 0.0
    points = merge_triangles([p for p in collide(mesh.fcl(), other.fcl(grown)) if p[1].any()])
    return reduce_points([(place + normal * (grown / 2.0), normal, depth - grown) for place, normal, depth in points])
