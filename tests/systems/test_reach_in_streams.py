"""Whether bodies leave their reach is the same as seen from whatever goes along with them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.random import default_rng

from carom.ecs.column import Floats
from carom.systems.kernels.reach import find_leaving, find_ways, widen_reach

COUNT, SPAN, FLOWN = 20, 0.004, 0.008


def bodies() -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """Return centres, those when detected, reaches, velocities and accelerations; about half of them stay within."""
    random = default_rng(3)
    detected, off = random.normal(size=(COUNT, 3)), random.normal(size=(COUNT, 3))
    reach = np.full(COUNT, 0.05)
    return detected + 0.02 * off, detected, reach, 4.0 * random.normal(size=(COUNT, 3)), random.normal(size=(COUNT, 3))


def riding(along: float) -> tuple[Floats, tuple[Any, ...]]:
    """Return the stream at that speed (m/s), and the bodies after they have gone with it for a while."""
    velocity = along * np.array([0.6, 0.0, -0.8])
    center, detected, reach, linear, acceleration = bodies()
    stream = np.array([velocity, velocity * FLOWN])
    return stream, (center + stream[1], detected, reach, linear + velocity, acceleration)


def leavers(along: float) -> list[int]:
    """Return who may leave."""
    stream, arrays = riding(along)
    leaving = np.empty(COUNT, np.int64)
    return leaving[: find_leaving(np.arange(COUNT), SPAN, stream, *arrays, leaving)].tolist()


@pytest.mark.parametrize("along", [20.0, 300.0])
def test_who_leaves_is_seen_as_from_rest(along: float) -> None:
    """By one and by eight at a time."""
    assert 3 < len(leavers(0.0)) < COUNT - 3
    assert leavers(along) == leavers(0.0)


@pytest.mark.parametrize("along", [20.0, 300.0])
def test_reach_is_widened_as_from_rest(along: float) -> None:
    """Who gets more reach is within it, and comes as far from where he is now."""

    def widened(
        stream: Floats, center: Floats, detected: Floats, reach: Floats, linear: Floats, pull: Floats
    ) -> Floats:
        rows, ways = np.arange(COUNT), np.empty((2, COUNT))
        find_ways(rows, rows, stream, center, detected, reach, ways[0])
        widen_reach(rows, SPAN, stream, center, linear, pull, reach, detected)
        find_ways(rows, rows, stream, center, detected, reach, ways[1])
        return ways

    stream, arrays = riding(0.0)
    at_rest = widened(stream, *arrays)
    assert at_rest[1] == pytest.approx(arrays[2], abs=1e-12)
    stream, arrays = riding(along)
    assert widened(stream, *arrays) == pytest.approx(at_rest, abs=1e-12)
