"""Bodies that turn strike where and when they first touch, not a step later, and who turns past strikes nobody."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

WALLS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "plane": ({"plane": {"normal": (1.0, 0.0, 0.0)}}, {}),
    "box": ({"box": {"size": (1.0, 4.0, 4.0)}}, {"position": (-0.5, 0.0, 0.0)}),
    "mesh": (
        {"height_field": {"heights": np.zeros((9, 9)).tolist(), "spacing": 0.5}},
        {"rotation": quaternion.from_axis_angle((0.0, 0.0, 1.0), -0.5 * np.pi)},
    ),
}
RODS: dict[str, dict[str, Any]] = {
    "box": {"box": {"size": (1.0, 0.1, 0.1)}},
    "capsule": {"capsule": {"radius": 0.05, "length": 0.9}},
}
CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
SMOOTH = {"friction": 0.0, "restitution": 1.0}


def with_wall(wall: str, **material: Any) -> Simulation:
    """Return a world without gravity, solid where x is below 0."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    collider, place = WALLS[wall]
    simulation.add(collider=collider, transform=place, material=material)
    return simulation


def nearest(shape: str, angle: float) -> tuple[float, float]:
    """Return the point (x, y) of a rod at an angle, from its centre, that has the least x."""
    c, s = np.cos(angle), np.sin(angle)
    if shape == "box":
        return min((x * c - y * s, x * s + y * c) for x in (-0.5, 0.5) for y in (-0.05, 0.05))
    return -0.45 * abs(c) - 0.05, -0.45 * np.sign(c) * s


@pytest.mark.parametrize("wall", ["plane", "box"])
@pytest.mark.parametrize("speed", [1.0, 3.0, 6.0])
@pytest.mark.parametrize("shape", RODS)
def test_a_rod_strikes_when_and_where_it_first_touches(shape: str, speed: float, wall: str) -> None:
    """Its end comes 30 cm to a wall: J = 2 w r / (1/m + r^2/I), with r across the normal when it touches.

    Points are followed to first order of their turn in each substep, which is up to w h of it off; before they were
    found where a step began, up to 15 ms late.
    """
    simulation, begun = with_wall(wall, **SMOOTH), 1.3
    turn = begun if shape == "box" else begun - 0.5 * np.pi
    rod = simulation.add(
        collider=RODS[shape], body={"mass": 1.0}, material=SMOOTH, motion={"angular": (0.0, 0.0, speed)},
        transform={"position": (0.3, 0.0, 0.0), "rotation": quaternion.from_axis_angle((0.0, 0.0, 1.0), turn)},
    )  # fmt: skip
    world, angle, step = simulation.world, begun, 0.1
    while step > 1e-12:  # to where it first touches
        while 0.3 + nearest(shape, angle + step)[0] > 0.0:
            angle += step
        step *= 0.5
    row, impact = world.row(rod), world[Impact]
    while not impact.count:
        simulation.step()
    lever, eased = -nearest(shape, angle)[1], world[RigidBody].inverse_inertia[row, 2]
    impulse = -2.0 * speed * lever / (1.0 + eased * lever * lever)
    assert impact.time[0] == pytest.approx((angle - begun) / speed, abs=2e-4)
    assert world[Motion].linear[row] == pytest.approx([impulse, 0.0, 0.0], abs=2e-4 * impulse)
    assert world[Motion].angular[row, 2] == pytest.approx(speed + lever * impulse * eased, rel=2.5e-3)


@pytest.mark.parametrize("wall", WALLS)
@pytest.mark.parametrize("half", [(0.5, 0.1, 0.1), (0.3, 0.1, 0.2), (0.3, 0.02, 0.3)])
@pytest.mark.parametrize("speed", [2.0, 4.0, 10.0, 30.0])
def test_no_corner_swings_into_a_wall(speed: float, half: tuple[float, float, float], wall: str) -> None:
    """Boxes turn anyhow a few millimetres from it, slowly or fast for their size; they came in by up to 6 cm."""
    deepest, random = 0.0, np.random.default_rng(7)
    for gap in (0.002, 0.01, 0.02):
        for _ in range(4):
            simulation, turn = with_wall(wall), quaternion.normalise(random.normal(size=4))
            out = gap - (quaternion.rotate(turn, CORNERS * half))[:, 0].min()
            axis = random.normal(size=3)
            body = simulation.add(
                collider={"box": {"size": 2.0 * np.array(half)}}, body={"mass": 1.0},
                transform={"position": (out, 0.0, 0.0), "rotation": turn},
                motion={"angular": speed * axis / np.linalg.norm(axis)},
            )  # fmt: skip
            transform, row = simulation.world[Transform], simulation.world.row(body)
            for _ in range(6):
                simulation.step()
                places = transform.position[row] + quaternion.rotate(transform.rotation[row], CORNERS * half)
                deepest = max(deepest, -float(places[:, 0].min()))
    assert deepest < 5e-3  # 4 mm where a plate of 4 cm comes in at 9 m/s, 2 mm of others


@pytest.mark.parametrize("wall", WALLS)
@pytest.mark.parametrize("half", [(0.5, 0.1), (0.5, 0.5), (0.3, 0.02)])
@pytest.mark.parametrize("speed", [2.0, 10.0, 30.0])
def test_who_turns_past_strikes_nobody(speed: float, half: tuple[float, float], wall: str) -> None:
    """A corner comes as near as 4 mm to the wall, and away again; within 3 mm all are taken to meet."""
    simulation = with_wall(wall)
    body = simulation.add(
        collider={"box": {"size": (2.0 * half[0], 2.0 * half[1], 0.2)}}, body={"mass": 1.0},
        transform={"position": (np.hypot(*half) + 4e-3, 0.0, 0.0)}, motion={"angular": (0.0, 0.0, speed)},
    )  # fmt: skip
    simulation.step(60)
    motion, row = simulation.world[Motion], simulation.world.row(body)
    assert motion.linear[row].tolist() == [0.0, 0.0, 0.0]
    assert motion.angular[row] == pytest.approx([0.0, 0.0, speed], rel=1e-12)
