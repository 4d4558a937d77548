"""Balls roll over boxes laid side by side as over one piece, however slowly, and strike what is not level."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

CUBE = {"box": {"size": (1.0, 1.0, 1.0)}}
PLACES = [(k + 0.5, -0.5, j + 0.5) for k in range(-5, 5) for j in (-1, 0)]
TURNED = quaternion.from_axis_angle((0.0, 1.0, 0.0), math.radians(37.0))


def tiles(simulation: Simulation, turn: Any, material: dict[str, float]) -> None:
    """Lay cubes side by side."""
    for place in PLACES:
        pose = {"position": quaternion.rotate(turn, place), "rotation": turn}
        simulation.add(collider=CUBE, transform=pose, material=material)


def movable_tiles(simulation: Simulation, turn: Any, material: dict[str, float]) -> None:
    """Lay cubes side by side, each a kinematic body."""
    for place in PLACES:
        pose = {"position": quaternion.rotate(turn, place), "rotation": turn}
        simulation.add(collider=CUBE, body={"type": "kinematic"}, transform=pose, material=material)


def deck(simulation: Simulation, turn: Any, material: dict[str, float]) -> None:
    """Lay them as parts of one kinematic body."""
    raft = simulation.add(body={"type": "kinematic"}, transform={"rotation": turn})
    for place in PLACES:
        pose = {"position": quaternion.rotate(turn, place), "rotation": turn}
        simulation.add(collider=CUBE, transform=pose, parent={"entity": raft, "position": place}, material=material)


def slab(simulation: Simulation, turn: Any, material: dict[str, float]) -> None:
    """Lay one box of their extent."""
    box = {"box": {"size": (10.0, 1.0, 2.0)}}
    simulation.add(collider=box, transform={"position": (0.0, -0.5, 0.0), "rotation": turn}, material=material)


@pytest.mark.parametrize("ground", [tiles, movable_tiles, deck])
@pytest.mark.parametrize("turn", [quaternion.IDENTITY, TURNED], ids=["straight", "turned"])
@pytest.mark.parametrize("speed", [0.06, 0.3, 1.0, 4.0])
@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_a_ball_does_not_feel_seams(friction: float, speed: float, turn: Any, ground: Callable[..., None]) -> None:
    """Slowly neither, when both cubes stay within a hair of it for long; turned ones are level to rounding."""
    simulation, material = Simulation(checked=False), {"friction": friction}
    ground(simulation, turn, material)
    velocity = quaternion.rotate(turn, (speed, 0.0, 0.1 * speed))
    rolls = -speed / 0.5 if friction else 0.0
    ball = simulation.add(
        collider={"sphere": {"radius": 0.5}}, body={"mass": 1.0, "sleeps": False}, material=material,
        transform={"position": quaternion.rotate(turn, (-0.8 * speed, 0.5, -0.1))},
        motion={"linear": velocity, "angular": quaternion.rotate(turn, (-0.1 * rolls, 0.0, rolls))},
    )  # fmt: skip
    for _ in range(90):
        simulation.step()
        assert np.abs(simulation[ball].motion.linear - velocity).max() <= 1e-9
        assert abs(simulation[ball].transform.position[1] - 0.5) <= 1e-9


@pytest.mark.parametrize("speed", [0.1, 1.0, 3.0])
def test_neither_do_two_balls_that_are_one_body(speed: float) -> None:
    """Their contacts are those of any solid."""
    simulation, smooth = Simulation(checked=False), {"friction": 0.0}
    tiles(simulation, quaternion.IDENTITY, smooth)
    ball, at, second = {"sphere": {"radius": 0.25}}, np.array([-0.8 * speed, 0.25, 0.1]), (0.0, 0.0, 0.6)
    body = simulation.add(
        collider=ball, body={"mass": 1.0, "sleeps": False}, material=smooth,
        transform={"position": at}, motion={"linear": (speed, 0.0, 0.0)},
    )  # fmt: skip
    simulation.add(
        collider=ball, material=smooth, transform={"position": at + second}, parent={"entity": body, "position": second}
    )
    for _ in range(90):
        simulation.step()
        assert np.abs(simulation[body].motion.linear - (speed, 0.0, 0.0)).max() <= 1e-9
        assert abs(simulation[body].transform.position[1] - 0.25) <= 1e-9


def test_a_ball_strikes_a_kerb() -> None:
    """One of a millimetre, at the time and the speed at which it meets its edge."""
    simulation, rise, speed = Simulation(checked=False), 0.001, 2.0
    for x, y in ((-2.0, 0.0), (2.0, rise)):
        place = {"position": (x, y - 0.5, 0.0)}
        simulation.add(collider={"box": {"size": (4.0, 1.0, 4.0)}}, transform=place)
    simulation.add(
        collider={"sphere": {"radius": 0.5}}, body={"mass": 1.0},
        transform={"position": (-0.3, 0.5, 0.0)}, motion={"linear": (speed, 0.0, 0.0), "angular": (0.0, 0.0, -4.0)},
    )  # fmt: skip
    aside = math.sqrt(0.25 - (0.5 - rise) ** 2)  # of the ball's centre is the edge when they meet
    impact = simulation.world[Impact]
    while not impact.count:
        simulation.step()
        impact = simulation.world[Impact]
    assert impact.time[0] == pytest.approx((0.3 - aside) / speed, abs=1e-12)
    assert impact.speed[0] == pytest.approx(speed * aside / 0.5, abs=1e-12)


def test_a_ball_that_has_sunk_in_does_not_strike_the_next_box() -> None:
    """A tenth of a millimetre deep, whose push out of the first is all that it feels at the seam."""
    seen = []
    for ground in (tiles, slab):
        simulation = Simulation(checked=False)
        ground(simulation, quaternion.IDENTITY, {"friction": 0.0})
        ball = simulation.add(
            collider={"sphere": {"radius": 0.5}}, body={"mass": 1.0}, material={"friction": 0.0},
            transform={"position": (-0.02, 0.4999, -0.3)}, motion={"linear": (1.0, 0.0, 0.0)},
        )  # fmt: skip
        simulation.step(30)
        assert simulation.world[Impact].count == 0
        seen.append(np.concatenate([simulation[ball].transform.position, simulation[ball].motion.linear]))
    assert np.abs(seen[0] - seen[1]).max() <= 1e-9


@pytest.mark.parametrize("before", [0.005, 0.02, 0.035])
def test_a_ball_lands_on_the_box_it_comes_to_within_a_substep(before: float) -> None:
    """It flies over the seam at 20 m/s each way: an impact as on one piece, wherever it was when the substep began."""
    times = []
    for ground in (tiles, slab):
        simulation = Simulation(checked=False, gravity=(0.0, 0.0, 0.0))
        ground(simulation, quaternion.IDENTITY, {"friction": 0.0})
        simulation.add(
            collider={"sphere": {"radius": 0.5}}, body={"mass": 1.0}, material={"friction": 0.0},
            transform={"position": (-before, 0.54, -0.3)}, motion={"linear": (20.0, -20.0, 0.0)},
        )  # fmt: skip
        simulation.step()
        impact = simulation.world[Impact]
        assert impact.count == 1
        times.append(float(impact.time[0]))
    assert times == pytest.approx([0.002, 0.002], abs=1e-12)
