"""Balls on boxes and half spaces that belong to nobody: eight at once are measured as each of them alone."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np
import pytest

from carom.systems.kernels import groups as of
from carom.systems.kernels.balls import BALL, BOX, HALF_SPACE, gap_of_ball
from carom.systems.kernels.balls_on_still import are_on_still, measure_on_still
from carom.systems.kernels.filling import places_of
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.lanes import WIDTH, address, aligned, load
from carom.systems.kernels.spatial import turn

ROWS = MANIFOLD_ROWS + of.POINT_ROWS


@kernel("lanes")
def measure_eight(first, size, center, kind, ball, other, sign, radius, extent, place, rotation, lanes):
    """Return whether the group is measured at once, and which of its balls are beyond two faces."""
    at, there = places_of(0, 0, first, size), load(address(lanes), of.SHARE)
    across = measure_on_still(0, at, there, center, kind, ball, sign, radius, extent, place, rotation, address(lanes))
    return are_on_still(at, there, kind, other), across


@kernel("gap", "normal", "local")
def measure_each(center, kind, ball, radius, extent, place, rotation, gap, normal, local):
    """Write the gap of each ball, the normal that points to it, and where it is in the frame of the other."""
    for c in range(len(kind)):
        i = ball[c]
        gap[c], normal[c, 0], normal[c, 1], normal[c, 2] = gap_of_ball(
            kind[c], center[i, 0], center[i, 1], center[i, 2], radius[c], place[c, 0], place[c, 1], place[c, 2],
            rotation[c, 0], rotation[c, 1], rotation[c, 2], rotation[c, 3], extent[c, 0], extent[c, 1], extent[c, 2],
        )  # fmt: skip
        local[c, 0], local[c, 1], local[c, 2] = turn(
            -rotation[c, 0], -rotation[c, 1], -rotation[c, 2], rotation[c, 3],
            center[i, 0] - place[c, 0], center[i, 1] - place[c, 1], center[i, 2] - place[c, 2],
        )  # fmt: skip


@pytest.mark.parametrize("missing", [0, 3])
@pytest.mark.parametrize("upright", [False, True])
@pytest.mark.parametrize("seed", range(20))
def test_a_group_is_measured_as_its_balls_alone(seed: int, upright: bool, missing: int) -> None:
    """To the bit: beside faces, edges and corners, with the centre inside, at the middle, and on half spaces."""
    random = np.random.default_rng(seed)
    kind = random.choice([BOX, BOX, HALF_SPACE], WIDTH)
    extent = random.uniform(0.2, 1.0, (WIDTH, 3))
    extent[kind == HALF_SPACE] /= np.linalg.norm(extent[kind == HALF_SPACE], axis=1, keepdims=True)
    rotation = np.tile([0.0, 0.0, 0.0, 1.0], (WIDTH, 1)) if upright else random.normal(size=(WIDTH, 4))
    rotation /= np.linalg.norm(rotation, axis=1, keepdims=True)
    place, radius, sign = random.normal(size=(WIDTH, 3)), random.uniform(0.1, 0.5, WIDTH), random.choice([-1.0, 1.0], 8)
    ball, center = random.permutation(20)[:WIDTH], np.zeros((20, 3))
    center[ball] = place + random.uniform(-1.5, 1.5, (WIDTH, 3))
    center[ball[0]], center[ball[1]] = place[0], place[1] + 0.1 * random.uniform(-0.2, 0.2, 3)
    first, size = np.arange(WIDTH)[None].copy(), np.ones((1, WIDTH), np.int64)
    first[0, WIDTH - missing :], size[0, WIDTH - missing :] = -1, 0
    lanes = aligned(ROWS, WIDTH)
    lanes[of.SHARE] = size[0]
    at_once, across = measure_eight(
        first, size, center, kind, ball, np.full(WIDTH, -1), sign, radius, extent, place, rotation, lanes
    )
    gap, normal, local = np.empty(WIDTH), np.empty((WIDTH, 3)), np.empty((WIDTH, 3))
    measure_each(center, kind, ball, radius, extent, place, rotation, gap, normal, local)
    there = first[0] >= 0
    beyond = (np.abs(local) > extent).sum(axis=1) > 1
    assert at_once
    np.testing.assert_array_equal(lanes[MANIFOLD_ROWS + of.DEPTH], np.where(there, -gap, ABSENT))
    found = lanes[of.NORMAL : of.NORMAL + 3].T
    np.testing.assert_array_equal(found[there], (-sign[:, None] * normal)[there])
    assert [bool(across >> lane & 1) for lane in range(WIDTH)] == (beyond & there & (kind == BOX)).tolist()


@pytest.mark.parametrize(("kinds", "others"), [((BOX, BALL), (-1, -1)), ((BOX, -1), (-1, -1)), ((BOX, BOX), (-1, 4))])
def test_a_group_with_anything_else_is_not(kinds: tuple[int, int], others: tuple[int, int]) -> None:
    """A ball on a ball, a solid, and a box that is a body's."""
    first, size = np.array([[0, 1] + [-1] * 6]), np.array([[1, 1] + [0] * 6])
    lanes, one, three = aligned(ROWS, WIDTH), np.ones(2), np.ones((2, 3))
    lanes[of.SHARE] = size[0]
    ball, rotation = np.zeros(2, np.int64), np.array([[0.0, 0.0, 0.0, 1.0]] * 2)
    at_once, _ = measure_eight(
        first, size, three, np.array(kinds), ball, np.array(others), one, one, three, three, rotation, lanes
    )
    assert not at_once
