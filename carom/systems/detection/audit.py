"""Audit: each contact measured by its stand-in and by FCL at the same poses, and where the two disagree.

Compared are the deepest points of pairs that overlap: flat areas may be spanned by other corners and be as right.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.ecs.spatial import quaternion, vector
from carom.systems.compound import shape_at
from carom.systems.constants import AUDITED_DEPTH, AUDITED_TURN
from carom.systems.detection.answered import uncounted
from carom.systems.detection.bounds import reaches_of
from carom.systems.detection.narrow import BY_FCL, FUNCTION_OF, Found, measure_pairs
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh
from carom.systems.shapes.shape import Shape

MOST_LISTED = 5  # disagreements of a pair of shapes; more say nothing new


@dataclass(frozen=True)
class Disagreement:
    """A pair of colliders measured in two ways: depths in m, -inf where no contact was seen; degrees between normals.

    ``excess`` is by how many times the limit it is beyond.
    """

    frame: int
    a: str
    b: str
    depth_by_kernel: float
    depth_by_fcl: float
    degrees: float
    excess: float


@dataclass
class Compared:
    """What was found for one pair of shapes.

    ``ties`` are pairs that two directions part equally well, whose angle is not judged. The worst are in degrees and m;
    where only one way sees an overlap, its depth counts.
    """

    pairs: int = 0
    ties: int = 0
    worst_degrees: float = 0.0
    worst_depth: float = 0.0
    beyond: int = 0
    listed: list[Disagreement] = field(default_factory=list)


def audit(world: World, report: dict[tuple[str, str], Compared]) -> None:
    """Measure every contact that a kernel may answer both ways, and add what was found to ``report`` by shapes."""
    pairs = audited_pairs(world)
    reaches = reaches_of(world, pairs, world[Flight].reach)
    with uncounted(world):
        ways = [deepest(measure_pairs(world, pairs, reaches, way), pairs) for way in ("auto", "fcl")]
    for p in range(len(pairs)):
        sides = [(depth[p], normal[p]) for depth, normal in ways]
        compare(world, pairs[p], sides[0], sides[1], report)


def audited_pairs(world: World) -> Integers:
    """Return the pairs (n, 2) of collider rows that are in contact and for which FCL has a stand-in, but for meshes.

    FCL measures a mesh triangle by triangle, with normals of its own at edges within flat areas.
    """
    contact, shape = world[Contact], world[Collider].shape
    used = slice(0, contact.count)
    alive = world.slots.live(contact.a[used]) & world.slots.live(contact.b[used])
    rows = np.unique(np.stack([contact.row_a[used], contact.row_b[used]], axis=1)[alive], axis=0)
    one, other = shape[rows].T
    known = (one < len(FUNCTION_OF)) & (other < len(FUNCTION_OF))
    known[known] = FUNCTION_OF[one[known], other[known]] != BY_FCL
    for land in (Mesh, HeightField):
        known &= (one != land.number) & (other != land.number)
    pairs: Integers = rows[known]
    return pairs


def deepest(found: Found, pairs: Integers) -> tuple[Floats, Floats]:
    """Return depth and normal of the deepest point of every pair, minus infinity where there is none."""
    depth, normal = np.full(len(pairs), -np.inf), np.zeros((len(pairs), 3))
    at = {pair: p for p, pair in enumerate(map(tuple, pairs.tolist()))}
    for k, pair in enumerate(zip(found.row_a.tolist(), found.row_b.tolist(), strict=True)):
        p = at[pair]
        if found.depth[k] > depth[p]:
            depth[p], normal[p] = found.depth[k], found.normal[k]
    return depth, normal


def compare(
    world: World,
    pair: Integers,
    kernel: tuple[float, Floats],
    fcl: tuple[float, Floats],
    report: dict[tuple[str, str], Compared],
) -> None:
    """Add one pair of colliders to the report, if it overlaps."""
    if max(kernel[0], fcl[0]) < 0.0:
        return
    shapes = [shape_at(world, int(row)) for row in pair]
    one, other = sorted(shape.key for shape in shapes)
    compared = report.setdefault((one, other), Compared())
    compared.pairs += 1
    size = smaller_size(shapes)
    apart, degrees, within = max(kernel[0], fcl[0]), 0.0, AUDITED_DEPTH * size  # where only one way sees it
    if min(kernel[0], fcl[0]) > -np.inf:
        apart, degrees = abs(kernel[0] - fcl[0]), float(np.rad2deg(vector.angle(kernel[1], fcl[1])))
        if degrees > AUDITED_TURN and all(
            abs(overlap_along(world, pair, shapes, normal) - depth) <= within for depth, normal in (kernel, fcl)
        ):
            compared.ties += 1
            degrees = 0.0
    compared.worst_degrees = max(compared.worst_degrees, degrees)
    compared.worst_depth = max(compared.worst_depth, float(apart))
    excess = max(apart / within, degrees / AUDITED_TURN)
    if excess > 1.0:
        a, b = (world.name(int(world.entities(row))) for row in pair)
        found = Disagreement(world.frame, a, b, float(kernel[0]), float(fcl[0]), degrees, float(excess))
        compared.beyond += 1
        compared.listed = sorted([*compared.listed, found], key=lambda d: -d.excess)[:MOST_LISTED]


def smaller_size(shapes: list[Shape]) -> float:
    """Return the smallest edge of the bounds of two shapes (m), 1 m where neither has one."""
    return min((width for shape in shapes if 0.0 < (width := shape.bounds().width) < np.inf), default=1.0)


def overlap_along(world: World, pair: Integers, shapes: list[Shape], normal: Floats) -> float:
    """Return how far (m) the second shape must move along a direction to part from the first."""
    pose = world[ColliderPose]
    reached = []
    for row, shape, sense in zip(pair, shapes, (1.0, -1.0), strict=True):
        turned = quaternion.rotate(quaternion.conjugate(pose.rotation[row]), sense * normal)
        farthest = pose.position[row] + quaternion.rotate(pose.rotation[row], shape.support(turned[None])[0])
        reached.append(float((farthest * normal).sum()))
    return reached[0] - reached[1]
