"""FCL's guarded answers: sane and alive in every pose, of meshes and shapes that are not carom's own too."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable
from itertools import combinations_with_replacement
from typing import Any, ClassVar

import numpy as np
import pytest
from batches import Batch
from fcl_batches import fcl_batch
from pairs import PAIRS, SHAPES, Pair, Points, Poses, degrees_between, shallow_poses, turns

from carom.ecs.spatial import quaternion
from carom.systems.constants import BRACKET
from carom.systems.shapes import BY_NUMBER
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.cone import Cone
from carom.systems.shapes.ellipsoid import Ellipsoid

# FCL measures a mesh triangle by triangle with a portal refinement: beside edges its normal may be anything that parts
# the shapes. A point is inside a mesh, which is hollow, before it is near a triangle.
BY_TRIANGLES = [(a, b) for a, b in PAIRS if "mesh" in (a, b)]
LEVEL = np.array(quaternion.IDENTITY)
ROUND = {"cone": Cone(0.4, 1.1), "ellipsoid": Ellipsoid((0.3, 0.7, 0.5))}
SOLIDS: dict[str, Any] = {key: shape for key, shape in SHAPES.items() if not shape.static} | ROUND
EVERY: dict[str, Any] = SHAPES | ROUND


def deepest(points: Points) -> tuple[Any, Any, float]:
    """Return the deepest point."""
    return max(points, key=lambda point: point[2])


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


@pytest.mark.parametrize(("a", "b"), [*combinations_with_replacement([key for key in SOLIDS if key != "point"], 2)])
def test_a_deep_overlap_is_the_least_of_all_directions(a: str, b: str) -> None:
    """However deep, no direction of many parts the two by less, and the normal parts them by the depth."""
    generator = np.random.default_rng(4)
    one, two = SOLIDS[a], SOLIDS[b]
    n = 40
    turn_a, turn_b = (quaternion.normalise(generator.normal(size=(n, 4))) for _ in range(2))
    batch = Batch(turn_a, 0.15 * generator.normal(size=(n, 3)), turn_b)
    depth, normal = fcl_batch(one, two, batch, 0.0).deepest()
    assert (depth > 0.0).mean() > 0.9
    tried = quaternion.normalise(generator.normal(size=(2000, 4)))[:, :3]
    tried /= np.linalg.norm(tried, axis=1, keepdims=True)
    for p in np.nonzero(depth > 0.0)[0]:

        def overlap(ways: Any, p: int = int(p)) -> Any:
            local_a = quaternion.rotate(quaternion.conjugate(turn_a[p]), ways)
            local_b = quaternion.rotate(quaternion.conjugate(turn_b[p]), -ways)
            reached = (one.support(local_a) * local_a).sum(axis=1) + (two.support(local_b) * local_b).sum(axis=1)
            return reached - ways @ batch.position_b[p]

        assert overlap(normal[p : p + 1])[0] == pytest.approx(depth[p], abs=1e-9)
        assert overlap(tried).min() > depth[p] - 1e-7


@pytest.mark.parametrize(
    ("a", "b", "depth", "ways"),
    [
        ("sphere", "sphere", 1.4, [(0, 1, 0)]),
        ("sphere", "capsule", 1.1, [(1, 0, 0)]),
        ("capsule", "capsule", 0.8, [(1, 0, 0)]),
        ("sphere", "box", 0.85, [(1, 0, 0), (-1, 0, 0)]),
        ("box", "box", 0.3, [(1, 0, 0), (-1, 0, 0)]),
        ("cylinder", "box", 0.55, [(1, 0, 0), (-1, 0, 0)]),
        ("ellipsoid", "ellipsoid", 0.6, [(1, 0, 0), (-1, 0, 0)]),
    ],
)
def test_concentric_shapes_are_parted_the_shortest_way(
    a: str, b: str, depth: float, ways: list[tuple[int, int, int]]
) -> None:
    """Balls along y, a ball or capsule from a capsule's axis along x of the capsule, others by the least there is."""
    poses = Poses(np.zeros(3), LEVEL, np.zeros(3), LEVEL)
    points = Pair(SOLIDS[a], SOLIDS[b]).measure(poses)
    _, normal, found = deepest(points)
    assert found == pytest.approx(depth, abs=BRACKET)
    assert min(degrees_between(normal, way) for way in ways) < 0.01


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
    pair = Pair(EVERY[a], EVERY[b])
    for poses in extreme_poses(seed=1):
        for reach in (0.0, 0.05):
            for place, normal, depth in pair.measure(poses, reach):
                assert np.isfinite([*place, *normal, depth]).all(), poses
                assert abs(np.linalg.norm(normal) - 1.0) < 1e-6, poses
                assert -reach - 1e-6 <= depth < 5.0, poses


def ends_well(target: Callable[..., None], *arguments: Any) -> None:
    """Hold what FCL could hang or abort to its end, in a process of its own."""
    process = multiprocessing.get_context("fork").Process(target=target, args=arguments)
    process.start()
    process.join(60.0)
    alive = process.is_alive()
    process.kill()
    process.join()
    assert not alive, f"{arguments} hang"
    assert process.exitcode == 0, f"{arguments} end with exit code {process.exitcode}"


@pytest.mark.parametrize("a", EVERY)
def test_no_pose_crashes_or_hangs(a: str) -> None:
    """Concentric, deep and axis-aligned poses, where bare FCL aborts and hangs: every answer is finite and unit."""
    warm_up()
    for b in EVERY:
        if not (EVERY[a].static and EVERY[b].static):
            ends_well(survive, a, b)


def warm_up() -> None:
    """Compile before the clock of a process runs."""
    Pair(SHAPES["box"], SHAPES["box"]).measure(Poses(np.zeros(3), LEVEL, np.zeros(3), LEVEL))


def survive_touching(key: str, offset: float, gap: float) -> None:
    """Measure two equal shapes standing one on the other, level; to be run in a process that may die."""
    shape = SHAPES[key]
    at = np.array([offset, 2.0 * (shape.bounds().half[1] + shape.bounds().radius) + gap, 0.0])
    for _, normal, depth in Pair(shape, shape).measure(Poses(np.zeros(3), LEVEL, at, LEVEL), 1e-3):
        assert depth == pytest.approx(-gap, abs=1e-9)
        assert degrees_between(normal, (0.0, 1.0, 0.0)) < 1e-3


@pytest.mark.parametrize("gap", [0.0, -1e-12, -1e-9, -1e-8, 1e-6])
@pytest.mark.parametrize(("key", "offset"), [("cylinder", 0.0), ("cylinder", 0.1), ("cylinder", 0.6), ("capsule", 0.0)])
def test_barely_touching_shapes_are_a_contact(key: str, offset: float, gap: float) -> None:
    """Cans stacked to the last bit, where FCL's signed distance aborts: exact depths, and upright normals."""
    warm_up()
    ends_well(survive_touching, key, offset, gap)


@pytest.fixture
def pill(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return a capsule of somebody else's making, of which carom knows no more than a shape has to tell."""

    class Pill(Capsule):
        number: ClassVar[int] = 123456

    monkeypatch.setitem(BY_NUMBER, Pill.number, Pill)
    return Pill(0.4, 1.1)


@pytest.mark.parametrize("other", ["sphere", "box", "capsule", "cylinder", "convex", "plane"])
@pytest.mark.parametrize("depth", [0.01, -0.01])
def test_shapes_of_others_are_measured_as_their_like(pill: Any, other: str, depth: float) -> None:
    """Overlaps and gaps of 1 cm within 0.1 mm, normals within half a degree, whichever side comes first."""
    own, foreign = Pair(Capsule(0.4, 1.1), SHAPES[other]), Pair(pill, SHAPES[other])
    for poses, overlap, normal in shallow_poses(Capsule(0.4, 1.1), SHAPES[other], 10, seed=5):
        moved = poses._replace(position_b=poses.position_b - normal * (depth - overlap))
        _, expected, there = deepest(own.measure(moved, 0.05))
        for swapped, sense in ((False, 1.0), (True, -1.0)):
            _, found, here = deepest(foreign.measure(moved, 0.05, swapped=swapped))
            assert here == pytest.approx(there, abs=1e-4)
            assert degrees_between(sense * found, expected) < 0.5
