"""The kernels of the narrow phase agree with coal on 10,000 poses a pair, and give the manifolds geometry asks for."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from batches import Answer, Batch, measure_batch, random_batch, separation, smaller
from fcl_batches import fcl_batch

from carom.ecs.spatial import quaternion
from carom.systems.constants import BIAS, FACE_CONE, PARALLEL_EDGES
from carom.systems.shapes import Shape
from carom.systems.shapes.box import Box
from carom.systems.shapes.capsule import Capsule
from carom.systems.shapes.plane import Plane
from carom.systems.shapes.sphere import Sphere

POSES = 10_000
DEPTH, ANGLE = 3e-6, 0.5  # m and degrees: how far coal may see it otherwise
BOX, SMALL_BOX = Box((0.6, 0.4, 0.9)), Box((0.3, 0.5, 0.8))
CAPSULE, SHORT_CAPSULE = Capsule(0.4, 1.1), Capsule(0.3, 0.8)
SPHERE, PLANE = Sphere(0.7), Plane((0.0, 3.0, 4.0), 1.0)
PAIRS: dict[str, tuple[Shape, Shape]] = {
    "box-box": (BOX, SMALL_BOX),
    "box-plane": (SMALL_BOX, PLANE),
    "capsule-capsule": (CAPSULE, SHORT_CAPSULE),
    "capsule-box": (CAPSULE, SMALL_BOX),
    "capsule-plane": (CAPSULE, PLANE),
    "sphere-capsule": (SPHERE, CAPSULE),
    "sphere-sphere": (SPHERE, Sphere(0.3)),
    "sphere-box": (SPHERE, SMALL_BOX),
    "sphere-plane": (SPHERE, PLANE),
}
REACH = 0.2  # m
LEVEL = np.array(quaternion.IDENTITY)


@pytest.fixture(scope="module", params=PAIRS)
def posed(request: Any) -> Any:
    """Yield two shapes, their poses, and coal's distances and normals."""
    a, b = PAIRS[request.param]
    return (a, b, *random_batch(a, b, POSES, seed=1))


def degrees_between(a: Any, b: Any) -> Any:
    """Return the angles of unit vectors."""
    return np.degrees(2.0 * np.arcsin(np.minimum(1.0, 0.5 * np.sqrt(((a - b) ** 2).sum(axis=-1)))))


def test_agreement_with_coal(posed: Any) -> None:
    """Depths and gaps are within 3e-6 m, normals within 0.5 degrees or one of several as good, to the same 3e-6 m."""
    a, b, batch, distance, normal = posed
    size = smaller(a, b)
    assert (np.abs(distance) < 0.01 * size).mean() > 0.5
    assert (distance < -0.02 * size).sum() > 100
    answer = measure_batch(a, b, batch, REACH)
    depth, own = answer.deepest()
    assert (answer.count > 0).all()
    assert np.abs(depth + distance).max() < DEPTH
    turned = degrees_between(own, normal) > ANGLE
    if turned.any():
        assert turned.mean() < 0.02
        touching = np.abs(separation(a, b, batch, own) - distance) < DEPTH
        assert touching[turned].all()


def test_every_contact_is_valid(posed: Any) -> None:
    """Contacts are finite with unit normals, no deeper than the smaller shape, within reach, and have own features."""
    a, b, batch, distance, _ = posed
    answer = measure_batch(a, b, batch, REACH)
    check_valid(answer, REACH, smaller(a, b))
    pose = np.repeat(np.arange(POSES), answer.count)
    assert len(np.unique(np.stack([pose, answer.feature]), axis=1).T) == len(pose)
    small = measure_batch(a, b, batch, 0.01)
    assert ((small.count > 0) == (distance <= 0.01))[np.abs(distance - 0.01) > DEPTH].all()


def check_valid(answer: Answer, reach: float, most: float) -> None:
    """Hold contacts to what every contact must be."""
    assert np.isfinite(answer.depth).all()
    assert np.isfinite(answer.point).all()
    assert np.abs((answer.normal**2).sum(axis=1) - 1.0).max(initial=0.0) < 1e-12
    assert ((answer.depth >= -reach) & (answer.depth <= most)).all()


def test_turning_and_moving_the_world_changes_nothing(posed: Any) -> None:
    """Depths stay within 1e-12 m, points and normals move along."""
    a, b, batch, _, _ = posed
    turn, move = quaternion.normalise([0.3, -0.5, 0.1, 0.8]), np.array([2.0, -1.0, 3.0])
    there = Batch(
        quaternion.multiply(turn, batch.rotation_a),
        quaternion.rotate(turn, batch.position_b),
        quaternion.multiply(turn, batch.rotation_b),
    )
    one, two = measure_batch(a, b, batch, REACH), measure_batch(a, b, there, REACH, move)
    assert (one.count == two.count).mean() > 0.999  # a point may be just within reach, or just not
    (depth, normal), (moved, turned) = one.deepest(), two.deepest()
    assert np.abs(depth - moved).max() < 1e-12
    assert np.abs(quaternion.rotate(turn, normal) - turned).max() < 1e-9
    single = (one.count == 1) & (two.count == 1) & (np.arange(POSES) % 10 > 0)  # aligned poses have many nearest points
    places = quaternion.rotate(turn, one.point[one.start[single]]) + move
    assert np.abs(places - two.point[two.start[single]]).max() < 1e-6


@pytest.mark.parametrize("name", ["box-box", "capsule-capsule", "sphere-sphere"])
def test_swapping_the_sides_turns_normals_alone(name: str) -> None:
    """Measured from the other side, depths, points and features are the same bits and normals the opposite ones."""
    a, b = PAIRS[name]
    batch, _, _ = random_batch(a, b, 1000, seed=2)
    one, two = measure_batch(a, b, batch, REACH), measure_batch(a, b, batch, REACH, swapped=True)
    assert (one.normal == -two.normal).all()
    assert (one.count == two.count).all()
    if name == "sphere-sphere":  # the only ones that do not choose who goes first
        assert np.abs(one.depth - two.depth).max() < 1e-15
    else:
        assert (one.depth == two.depth).all()
        assert (one.point == two.point).all()
        assert (one.feature == two.feature).all()


def test_a_pair_of_boxes_is_the_same_alone_and_among_others() -> None:
    """Boxes are parted many pairs at a time: neither number nor place of a pair among them changes a bit."""
    a, b = PAIRS["box-box"]
    batch, _, _ = random_batch(a, b, 100, seed=6)
    every = measure_batch(a, b, batch, REACH)
    for p in range(100):
        alone = measure_batch(a, b, Batch(*(poses[p : p + 1] for poses in batch)), REACH)
        points = slice(every.start[p], every.start[p] + every.count[p])
        for column in ("feature", "normal", "depth", "point"):
            assert (getattr(alone, column) == getattr(every, column)[points]).all()


def least_way_out(a: Box, b: Box, batch: Batch) -> tuple[Any, Any]:
    """Return gap and direction from a to b of the axis, of all fifteen, that parts boxes most, by trying them."""
    one, two = (quaternion.matrix(rotation).swapaxes(1, 2) for rotation in (batch.rotation_a, batch.rotation_b))
    crossed = np.cross(one[:, :, None], two[:, None]).reshape(-1, 9, 3)
    length = np.sqrt((crossed**2).sum(axis=2, keepdims=True))
    axes = np.concatenate([one, two, crossed / np.where(length > 0.0, length, 1.0)], axis=1)
    between = (axes * batch.position_b[:, None]).sum(axis=2)
    gaps = np.abs(between)
    for box, sides in ((a, one), (b, two)):
        gaps -= np.abs(axes @ sides.swapaxes(1, 2)) @ (0.5 * np.array(box.size))
    gaps[:, 6:][length[..., 0] ** 2 <= PARALLEL_EDGES] = -np.inf
    best, every = gaps.argmax(axis=1), np.arange(len(gaps))
    return gaps[every, best], axes[every, best] * np.where(between[every, best] < 0.0, -1.0, 1.0)[:, None]


@pytest.mark.parametrize("least", [1e-8, 1.0])
def test_boxes_are_parted_the_shortest_way_there_is(least: float) -> None:
    """No axis is better by more than BIAS, or the best is as near as FACE_CONE; at any overlap and tilt.

    Half of the boxes lie on one another, as in a pile. FCL takes a face unless an edge is better by 5 %, which differs
    from this by degrees.
    """
    generator, n = np.random.default_rng(8), 5000
    tilt = np.exp(generator.uniform(np.log(least), np.log(max(0.1, least)), (n, 1))) * generator.normal(size=(n, 4))
    level = quaternion.normalise(np.array(quaternion.IDENTITY) + tilt)
    at = generator.normal(size=(n, 3)) * 0.2
    at[::2] = generator.uniform(-0.3, 0.3, (len(at[::2]), 3))
    at[::2, 1] = 0.45 + generator.uniform(-1e-2, 0.0, len(at[::2]))
    batch = Batch(np.tile(LEVEL, (n, 1)), at, level)
    gap, way = least_way_out(BOX, SMALL_BOX, batch)
    depth, normal = measure_batch(BOX, SMALL_BOX, batch, 0.0).deepest()
    meets = gap < -2.0 * BIAS
    assert meets.sum() > 1000
    assert (np.abs(depth + gap) <= 2.0 * BIAS + (1.0 - FACE_CONE) * np.abs(gap))[meets].all()
    turned = (normal * way).sum(axis=1) < FACE_CONE - 1e-12
    as_good = separation(BOX, SMALL_BOX, batch, normal) >= gap - 2.0 * BIAS
    assert (as_good | ~turned)[meets].all()


@pytest.mark.parametrize("name", PAIRS)
def test_fcl_agrees(name: str) -> None:
    """Overlaps of up to 5 % have the depth that FCL's path finds, to twice BIAS, by which boxes keep to their faces."""
    a, b = PAIRS[name]
    batch, distance, _ = random_batch(a, b, 300, seed=3)
    depth, _ = measure_batch(a, b, batch, 0.0).deepest()
    found, _ = fcl_batch(a, b, batch, 0.0).deepest()
    deep = distance < -1e-4
    assert deep.sum() > 50
    assert np.abs(found[deep] - depth[deep]).max() < 2.0 * BIAS


def lone(a: Shape, b: Shape, at: Any, rotation_a: Any = LEVEL, rotation_b: Any = LEVEL, reach: float = 0.0) -> Answer:
    """Measure one pose."""
    return measure_batch(a, b, Batch(*(np.array([v], np.float64) for v in (rotation_a, at, rotation_b))), reach)


def rounded(points: Any) -> set[tuple[float, ...]]:
    """Return points as a set, to 10 micrometres."""
    return {tuple(point) for point in (np.round(points, 5) + 0.0).tolist()}


def about(axis: tuple[float, float, float], degrees: float) -> Any:
    """Return a rotation."""
    return quaternion.from_axis_angle(np.array(axis), np.radians(degrees))


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
CUBE = Box((1.0, 1.0, 1.0))


@pytest.mark.parametrize("gap", [-0.01, 0.0, 0.01])
def test_a_box_on_a_box_touches_at_the_corners_of_the_overlap(gap: float) -> None:
    """Two cubes shifted sideways share a rectangle; turned by 45 degrees an octagon, of which four corners stay."""
    answer = lone(CUBE, CUBE, (0.2, 1.0 + gap, 0.3), reach=0.02)
    middle = 0.5 + 0.5 * gap
    assert rounded(answer.point) == {(x, round(middle, 5), z) for x in (-0.3, 0.5) for z in (-0.2, 0.5)}
    assert answer.depth == pytest.approx(np.full(4, -gap), abs=1e-12)
    assert answer.normal == pytest.approx(np.tile(Y, (4, 1)), abs=1e-12)
    answer = lone(CUBE, CUBE, (0.0, 1.0 + gap, 0.0), rotation_b=about(Y, 45.0), reach=0.02)
    assert answer.count == [4]
    width = np.sqrt(((answer.point[:, None] - answer.point[None]) ** 2).sum(axis=2))
    assert width.max() > 1.08  # across the octagon, whose inner circle is 1 m wide


def test_crossed_planks_touch_where_they_cross() -> None:
    """Neither has a corner over the other: the four points are where edges cross, nearly level or not."""
    plank = Box((3.0, 0.1, 0.2))
    for tilt in (0.0, 0.1):
        turned = quaternion.multiply(about(Y, 90.0), about(X, tilt))
        answer = lone(plank, plank, (0.0, 0.1, 0.0), rotation_b=turned, reach=0.01)
        assert answer.count == [4]
        assert rounded(np.round(answer.point[:, ::2], 2)) == {(x, z) for x in (-0.1, 0.1) for z in (-0.1, 0.1)}


def test_edges_touch_at_one_point() -> None:
    """Two cubes on edge, crossed: the gap, the normal and the middle are those of the two edges."""
    half = np.sqrt(0.5)
    for gap in (-0.01, 0.01):
        answer = lone(CUBE, CUBE, (0.1, 2.0 * half + gap, 0.2), about(X, 45.0), about(Z, 45.0), reach=0.02)
        assert answer.depth == pytest.approx([-gap], abs=1e-12)
        assert answer.normal == pytest.approx(np.array([Y]), abs=1e-12)
        assert answer.point == pytest.approx(np.array([[0.1, half + 0.5 * gap, 0.0]]), abs=1e-12)


def test_corners_apart_are_as_far_as_they_are() -> None:
    """The gap of two cubes corner to corner is that of the corners, though every axis sees less."""
    way = np.array([0.01, 0.02, 0.02])
    answer = lone(CUBE, CUBE, 1.0 + way, reach=0.05)
    assert answer.depth == pytest.approx([-0.03], abs=1e-12)
    assert answer.normal == pytest.approx(way[None] / 0.03, abs=1e-9)
    assert answer.point == pytest.approx(0.5 + 0.5 * way[None], abs=1e-12)
    assert lone(CUBE, CUBE, 1.0 + way, reach=0.025).count == [0]


@pytest.mark.parametrize(("turned", "corners"), [(LEVEL, 4), (about(X, 45.0), 2), (about(X, 30.0), 2)])
def test_a_box_on_a_plane_stands_on_its_corners(turned: Any, corners: int) -> None:
    """A face gives four, an edge two, each with its own depth."""
    floor = Plane((0.0, 1.0, 0.0), 0.0)
    low = 0.5 if corners == 4 else 0.5 * (np.cos(np.pi / 4) + np.sin(np.pi / 4))
    if turned is not LEVEL and corners == 2:
        local = quaternion.rotate(quaternion.conjugate(turned), np.array(Y))
        low = 0.5 * np.abs(local).sum()
    answer = lone(CUBE, floor, (0.0, 0.01 - low, 0.0), rotation_a=turned)
    assert answer.depth == pytest.approx(np.full(corners, 0.01), abs=1e-12)
    assert answer.normal == pytest.approx(np.tile((0.0, -1.0, 0.0), (corners, 1)), abs=1e-12)
    assert answer.point[:, 1] == pytest.approx(np.full(corners, 0.005 - low), abs=1e-12)


@pytest.mark.parametrize(
    ("shift", "turned", "ends"),
    [
        (0.0, about(Z, 90.0), {-0.5, 0.5}),
        (0.7, about(Z, 90.0), {0.2, 1.0}),
        (0.0, LEVEL, {0.0}),
        (0.0, about(Z, 60.0), {0.5 * np.cos(np.radians(30.0))}),
    ],
)
def test_a_capsule_on_a_box(shift: float, turned: Any, ends: set[float]) -> None:
    """Lying, it has a point at each end of what lies over the face; standing or leaning one, under its lower end."""
    capsule, slab = Capsule(0.1, 1.0), Box((2.0, 1.0, 2.0))
    lowest = 0.5 * abs(quaternion.rotate(turned, np.array(Y))[1])
    at = np.array([shift, 0.6 + lowest - 0.01, 0.0])
    answer = lone(capsule, slab, -at, turned, LEVEL, reach=0.005)
    assert rounded(answer.point[:, :1] + shift) == {(round(min(end, 1.0), 5),) for end in ends}
    assert answer.depth == pytest.approx(np.full(len(ends), 0.01), abs=1e-9)
    assert answer.normal == pytest.approx(np.tile((0.0, -1.0, 0.0), (len(ends), 1)), abs=1e-9)


WAY = (0.6, 0.8, 0.0)  # out of an edge along z


@pytest.mark.parametrize(
    ("axis", "degrees", "points"),
    [(WAY, 0.0, 2), (WAY, 2.0, 1), ((-0.8, 0.6, 0.0), 0.01, 2), ((-0.8, 0.6, 0.0), 8.0, 1)],
)
def test_a_capsule_along_an_edge_has_two_points(axis: tuple[float, float, float], degrees: float, points: int) -> None:
    """The way out is from the edge, not from a face; one that crosses the edge, or stands up from it, has one point."""
    turned = quaternion.multiply(about(axis, degrees), about(X, 90.0))
    away = np.array([0.5, 0.5, 0.2]) + (0.09 + 0.5 * np.sin(np.radians(degrees)) * (axis != WAY)) * np.array(WAY)
    answer = lone(Capsule(0.1, 1.0), CUBE, -away, turned, reach=0.02)
    assert answer.count == [points]
    assert answer.depth.max() == pytest.approx(0.01, abs=1e-4)
    assert answer.normal == pytest.approx(np.tile(-np.array(WAY), (points, 1)), abs=1e-3)
    if points == 2:
        assert rounded(np.round(answer.point[:, 2:] + 0.2, 3)) == {(-0.3,), (0.5,)}
        assert len(set(answer.feature.tolist())) == 2


def test_parallel_capsules_have_two_points() -> None:
    """Two logs touch at the ends of what lies side by side; crossed ones where they cross; in a row at the caps."""
    log = Capsule(0.25, 1.0)
    answer = lone(log, log, (0.49, 0.4, 0.0))
    assert rounded(answer.point) == {(0.245, -0.1, 0.0), (0.245, 0.5, 0.0)}
    assert answer.depth == pytest.approx([0.01, 0.01], abs=1e-12)
    assert sorted(answer.feature.tolist()) == [0, 1]
    answer = lone(log, log, (0.49, 0.4, 0.1), rotation_b=about(X, 90.0))
    assert answer.point == pytest.approx(np.array([[0.245, 0.4, 0.0]]), abs=1e-12)
    answer = lone(log, log, (0.0, 1.49, 0.0))
    assert answer.depth == pytest.approx([0.01], abs=1e-12)
    assert answer.normal == pytest.approx(np.array([Y]), abs=1e-12)


DEEP = {
    "box-box": 0.45,  # half of either along y, the shorter edge of the larger one
    "capsule-capsule": 0.7,
    "capsule-box": 0.55,
    "sphere-capsule": 1.1,
    "sphere-sphere": 1.0,
    "sphere-box": 0.85,
}


@pytest.mark.parametrize("name", DEEP)
def test_concentric_poses_part_the_shortest_way(name: str) -> None:
    """Shapes about one point, turned alike, have the depth of the shortest way out and a unit normal."""
    answer = lone(*PAIRS[name], np.zeros(3))
    assert answer.count >= [1]
    assert answer.depth.max() == pytest.approx(DEEP[name], abs=1e-12)


@pytest.mark.parametrize("name", PAIRS)
def test_deep_poses_are_finite(name: str) -> None:
    """However deep, there is a contact with a unit normal, and none deeper than both shapes together."""
    a, b = PAIRS[name]
    generator = np.random.default_rng(4)
    for far in (1e-12, 1e-6, 0.1, 0.3):
        turned = [quaternion.normalise(generator.normal(size=(2000, 4))) for _ in (a, b)]
        for rotation in turned:
            rotation[:500] = LEVEL
        answer = measure_batch(a, b, Batch(turned[0], generator.normal(size=(2000, 3)) * far, turned[1]), 0.0)
        assert isinstance(b, Plane) or (answer.count > 0).mean() > 0.7
        check_valid(answer, 0.0, 4.0)
        if name == "box-box":  # a face that stands for edges is turned from their normal, by less than half a degree
            batch = Batch(turned[0], np.zeros((2000, 3)), turned[1])
            inside = measure_batch(a, b, batch, 0.0)
            assert (inside.count > 0).all()
            depth, normal = inside.deepest()
            assert np.abs(separation(a, b, batch, normal) + depth).max() < 0.01


@pytest.mark.parametrize(
    ("a", "b", "at", "turned"),
    [
        (CUBE, CUBE, (0.0, 1.0, 0.0), LEVEL),
        (CUBE, CUBE, (0.2, 1.0, 0.1), about(Y, 20.0)),
        (Box((5.0, 1.0, 5.0)), CUBE, (0.0, 1.0, 0.0), LEVEL),
        (CUBE, Plane((0.0, -1.0, 0.0), -0.5), (0.0, 0.0, 0.0), LEVEL),
        (Capsule(0.5, 1.0), CUBE, (1.0, 0.0, 0.0), LEVEL),
        (Capsule(0.5, 1.0), Capsule(0.5, 1.0), (1.0, 0.0, 0.0), LEVEL),
    ],
)
def test_features_stay_while_the_pair_moves_little(a: Shape, b: Shape, at: Any, turned: Any) -> None:
    """What rests and trembles by a tenth of a micrometre keeps the numbers of its points, so that warm starts hold."""
    generator = np.random.default_rng(5)
    seen = set()
    for _ in range(100):
        tremble = quaternion.normalise(turned + 1e-7 * generator.normal(size=4))
        place = np.array(at) + 1e-7 * generator.normal(size=3)
        answer = lone(a, b, place, LEVEL, tremble, reach=0.01)
        seen.add(tuple(sorted(answer.feature.tolist())))
    assert len(seen) == 1
    assert len(seen.pop()) == (2 if isinstance(a, Capsule) else 4)


@pytest.mark.parametrize("degrees", [0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("gap", [0.01, -0.005])
def test_a_box_tilted_about_two_axes_has_four_points(degrees: float, gap: float) -> None:
    """Two edges part it from the face below, whose other corners are about to land: they are known in time.

    The deepest is where the edges cross; each corner of the tilted face that is over the other one keeps its height.
    """
    tilt = quaternion.from_axis_angle((np.sqrt(0.5), 0.0, np.sqrt(0.5)), np.radians(degrees))
    corners = np.array([(x, -0.5, z) for x in (-0.5, 0.5) for z in (-0.5, 0.5)])
    low = quaternion.rotate(np.tile(tilt, (4, 1)), corners)
    at = np.array([0.03, 0.5 - low[:, 1].min() + gap, 0.02])
    answer = lone(CUBE, CUBE, at, LEVEL, tilt, reach=0.2)
    assert answer.count.tolist() == [4]
    heights = np.sort(low[:, 1] + at[1] - 0.5)
    assert -answer.depth.max() == pytest.approx(heights[0], abs=0.05 * np.radians(degrees))
    assert (-answer.depth <= heights[-1] + 1e-9).all()
    assert (answer.normal[:, 1] > 0.995).all()
    assert np.ptp(answer.normal, axis=0).max() == 0.0
