"""FCL's answers, by guarded calls only: no crash, flipped normal or wrong depth of FCL reaches the contact table."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Floats, Integers
from carom.systems.detection.fcl_calls import ask_fcl
from carom.systems.detection.fcl_objects import FclObjects
from carom.systems.detection.fcl_single import measure_alone
from carom.systems.detection.hulls import PackedHulls
from carom.systems.kernels.fcl_narrow import refine_answers
from carom.systems.kernels.fcl_order import arrange_for_fcl
from carom.systems.kernels.fcl_reach import keep_near
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.cylinder import Cylinder
from carom.systems.shapes.ellipsoid import Ellipsoid
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.point import Point
from carom.systems.shapes.sphere import Sphere

if TYPE_CHECKING:
    from carom.systems.detection.narrow import Points

#: Shapes whose farthest points kernels know; of all others, and of meshes, FCL is asked pair by pair.
CORES = (Sphere, Box, Plane, Point, Capsule, Cylinder, Convex, Cone, Ellipsoid)
HAS_CORE = np.zeros(2 + max(shape.number for shape in CORES), np.bool_)
HAS_CORE[[shape.number for shape in CORES]] = True
ALONG_Z = np.zeros(len(HAS_CORE), np.bool_)
ALONG_Z[[shape.number for shape in CORES if shape.along_z]] = True


def near_enough(world: World, which: Integers, pairs: Integers, reaches: Floats) -> Integers:
    """Return those of the pairs ``which`` that FCL is to be asked about: a kernel has not found them out of reach."""
    collider, pose, kept = world[Collider], world[ColliderPose], np.empty_like(which)
    count = keep_near(
        which, pairs, reaches, collider.shape, collider.size, pose.position, pose.rotation, collider.geometry,
        world[PackedHulls].holding(world), kept,
    )  # fmt: skip
    return kept[:count]


def measure_by_fcl(world: World, which: Integers, pairs: Integers, reaches: Floats, points: Points) -> int:
    """Measure the pairs ``which`` as FCL sees them; return how many points are taken."""
    shapes = np.minimum(world[Collider].shape[pairs[which]], len(HAS_CORE) - 1)
    together = HAS_CORE[shapes].all(axis=1)
    taken = refine(world, which[together], pairs, reaches, points)
    return measure_alone(world, which[~together], pairs, reaches, points, taken)


def refine(world: World, which: Integers, pairs: Integers, reaches: Floats, points: Points) -> int:
    """Ask FCL of all pairs of solid shapes, then refine what it says at once; return how many points are taken."""
    n, collider, pose, objects = len(which), world[Collider], world[ColliderPose], world[FclObjects]
    if n == 0:
        return 0
    first, second, turns, shifts = np.empty(n, np.int64), np.empty(n, np.int64), np.empty((n, 4)), np.empty((n, 3))
    arrange_for_fcl(
        which, pairs, reaches, collider.shape, collider.size, collider.geometry, pose.position, pose.rotation, ALONG_Z,
        first, second, turns, shifts,
    )  # fmt: skip
    forms = objects.forms_of(world, np.concatenate([first, second])).tolist()
    overlaps, hints = ask_fcl(
        [objects.staying[form] for form in forms[:n]], [objects.moving[form] for form in forms[n:]], turns, shifts
    )
    turned = ALONG_Z[collider.shape[first]]
    hints[turned] = hints[turned][:, [0, 2, 1]] * [1.0, 1.0, -1.0]
    return int(
        refine_answers(
            which, first, second, overlaps, hints, pairs, reaches, 0,
            collider.shape, collider.size, pose.position, pose.rotation, collider.geometry,
            world[PackedHulls].holding(world),
            points.start, points.count, points.feature, points.normal, points.depth, points.point,
        )
    )  # fmt: skip
