"""FCL's guarded answers: right at shallow overlaps by coal's measure, sane and alive in every pose."""

from __future__ import annotations

import multiprocessing
from typing import Any

import numpy as np
import pytest
from pairs import PAIRS, SHAPES, Pair, Points, Poses, shallow_poses, turns

from carom.ecs.spatial import quaternion
from carom.systems.detection.fcl_pairs import EXACT

# FCL measures a mesh triangle by triangle with a portal refinement: beside edges its normal may be anything that parts
# the shapes. A point is inside a mesh, which is hollow, before it is near a triangle.
BY_TRIANGLES = [(a, b) for a, b in PAIRS if "mesh" in (a, b)]
# coal loses a ball whose centre is inside a cylinder; points in cylinders are held to the closed form.
NO_OPINION = ({"point"}, {"point", "cylinder"})
SECOND_OPINION = [pair for pair in PAIRS if pair not in BY_TRIANGLES and set(pair) not in NO_OPINION]


def deepest(points: Points) -> tuple[Any, Any, float]:
    """Return the deepest point."""
    return max(points, key=lambda point: point[2])


def degrees_between(a: Any, b: Any) -> float:
    """Return the angle of two unit vectors."""
    return float(np.degrees(2.0 * np.arcsin(min(1.0, 0.5 * np.linalg.norm(np.subtract(a, b))))))


@pytest.mark.parametrize(("a", "b"), SECOND_OPINION)
def test_shallow_overlaps_agree_with_coal(a: str, b: str) -> None:
    """1 mm and 1 cm deep: depth within 1e-5 m and normal within 0.3 degrees, in both orders.

    Pairs that FCL measures in closed form, and those with a plane, agree to 2e-9 m, the extent FCL needs a
    point to have, and 1e-4 degrees.
    """
    pair = Pair(SHAPES[a], SHAPES[b])
    exact = frozenset((type(SHAPES[a]), type(SHAPES[b]))) in EXACT or "plane" in (a, b)
    within, turned = (2e-9, 1e-4) if exact else (1e-5, 0.3)
    for poses, depth, normal in shallow_poses(SHAPES[a], SHAPES[b], 20, seed=5):
        for swapped, sense in ((False, 1.0), (True, -1.0)):
            points = pair.measure(poses, swapped=swapped)
            assert points, poses
            _, found, overlap = deepest(points)
            assert overlap == pytest.approx(depth, abs=within)
            assert degrees_between(sense * found, normal) <= turned


@pytest.mark.parametrize(("a", "b"), [pair for pair in BY_TRIANGLES if "point" not in pair])
def test_meshes_are_never_missed_and_mostly_right(a: str, b: str) -> None:
    """1 mm and 1 cm into a face, edge or corner: always seen, at most 1 cm off, and in most poses to 0.1 mm."""
    pair = Pair(SHAPES[a], SHAPES[b])
    faults = []
    for poses, depth, normal in shallow_poses(SHAPES[a], SHAPES[b], 20, seed=6):
        points = pair.measure(poses)
        assert points, poses
        _, found, overlap = deepest(points)
        faults.append(abs(overlap - depth))
        assert np.dot(found, normal) > -0.1
    assert max(faults) <= 1e-2
    assert np.median(faults) <= 1e-4


@pytest.mark.parametrize("depth", [1e-6, 1e-3, 1.0])
@pytest.mark.parametrize(("a", "b"), [("point", "plane"), ("plane", "point")])
def test_a_point_in_a_plane(a: str, b: str, depth: float) -> None:
    """Depth is the distance to the plane, less than 2 nm off for the ball that stands for the point."""
    plane: Any = SHAPES["plane"]
    turn = turns(np.random.default_rng(2))
    normal = quaternion.rotate(turn, plane.normal)
    under, rest = normal * (plane.offset - depth), (np.zeros(3), turn)
    poses = Poses(*rest, under, turn) if a == "plane" else Poses(under, turn, *rest)
    ((place, found, overlap),) = Pair(SHAPES[a], SHAPES[b]).measure(poses)
    assert overlap == pytest.approx(depth, abs=2e-9)
    assert found == pytest.approx(normal if a == "plane" else -normal, abs=1e-12)
    assert place == pytest.approx(under + normal * depth / 2.0, abs=2e-9)


@pytest.mark.parametrize("swapped", [False, True])
def test_a_point_at_a_cylinder(swapped: bool) -> None:
    """Inside and out the depth is that to the nearest of side, end and rim."""
    cylinder: Any = SHAPES["cylinder"]
    pair = Pair(SHAPES["point"], cylinder)
    generator = np.random.default_rng(3)
    for _ in range(200):
        turn, local = turns(generator), generator.uniform(-0.6, 0.6, 3)
        beyond = np.array([np.hypot(local[0], local[2]) - cylinder.radius, abs(local[1]) - cylinder.length / 2.0])
        gap = np.linalg.norm(np.maximum(beyond, 0.0)) + min(0.0, beyond.max())
        points = pair.measure(Poses(quaternion.rotate(turn, local), turn, np.zeros(3), turn), 0.05, swapped=swapped)
        assert [depth for _, _, depth in points] == ([pytest.approx(-gap, abs=2e-9)] if gap < 0.05 else [])


@pytest.mark.parametrize(("a", "b"), SECOND_OPINION)
@pytest.mark.parametrize("gap", [1e-3, 1e-2])
def test_gaps_within_reach_are_seen(a: str, b: str, gap: float) -> None:
    """A pair apart by less than its reach is found, with its gap as negative depth within 0.1 mm.

    FCL's distance of curved shapes is no better, and box and box are measured along the axis that parts them most.
    """
    pair = Pair(SHAPES[a], SHAPES[b])
    for poses, depth, normal in shallow_poses(SHAPES[a], SHAPES[b], 6, seed=7):
        apart = poses._replace(position_b=poses.position_b + normal * (depth + gap))
        points = pair.measure(apart, 2.0 * gap)
        assert points, apart
        assert deepest(points)[2] == pytest.approx(-gap, abs=1e-4)
        assert all(depth < -gap + 1e-4 for _, _, depth in points)


def extreme_poses(seed: int) -> list[Poses]:
    """Return concentric, nearly concentric, axis-aligned, deep and touching poses."""
    generator = np.random.default_rng(seed)
    quarters = [quaternion.IDENTITY, *(quaternion.from_axis_angle(axis, np.pi / 2) for axis in np.eye(3))]
    places = [
        np.zeros(3),
        np.full(3, 1e-12),
        *(s * d * e for s in (1, -1) for d in (0.1, 0.4, 0.55) for e in np.eye(3)),
    ]
    found = [Poses(np.zeros(3), one, at, two) for one in quarters[:2] for two in quarters for at in places]
    for _ in range(100):
        at = generator.normal(size=3) * generator.choice([1e-9, 1e-3, 0.1, 0.5])
        found.append(Poses(generator.normal(size=3), turns(generator), at, turns(generator)))
    return found


def survive(a: str, b: str) -> None:
    """Measure a pair in every extreme pose; to be run in a process that may die."""
    pair = Pair(SHAPES[a], SHAPES[b])
    for poses in extreme_poses(seed=1):
        for reach in (0.0, 0.05):
            for place, normal, depth in pair.measure(poses, reach):
                assert np.isfinite([*place, *normal, depth]).all(), poses
                assert abs(np.linalg.norm(normal) - 1.0) < 1e-6, poses
                assert -reach - 1e-6 <= depth < 5.0, poses


@pytest.mark.parametrize("a", SHAPES)
def test_no_pose_crashes_or_hangs(a: str) -> None:
    """Concentric, deep and axis-aligned poses, where bare FCL aborts and hangs: every answer is finite and unit."""
    for b in (second for first, second in PAIRS if first == a):
        process = multiprocessing.get_context("fork").Process(target=survive, args=(a, b))
        process.start()
        process.join(30.0)
        alive = process.is_alive()
        process.kill()
        process.join()
        assert not alive, f"{a} and {b} hang"
        assert process.exitcode == 0, f"{a} and {b} end with exit code {process.exitcode}"


def survive_touching(key: str, offset: float, gap: float) -> None:
    """Measure two equal shapes standing one on the other, level; to be run in a process that may die."""
    shape = SHAPES[key]
    at = np.array([offset, 2.0 * (shape.bounds().half[1] + shape.bounds().radius) + gap, 0.0])
    poses = Poses(np.zeros(3), np.array(quaternion.IDENTITY), at, np.array(quaternion.IDENTITY))
    ((_, normal, depth),) = Pair(shape, shape).measure(poses, 1e-3)
    assert depth == pytest.approx(-gap, abs=1e-6)
    assert degrees_between(normal, (0.0, 1.0, 0.0)) < 1.0


@pytest.mark.parametrize("gap", [0.0, -1e-12, -1e-9, -1e-8, 1e-6])
@pytest.mark.parametrize(("key", "offset"), [("cylinder", 0.0), ("cylinder", 0.1), ("cylinder", 0.6), ("capsule", 0.0)])
def test_barely_touching_shapes_are_a_contact(key: str, offset: float, gap: float) -> None:
    """Cans stacked to the last bit, where FCL's signed distance aborts: depth within 1e-6 m, normal within a degree."""
    process = multiprocessing.get_context("fork").Process(target=survive_touching, args=(key, offset, gap))
    process.start()
    process.join(30.0)
    alive = process.is_alive()
    process.kill()
    process.join()
    assert not alive
    assert process.exitcode == 0
