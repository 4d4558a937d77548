"""Bodies deep in each other are parted the shortest way, and nothing is a NaN."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from batches import Batch, measure_batch, separation
from narrow_pairs import BOX, LEVEL, PAIRS, SMALL_BOX, check_valid, lone

from carom.ecs.spatial import quaternion
from carom.systems.constants import BIAS, FACE_CONE, PARALLEL_EDGES
from carom.systems.shapes.box import Box
from carom.systems.shapes.plane import Plane


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
