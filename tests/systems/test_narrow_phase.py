"""The kernels of the narrow phase agree with coal and FCL on random poses, in any frame and whichever side is first."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from batches import Batch, measure_batch, random_batch, separation, smaller
from fcl_batches import fcl_batch
from narrow_pairs import PAIRS, check_valid
from pairs import degrees_between

from carom.ecs.spatial import quaternion
from carom.systems.constants import BIAS

POSES = 10_000
DEPTH, ANGLE = 3e-6, 0.5  # m and degrees: how far coal may see it otherwise
REACH = 0.2  # m


@pytest.fixture(scope="module", params=PAIRS)
def posed(request: Any) -> Any:
    """Yield two shapes, their poses, and coal's distances and normals."""
    a, b = PAIRS[request.param]
    return (a, b, *random_batch(a, b, POSES, seed=1))


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
