"""Surfaces that run like belts drag what touches them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.systems.simulation import Simulation

G = 9.81
MU = 0.5
ROUGH = {"friction": MU}
CUBE = {"box": {"size": (1.0, 1.0, 1.0)}}
BALL = {"sphere": {"radius": 0.1}}


def world(**settings: Any) -> Simulation:
    """Return an empty world."""
    return Simulation(checked=False, **settings)


def add_belt(simulation: Simulation, velocity: float, z: float = 0.0, **words: Any) -> int:
    """Add a belt of 40 m by 2 m whose surface, at y = 0, runs along x."""
    collider = {"box": {"size": (40.0, 1.0, 2.0)}, "surface_velocity": (velocity, 0.0, 0.0)}
    words = {"transform": {"position": (0.0, -0.5, z)}} | words
    return simulation.add(collider=collider, material=ROUGH, **words)


def add(simulation: Simulation, collider: dict[str, Any], *position: float, **material: float) -> int:
    """Add a body of 1 kg."""
    return simulation.add(
        collider=collider, body={"mass": 1.0}, material=ROUGH | material, transform={"position": position}
    )


def test_a_belt_brings_a_cube_to_its_speed() -> None:
    """A belt of 1 m/s has it there after v / (mu g) = 0.204 s, within 2 %, and it stays at it."""
    simulation = world()
    add_belt(simulation, 1.0)
    cube = add(simulation, CUBE, 0.0, 0.5, 0.0)
    simulation.step(12)
    speed = simulation[cube].motion.linear[0]
    assert simulation.time / speed == pytest.approx(1.0 / (MU * G), rel=0.02)
    assert simulation.time / speed == pytest.approx(1.0 / (MU * G), rel=1e-3)
    simulation.step()
    assert simulation[cube].motion.linear[0] == pytest.approx(1.0, rel=0.002)
    simulation.step(107)
    for _ in range(60):
        simulation.step()
        assert simulation[cube].motion.linear == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)
    assert simulation[cube].motion.angular == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)


@pytest.mark.parametrize("restitution", [0.0, 0.5], ids=["laid down", "dropped"])
def test_a_ball_comes_to_roll_against_the_belt(restitution: float) -> None:
    """Two sevenths of the belt's speed, the rest of it in its spin, whether it is laid down or bounces on it first."""
    simulation = world()
    add_belt(simulation, 1.0)
    ball = add(simulation, BALL, 0.0, 0.5 if restitution else 0.1, 0.0, restitution=restitution)
    simulation.step(240)
    assert simulation[ball].motion.linear == pytest.approx([2.0 / 7.0, 0.0, 0.0], abs=1e-9)
    assert simulation[ball].motion.angular == pytest.approx([0.0, 0.0, 50.0 / 7.0], abs=1e-9)


def test_a_plane_may_run_and_only_along_itself() -> None:
    """What of the velocity leads into a surface does nothing."""
    simulation = world()
    simulation.add(collider={"plane": {}, "surface_velocity": (1.0, -7.0, 2.0)}, material=ROUGH)
    cube = add(simulation, CUBE, 0.0, 0.5, 0.0)
    simulation.step(120)
    assert simulation[cube].motion.linear == pytest.approx([1.0, 0.0, 2.0], abs=1e-9)
    assert simulation[cube].transform.position[1] == pytest.approx(0.5, abs=1e-6)


def test_the_velocity_is_in_the_frame_of_the_shape() -> None:
    """A shape turned by a right angle about y in an entity turned by another runs backwards."""
    simulation = world()
    quarter = (0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5))
    simulation.add(
        collider={"box": {"size": (40.0, 1.0, 40.0)}, "rotation": quarter, "surface_velocity": (1.0, 0.0, 0.0)},
        material=ROUGH,
        transform={"position": (0.0, -0.5, 0.0), "rotation": quarter},
    )
    cube = add(simulation, CUBE, 0.0, 0.5, 0.0)
    simulation.step(60)
    assert simulation[cube].motion.linear == pytest.approx([-1.0, 0.0, 0.0], abs=1e-6)


def test_the_speed_of_a_belt_adds_to_that_of_its_body() -> None:
    """On a kinematic body at 2 m/s whose surface runs back at 2 m/s a cube stays where it is."""
    simulation = world()
    add_belt(simulation, -2.0, body={"type": "kinematic"}, motion={"linear": (2.0, 0.0, 0.0)})
    cube = add(simulation, CUBE, 0.0, 0.5, 0.0)
    simulation.step(120)
    assert simulation[cube].transform.position == pytest.approx([0.0, 0.5, 0.0], abs=1e-6)


def test_a_body_with_a_belt_drives() -> None:
    """A cube whose own surface runs back at 1 m/s comes to drive forwards at it over the ground, by mu g."""
    simulation = world()
    simulation.add(collider={"plane": {}}, material=ROUGH)
    cube = add(simulation, CUBE | {"surface_velocity": (-1.0, 0.0, 0.0)}, 0.0, 0.5, 0.0)
    simulation.step(12)
    assert simulation[cube].motion.linear[0] == pytest.approx(MU * G * simulation.time, rel=1e-3)
    simulation.step(48)
    assert simulation[cube].motion.linear == pytest.approx([1.0, 0.0, 0.0], abs=1e-6)


@pytest.mark.parametrize("shape", [BALL, {"box": {"size": (0.2, 0.2, 0.2)}}], ids=["ball", "box"])
def test_an_impact_feels_the_belt(shape: dict[str, Any]) -> None:
    """A body that bounces once takes mu (1 + e) v along with it while its surface slides."""
    simulation = world(gravity=(0.0, 0.0, 0.0))
    add_belt(simulation, 20.0)
    body = simulation.add(
        collider=shape,
        body={"mass": 1.0},
        material={"friction": MU, "restitution": 1.0},
        transform={"position": (0.0, 0.5, 0.0)},
        motion={"linear": (0.0, -2.0, 0.0)},
    )
    simulation.step(30)
    # A box that slides turns about its leading edge, which gives back less than the rest.
    taken = MU * (simulation[body].motion.linear[1] + 2.0)
    assert simulation[body].motion.linear[0] == pytest.approx(taken, rel=1e-9)
    if shape is BALL:
        assert simulation[body].motion.linear == pytest.approx([2.0, 2.0, 0.0], abs=1e-9)


def test_two_belts_in_opposite_directions_spin_a_cube_on_both() -> None:
    """They run past each other under its sides: it turns by the speed of both and hardly leaves its place."""
    simulation = world()
    add_belt(simulation, 1.0, 1.4)
    add_belt(simulation, -1.0, -1.4)
    cube = add(simulation, CUBE, 0.0, 0.5, 0.0)
    simulation.step(60)
    for _ in range(60):
        simulation.step()
        assert simulation[cube].motion.angular[1] > 0.5
    assert np.abs(simulation[cube].transform.position - (0.0, 0.5, 0.0)).max() < 0.1


def test_a_cube_that_slides_and_spins_stops_doing_both_at_once() -> None:
    """The friction under it has one cone for both, so that each keeps the other up."""
    simulation = world()
    simulation.add(collider={"plane": {}}, material=ROUGH)
    cube = simulation.add(
        collider=CUBE,
        body={"mass": 1.0},
        material=ROUGH,
        transform={"position": (0.0, 0.5, 0.0)},
        motion={"linear": (3.0, 0.0, 0.0), "angular": (0.0, 6.0, 0.0)},
    )
    moving = simulation[cube].motion
    while moving.linear[0] > 0.05:
        assert moving.angular[1] > 0.0
        simulation.step()
    assert simulation.time > 1.05 * 3.0 / (MU * G)
    simulation.step(6)
    assert np.abs(moving.linear).max() < 1e-3
    assert np.abs(moving.angular).max() < 1e-3
