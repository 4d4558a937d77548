"""Who is told that he cannot strike within a substep does not: to ask everybody changes no bit."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Transform, World
from carom.ecs.relations.impact import Impact
from carom.systems import response
from carom.systems.closing import closing
from carom.systems.kernels.closing import CANNOT, MAY
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation

COUNT, STEPS = 60, 90


def crowd(gravity: float) -> Simulation:
    """Return balls of three sizes that fly to and fro between walls, boxes and half spaces, and lose nothing."""
    generator = np.random.default_rng(11)
    simulation = Simulation(gravity=(0.0, -gravity, 0.0), sleeping=False, checked=False)
    whole = {"restitution": 1.0, "friction": 0.3}
    for axis in range(3):
        for side in (-1.0, 1.0):
            normal, size, place = np.zeros(3), np.full(3, 6.0), np.zeros(3)
            normal[axis], place[axis] = -side, side * 2.0
            if axis < 2:
                size[axis], place[axis] = 1.0, side * 2.5
                simulation.add(collider={"box": {"size": size}}, transform={"position": place}, material=whole)
            else:
                simulation.add(collider={"plane": {"normal": normal}}, transform={"position": place}, material=whole)
    for k in range(COUNT):
        place = np.array([k % 4, k // 4 % 4, k // 16]) - 1.5
        simulation.add(
            collider={"sphere": {"radius": 0.2 + 0.1 * (k % 3)}}, body={"mass": 1.0}, material=whole,
            transform={"position": place},
            motion={"linear": generator.normal(size=3), "angular": generator.normal(size=3)},
        )  # fmt: skip
    return simulation


@pytest.mark.parametrize("gravity", [0.0, 9.81])
def test_who_cannot_strike_does_not(gravity: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Most are told so, and some that close, or are near and part."""
    told, asked, struck = crowd(gravity), crowd(gravity), 0
    numbers = np.zeros(2, np.int64)

    def ask_all(world: World, span: float, *, began: bool) -> tuple[Any, float, bool]:
        closes, within, _ = closing(world, span, began=began)
        now = closes[: world[Resting].count]
        numbers[:] += (now == CANNOT).sum(), (now == MAY).sum()
        now[now == CANNOT] = MAY
        return closes, within, True

    for _ in range(STEPS):
        told.step()
        with monkeypatch.context() as patched:
            patched.setattr(response, "closing", ask_all)
            asked.step(after=lambda system: None)
        assert told.world[Transform].position.tobytes() == asked.world[Transform].position.tobytes()
        struck += told.world[Impact].count
    assert struck > 2 * STEPS
    assert numbers[0] > 5 * numbers[1] > 0
