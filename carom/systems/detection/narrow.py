"""Narrow phase: one table from a pair of shapes to the function that measures it; FCL measures all other pairs."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.systems.detection.answered import Answered
from carom.systems.detection.apart import Apart
from carom.systems.detection.fcl_pairs import measure_by_fcl, near_enough
from carom.systems.detection.hulls import PackedHulls
from carom.systems.detection.meshes import PackedMeshes
from carom.systems.detection.validity import without_faulty
from carom.systems.kernels.balls_narrow import measure_balls
from carom.systems.kernels.balls_on_meshes import measure_balls_on_meshes
from carom.systems.kernels.boxes_narrow import measure_boxes
from carom.systems.kernels.capsules_narrow import measure_balls_on_capsules, measure_capsules
from carom.systems.kernels.capsules_on_boxes import measure_capsules_on_boxes
from carom.systems.kernels.collecting import collect_points, count_points
from carom.systems.kernels.crew import threads_of
from carom.systems.kernels.hulls_narrow import measure_hulls, measure_hulls_on_planes
from carom.systems.kernels.kernel import Kernel
from carom.systems.kernels.mesh_points import MOST_MESH_POINTS
from carom.systems.kernels.narrow import leave_out, sort_by_function
from carom.systems.kernels.planes_narrow import measure_boxes_on_planes, measure_capsules_on_planes
from carom.systems.kernels.reduction import MOST_POINTS
from carom.systems.kernels.rounds_on_meshes import measure_rounds_on_meshes
from carom.systems.kernels.solids_on_meshes import measure_solids_on_meshes
from carom.systems.settings import Settings
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.shape import Shape
from carom.systems.shapes.sphere import Sphere
from carom.systems.threads import crew_for

BY_FCL = 0  # the place in the table of what no function stands in for

#: Which function measures a pair; it takes the collider of the first shape first.
STAND_INS: dict[tuple[type[Shape], type[Shape]], Kernel] = {
    **{(ball, other): measure_balls for ball in (Sphere, Point) for other in (Sphere, Point, Box, Plane)},
    **{(ball, Capsule): measure_balls_on_capsules for ball in (Sphere, Point)},
    (Capsule, Capsule): measure_capsules,
    (Capsule, Box): measure_capsules_on_boxes,
    (Capsule, Plane): measure_capsules_on_planes,
    (Box, Box): measure_boxes,
    (Box, Plane): measure_boxes_on_planes,
    **{(other, Convex): measure_hulls for other in (Sphere, Point, Capsule, Box, Convex)},
    (Convex, Plane): measure_hulls_on_planes,
    **{(ball, land): measure_balls_on_meshes for ball in (Sphere, Point) for land in (Mesh, HeightField)},
    **{(solid, land): measure_solids_on_meshes for solid in (Capsule, Box, Convex) for land in (Mesh, HeightField)},
    **{(one, land): measure_rounds_on_meshes for one in (Cylinder, Cone, Ellipsoid) for land in (Mesh, HeightField)},
}

#: How many points a pair may have that a function measures; of others MOST_POINTS.
ROOM = dict.fromkeys((measure_balls_on_meshes, measure_solids_on_meshes, measure_rounds_on_meshes), MOST_MESH_POINTS)


class Found(NamedTuple):
    """Contact points in order of (row a, row b, feature); ``old`` is where in the table recycled ones were, else -1."""

    row_a: Integers
    row_b: Integers
    feature: Integers
    normal: Floats
    depth: Floats
    point: Floats
    by_fcl: Booleans
    old: Integers

    @classmethod
    def room(cls, count: int) -> Found:
        """Return room for so many, to be written."""
        return cls(
            np.empty(count, np.int64), np.empty(count, np.int64), np.empty(count, np.int64),
            np.empty((count, 3)), np.empty(count), np.empty((count, 3)),
            np.empty(count, np.bool_), np.empty(count, np.int64),
        )  # fmt: skip

    def take(self, which: Any) -> Found:
        """Return some of the contacts."""
        return Found(*(column[which] for column in self))

    def without(self, some: Booleans, number: int) -> Found:
        """Return the other contacts; ``some`` (n,) are so many."""
        if not number:
            return self
        others = Found.room(len(some) - number)
        leave_out(some, *self, *others)
        return others


NOTHING = Found.room(0)


class Points:
    """Room for the points of all pairs, in the order in which they were measured.

    The points of pair p are ``count[p]`` rows from ``start[p]`` on; normals point from the collider measured first. One
    that has none is at least ``apart[p]`` (m) from touching, where that is above 0.
    """

    def __init__(self, pairs: int, room: int) -> None:
        self.start, self.count, self.apart = np.zeros(pairs, np.int64), np.zeros(pairs, np.int64), np.zeros(pairs)
        self.feature, self.depth = np.empty(room, np.int64), np.empty(room)
        self.normal, self.point = np.empty((room, 3)), np.empty((room, 3))


def _as_arrays() -> tuple[list[Kernel], Integers, Booleans]:
    """Return the table by shape numbers: the functions, which of them measures a pair, and whether it swaps sides."""
    functions = list(dict.fromkeys(STAND_INS.values()))
    size = 1 + max(shape.number for pair in STAND_INS for shape in pair)
    function_of, swaps = np.full((size, size), BY_FCL), np.zeros((size, size), np.bool_)
    for (one, other), function in STAND_INS.items():
        function_of[one.number, other.number] = 1 + functions.index(function)
        if (other, one) not in STAND_INS:
            function_of[other.number, one.number] = 1 + functions.index(function)
            swaps[other.number, one.number] = True
    return functions, function_of, swaps


FUNCTIONS, FUNCTION_OF, SWAPS = _as_arrays()
ROOMS = [MOST_POINTS, *(ROOM.get(function, MOST_POINTS) for function in FUNCTIONS)]
#: The table where no kernel is to stand in for FCL: but for meshes, of which it has no right answer.
NO_STAND_INS = np.where(np.isin(FUNCTION_OF, [1 + FUNCTIONS.index(function) for function in ROOM]), FUNCTION_OF, BY_FCL)


def measure_pairs(
    world: World, pairs: Integers, reaches: Floats, collision: str | None = None, apart: Apart | None = None
) -> Found:
    """Return the contact points of ``pairs`` (n, 2) of collider rows that are nearer than their ``reaches`` (n,), m.

    They are measured as the world's setting says, unless ``collision`` says otherwise. Meshes are measured by kernels
    either way: FCL tells of each triangle what parts it alone, with depths up to 3 cm off and normals up to 132
    degrees, and of no gap. Which of them are ``apart`` is noted there.
    """
    collider, pose, answered = world[Collider], world[ColliderPose], world[Answered]
    n = len(pairs)
    order, first, second = np.empty(n, np.int64), np.empty(n, np.int64), np.empty(n, np.int64)
    side = np.empty(n, np.int8)
    crew = crew_for(world, n)
    counts = np.zeros((2, threads_of(crew), len(FUNCTIONS) + 1), np.int64)
    table = FUNCTION_OF if (collision or world[Settings].collision) == "auto" else NO_STAND_INS
    sort_by_function(crew, pairs, collider.shape, table, SWAPS, side, order, first, second, *counts)
    buckets = [(number, count) for number, count in enumerate(map(sum, zip(*counts[0].tolist(), strict=True))) if count]
    points = Points(n, sum(ROOMS[number] * count for number, count in buckets))
    hulls, meshes = world[PackedHulls].holding(world), world[PackedMeshes].holding(world)
    begin = taken = 0
    for number, count in buckets:
        bucket, begin = slice(begin, begin + count), begin + count
        if number == BY_FCL:
            asked = order[bucket] if table is NO_STAND_INS else near_enough(world, order[bucket], pairs, reaches)
            answered.fcl, answered.kernels = answered.fcl + len(asked), answered.kernels + count - len(asked)
            taken = measure_by_fcl(world, asked, pairs, reaches, points)
            continue
        answered.kernels += count
        FUNCTIONS[number - 1](
            crew_for(world, count), order[bucket], first[bucket], second[bucket], reaches, taken, ROOMS[number],
            collider.shape, collider.size, pose.position, pose.rotation, collider.geometry, hulls, meshes,
            points.apart, points.start, points.count, points.feature, points.normal, points.depth, points.point,
        )  # fmt: skip
        taken += ROOMS[number] * count
    total, known_apart = count_points(points.count, points.apart)
    if apart:
        apart.note(world, pairs, points.apart, known_apart)
    found, threads = Found.room(total), threads_of(crew)
    told, received = np.zeros((threads, 4), np.int64), np.empty((threads, 2))
    collect_points(
        crew, pairs, reaches, side, collider.shape, collider.size, collider.position, collider.bound_center,
        collider.bound_half, collider.bound_radius, pose.position, pose.rotation,
        points.start, points.count, points.feature, points.normal, points.depth, points.point, *found,
        told, received,
    )  # fmt: skip
    return without_faulty(world, pairs, found, told, received)
