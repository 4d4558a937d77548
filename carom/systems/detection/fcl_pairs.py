"""FCL's answers, by guarded calls only: no crash, flipped normal or wrong depth of FCL reaches the contact table."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.scalars import turn
from carom.systems.detection.manifolds import merge_triangles, reduce_points, under_plane
from carom.systems.shapes import BY_NUMBER, Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.orientation import Z_TO_Y, wxyz_from_xyzw
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere

if TYPE_CHECKING:
    from carom.systems.detection.narrow import Points

Manifold = list[tuple[Floats, Floats, float]]  # (point, unit normal from the first to the second, depth)

MOST_CONTACTS = 32  # points FCL may return for a pair; a mesh gives one per triangle
SHALLOW = 0.1  # part of the smaller size up to which FCL's signed distance is safe to call (it may hang beyond)
NEAR = 0.01  # m, growth of two boxes together when their manifold is measured; more only to see a fast one coming
UNIT_ERROR = 1e-6  # how far the square of a normal's length may be from 1; FCL's zero normals of concentric bodies fail
LEAST_PART = 1e-9  # m, distance of FCL's two nearest points below which they give no direction
TOUCHING = 1e-7  # m, overlap below which FCL's signed distance may abort the process: measured after moving apart
CONES_APART = 5e-3  # m, likewise for two cones, whatever their overlap; nearer, FCL's normal is 3 degrees off
APART = 1e-4  # m, how far a touching pair is moved apart; FCL's nearest points are good to 1 % of it
BALLS = (Sphere, Point)
# Pairs whose collide() is exact, so that no second opinion is needed.
EXACT = {frozenset((ball, other)) for ball in BALLS for other in (Sphere, Point, Box, Capsule, Cylinder)}
EXACT.add(frozenset((Box,)))


class FclObjects(Resource):
    """FCL geometries by collider row; a cache, rebuilt whenever a row's shape differs."""

    def __init__(self) -> None:
        self.shapes: dict[int, tuple[Any, Shape]] = {}
        self.geometries: dict[tuple[Any, float], Any] = {}

    def shape(self, world: World, row: int) -> Shape:
        """Return the shape of a collider."""
        collider = world[Collider]
        key = (int(collider.shape[row]), collider.size[row].tobytes(), int(collider.geometry[row]))
        known = self.shapes.get(row)
        if known is None or known[0] != key:
            items = world[Geometries].items
            geometry = items[key[2]] if key[2] >= 0 else None
            known = (key, BY_NUMBER[key[0]].from_size(collider.size[row], geometry))
            self.shapes[row] = known
        return known[1]

    def geometry(self, shape: Shape, margin: float = 0.0) -> Any:
        """Return FCL's geometry of a shape grown by ``margin``; grown ones are made anew, since margins vary."""
        if margin > 0.0:
            return shape.fcl_geometry(margin)
        key = (id(shape), 0.0)
        if key not in self.geometries:
            self.geometries[key] = (shape, shape.fcl_geometry())
        return self.geometries[key][1]


class Side:
    """One collider of a pair: its shape and pose, and FCL's object of it."""

    def __init__(self, objects: FclObjects, world: World, row: int) -> None:
        pose = world[ColliderPose]
        self.objects, self.row = objects, row
        self.shape = objects.shape(world, row)
        self.position: Floats = pose.position[row]
        self.rotation: Floats = pose.rotation[row]

    def fcl(self, margin: float = 0.0) -> Any:
        """Return the FCL collision object, grown by ``margin`` where that is exact."""
        import fcl

        turned = quaternion.multiply(self.rotation, Z_TO_Y) if self.shape.along_z else self.rotation
        placed = fcl.Transform(wxyz_from_xyzw(turned), self.position)
        return fcl.CollisionObject(self.objects.geometry(self.shape, margin), placed)

    def local(self, point: Floats) -> tuple[float, float, float]:
        """Return a point of the world in the frame of the shape."""
        x, y, z, w = self.rotation.tolist()
        found: tuple[float, float, float] = turn(-x, -y, -z, w, *(point - self.position).tolist())
        return found

    def width(self) -> float:
        """Return the smallest edge of the shape's bounds (m)."""
        bounds = self.shape.bounds()
        return 2.0 * (min(bounds.half) + bounds.radius)


def measure_by_fcl(world: World, which: Integers, pairs: Integers, reaches: Floats, points: Points) -> int:
    """Measure the pairs ``which`` as FCL sees them; return how many points are taken."""
    objects = world[FclObjects]
    taken = 0
    for p in which.tolist():
        a, b = pairs[p].tolist()
        measured = measure(Side(objects, world, a), Side(objects, world, b), float(reaches[p]))
        points.start[p], points.count[p] = taken, len(measured)
        for feature, (place, normal, depth) in zip(
            corner_features([place for place, _, _ in measured], objects, world, a), measured, strict=True
        ):
            points.feature[taken], points.depth[taken] = feature, depth
            points.normal[taken], points.point[taken] = normal, place
            taken += 1
    return taken


def corner_features(points: list[Floats], objects: FclObjects, world: World, row: int) -> list[int]:
    """Return a number per point: the octant of the first shape it lies in, the same while the pair moves little."""
    if len(points) < 2:
        return [0] * len(points)  # a lone point is the pair itself, however the bodies roll
    taken: dict[int, int] = {}
    features = []
    side = Side(objects, world, row)
    for point in points:
        x, y, z = side.local(point)
        octant = (x > 0.0) + 2 * (y > 0.0) + 4 * (z > 0.0)
        features.append(octant + 8 * taken.get(octant, 0))
        taken[octant] = taken.get(octant, 0) + 1
    return features


def measure(a: Side, b: Side, reach: float) -> Manifold:
    """Return up to four points (point, normal from a to b, depth) of a pair nearer than ``reach``."""
    if isinstance(b.shape, Plane) or (isinstance(b.shape, Mesh) and not isinstance(a.shape, Plane)):
        return [(point, -normal, depth) for point, normal, depth in measure(b, a, reach)]
    if isinstance(a.shape, Mesh):
        return [p for p in _on_mesh(a, b, reach) if _valid(p)]
    if isinstance(a.shape, Plane):
        return [p for p in _on_plane(a, b, reach) if _valid(p)]
    if isinstance(a.shape, BALLS) or isinstance(b.shape, BALLS):
        ball = a if isinstance(a.shape, BALLS) else b
        exact = frozenset((type(a.shape), type(b.shape))) in EXACT
        if exact:  # growing a ball is exact, so that FCL also measures the gap
            points = collide(a.fcl(reach if ball is a else 0.0), b.fcl(reach if ball is b else 0.0))
            return [_on_ball(ball, p[1], p[2] - reach, ball is a) for p in points if _valid(p)]
    if isinstance(a.shape, Box) and isinstance(b.shape, Box):
        return _boxes(a, b, min(reach, NEAR)) or _boxes(a, b, reach)
    points = collide(a.fcl(), b.fcl())
    if not points:
        return _apart(a, b, reach)
    smaller = min(side.width() for side in (a, b) if not isinstance(side.shape, Point))
    if len(points) == 1 and isinstance(a.shape, Cone) and isinstance(b.shape, Cone):
        for _ in range(2):  # the signed distance may hang; the second time the normal is nearly right
            points = _parted(a, b, points[0][1] * (points[0][2] + CONES_APART)) or points
    elif len(points) == 1 and points[0][2] < TOUCHING:
        points = _touching(a, b) or points
    elif len(points) == 1 and points[0][2] < SHALLOW * smaller:
        points = _refined(a, b, points, smaller)
    return reduce_points([p for p in points if _valid(p)])


def collide(one: Any, two: Any) -> Manifold:
    """Return FCL's contacts; normals point from one to two, depth is positive."""
    import fcl

    request = fcl.CollisionRequest(num_max_contacts=MOST_CONTACTS, enable_contact=True)
    result = fcl.CollisionResult()
    fcl.collide(one, two, request, result)
    return [(np.array(c.pos), np.array(c.normal), abs(c.penetration_depth)) for c in result.contacts]


def distance_of(one: Any, two: Any, *, signed: bool) -> tuple[float, Floats, Floats]:
    """Return FCL's distance and nearest points; never with a half space or a mesh, where it crashes.

    Unless ``signed``, a pair that overlaps has distance -1; the signed one may abort where a pair barely touches.
    """
    import fcl

    request = fcl.DistanceRequest(enable_nearest_points=True, enable_signed_distance=signed)
    result = fcl.DistanceResult()
    distance = fcl.distance(one, two, request, result)
    return distance, np.array(result.nearest_points[0]), np.array(result.nearest_points[1])


def _boxes(a: Side, b: Side, reach: float) -> Manifold:
    """Measure two boxes grown by half of ``reach`` each, so that corners about to touch are points of the manifold.

    A corner moves out by more than a face: the growth of each box along the normal is taken out of the depth.
    """
    half = 0.5 * reach
    return reduce_points(
        [
            (_within(b, _within(a, place)), normal, depth - half * (_edges_along(a, normal) + _edges_along(b, normal)))
            for place, normal, depth in collide(a.fcl(half), b.fcl(half))
            if _valid((place, normal, depth))
        ]
    )


def _edges_along(side: Side, normal: Floats) -> float:
    """Return how far a box reaches out along a normal for every m that its faces do: 1 for a face, sqrt 3 at most."""
    x, y, z, w = side.rotation.tolist()
    return sum(abs(c) for c in turn(-x, -y, -z, w, *normal.tolist()))


def _within(side: Side, place: Floats) -> Floats:
    """Return the point of a box nearest to ``place``, for points that growing moved off its faces."""
    held = [min(max(x, -edge), edge) for x, edge in zip(side.local(place), side.shape.bounds().half, strict=True)]
    moved: Floats = side.position + np.array(turn(*side.rotation.tolist(), *held))
    return moved


def _apart(a: Side, b: Side, reach: float) -> Manifold:
    """Measure a pair that does not overlap by its nearest points."""
    distance, p, q = distance_of(a.fcl(), b.fcl(), signed=False)
    length = float(np.sqrt(((q - p) ** 2).sum()))
    if not LEAST_PART < distance <= reach or length <= LEAST_PART:
        return []
    return [((p + q) / 2.0, (q - p) / length, -distance)]


def _touching(a: Side, b: Side) -> Manifold:
    """Measure a pair that barely overlaps by its nearest points once moved apart along the line of its centres."""
    push = b.position - a.position
    length = float(np.sqrt((push**2).sum()))
    if length <= LEAST_PART:
        return []
    return _parted(a, b, push * (APART / length))


def _parted(a: Side, b: Side, push: Floats) -> Manifold:
    """Measure a pair that overlaps by its nearest points once the second is moved by ``push`` (m) away from it."""
    moved = b.fcl()
    moved.setTranslation(b.position + push)
    distance, p, q = distance_of(a.fcl(), moved, signed=False)
    length = float(np.sqrt(((q - p) ** 2).sum()))
    if distance <= LEAST_PART or length <= LEAST_PART:
        return []
    normal = (q - p) / length
    return [((p + q - push) / 2.0, normal, float((push * normal).sum()) - distance)]


def _refined(a: Side, b: Side, points: Manifold, smaller: float) -> Manifold:
    """Replace a portal-refinement answer, whose normal may be 30 degrees off, by that of the signed distance."""
    distance, p, q = distance_of(a.fcl(), b.fcl(), signed=True)
    length = float(np.sqrt(((p - q) ** 2).sum()))
    if -SHALLOW * smaller < distance < 0.0 and length > LEAST_PART:
        return [((p + q) / 2.0, (p - q) / length, -distance)]
    return points


def _on_plane(plane: Side, other: Side, reach: float) -> Manifold:
    """Measure against a half space moved out by ``reach``, then complete the manifold from the shape's corners."""
    shape = plane.shape
    assert isinstance(shape, Plane)
    if isinstance(other.shape, Cone):  # FCL sees cones where there are none, and wrongly deep: the corners say it all
        points, normal = [], quaternion.rotate(plane.rotation, shape.normal)
    else:
        points = collide(plane.fcl(reach), other.fcl())
        if not points:
            return []
        normal = points[0][1]
    x, y, z, w = other.rotation.tolist()
    corners, radius = other.shape.corners(turn(-x, -y, -z, w, *(-normal).tolist()))
    if len(corners) < 2:
        return [(p - normal * reach / 2.0, n, d - reach) for p, n, d in points]
    placed = other.position + quaternion.rotate(other.rotation, corners)
    origin = plane.position + shape.offset * normal
    return reduce_points(under_plane(placed, radius, normal, origin, reach))


def _on_mesh(mesh: Side, other: Side, reach: float) -> Manifold:
    """Measure against a triangle mesh; balls are grown so that they are seen before they touch."""
    grown = reach if isinstance(other.shape, BALLS) else 0.0
    points = collide(mesh.fcl(), other.fcl(grown))
    return reduce_points([_shrunk(p, grown) for p in merge_triangles(points)])


def _on_ball(ball: Side, normal: Floats, depth: float, first: bool) -> tuple[Floats, Floats, float]:
    """Place a contact midway between the surfaces as seen from a ball; FCL divides by the radii instead."""
    lever = ball.shape.bounds().radius - depth / 2.0
    return ball.position + normal * (lever if first else -lever), normal, depth


def _shrunk(point: tuple[Floats, Floats, float], margin: float) -> tuple[Floats, Floats, float]:
    """Take the growth of the second side out of a contact: its surface moves back by the margin."""
    place, normal, depth = point
    return place + normal * (margin / 2.0), normal, depth - margin


def _valid(point: tuple[Floats, Floats, float]) -> bool:
    """Tell whether a contact is finite and has a unit normal, which concentric bodies do not get from FCL."""
    place, normal, depth = point
    x, y, z = normal.tolist()
    return math.isfinite(sum(place.tolist()) + depth) and abs(x * x + y * y + z * z - 1.0) < UNIT_ERROR
