"""Sensors tell who came in and went out, and when inside the step: times are those of closed forms."""

from __future__ import annotations

from math import asin, sqrt
from typing import Any

import numpy as np
import pytest
from gates import BALL, GATE, KINDS, events, flying, near, times
from hypothesis import given, settings
from hypothesis import strategies as st

from carom.ecs.relations.enter import Inside
from carom.systems.simulation import Simulation

G = 9.81


@pytest.mark.parametrize("dt", [1 / 30, 1 / 60, 1 / 240])
@pytest.mark.parametrize(
    ("sensor", "top", "bottom"),
    [
        ({"box": {"size": (2.0, 1.0, 2.0)}}, 0.6, -0.6),
        ({"sphere": {"radius": 0.5}}, 0.6, -0.6),
        ({"plane": {}}, 0.1, None),
    ],
)
def test_a_falling_ball(dt: float, sensor: dict[str, Any], top: float, bottom: float | None) -> None:
    """A ball that falls from 2 m comes in and goes out when it has fallen to where it touches, sqrt(2 h / g)."""
    simulation = Simulation(dt=dt)
    simulation.add(collider={**sensor, "sensor": True})
    simulation.add(collider=BALL, body={}, transform={"position": (0.0, 2.0, 0.0)})
    wanted = [near("enter", sqrt(2.0 * (2.0 - top) / G))]
    if bottom is not None:
        wanted.append(near("exit", sqrt(2.0 * (2.0 - bottom) / G)))
    assert times(simulation, round(1.0 / dt)) == wanted


@settings(max_examples=30)
@given(
    side=st.floats(-0.9, 0.9), speed=st.floats(0.5, 60.0), rise=st.floats(-3.0, 6.0), radius=st.floats(0.01, 0.4)
)  # fmt: skip
def test_a_thrown_ball_crosses_where_it_touches(side: float, speed: float, rise: float, radius: float) -> None:
    """Whatever way a ball flies, at each time told it is just as far from a sensor's centre as the radii sum up to."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(collider={"sphere": {"radius": 1.0}, "sensor": True})
    begin, velocity = np.array([-2.5, 0.0, side]), np.array([speed, rise, 0.0])
    simulation.add(
        collider={"sphere": {"radius": radius}}, body={"mass": 1.0},
        transform={"position": begin}, motion={"linear": velocity},
    )  # fmt: skip
    found = times(simulation, 90)
    assert [what for what, _ in found] == ["enter", "exit"][: len(found)]
    for _, time in found:
        place = begin + velocity * time + 0.5 * np.array([0.0, -G, 0.0]) * time**2
        assert np.linalg.norm(place) == pytest.approx(1.0 + radius, abs=1e-9)
    moments = np.linspace(0.0, 1.5, 20001)[:, None]
    way = np.linalg.norm(begin + velocity * moments + 0.5 * np.array([0.0, -G, 0.0]) * moments**2, axis=1)
    if way.min() < 1.0 + radius - 2e-5:
        assert found
    if way.min() > 1.0 + radius + 1e-4:
        assert not found


def test_a_bullet_goes_through_within_one_substep() -> None:
    """At 600 m/s a ball of 1 cm is through a sheet of 1 mm in 35 microseconds, of a substep of 4 ms."""
    ball = {"sphere": {"radius": 0.01}}
    simulation, bullet = flying(ball, (-5.3, 0.0, 0.0), (600.0, 0.0, 0.0), dt=1 / 60)
    sheet = simulation.add(collider={"box": {"size": (0.001, 1.0, 1.0)}, "sensor": True})
    assert events(simulation, 2) == [
        (*near("enter", (5.3 - 0.0105) / 600.0), sheet, bullet),
        (*near("exit", (5.3 + 0.0105) / 600.0), sheet, bullet),
    ]
    assert simulation.world.count(Inside) == 0


def fallen(height: float, speed: float) -> float:
    """Return how long (s) a body falls from a height at a speed."""
    return (sqrt(speed * speed + 2.0 * G * height) - speed) / G


@pytest.mark.parametrize("integrator", ["euler", "semi_implicit", "verlet"])
def test_a_bounce_inside_a_substep(integrator: str) -> None:
    """A ball is in a layer of 2 mm above the ground on its way down and up, on the arcs of each integrator."""
    simulation = Simulation(dt=1 / 60, integrator=integrator)
    simulation.add(collider={"plane": {}}, material={"restitution": 0.5})
    layer = {"box": {"size": (9.0, 0.002, 9.0)}, "sensor": True}
    simulation.add(collider=layer, transform={"position": (0.0, 0.001, 0.0)})
    simulation.add(
        collider=BALL, body={}, transform={"position": (0.0, 0.12, 0.0)}, motion={"linear": (0.0, -10.0, 0.0)}
    )
    enters, strikes = 0.0018, 0.002
    leaves = strikes + 0.002 / (0.5 * (10.0 + G * strikes))
    if integrator == "semi_implicit":  # at the velocity of the end throughout
        speed = 10.0 + G / 240
        enters, leaves = 0.018 / speed, 0.02 / speed + 0.004 / speed
    elif integrator == "verlet":
        enters, strikes = fallen(0.018, 10.0), fallen(0.02, 10.0)
        up = 0.5 * (10.0 + G * strikes)
        leaves = strikes + (up - sqrt(up * up - 2.0 * G * 0.002)) / G
    assert times(simulation, 1) == [near("enter", enters), near("exit", leaves)]


def test_a_ball_struck_twice_in_a_substep() -> None:
    """To and fro between two walls, more than once in a substep, a ball stays inside the sensor that holds both."""
    simulation, _ = flying(BALL, (0.0, 0.0, 0.0), (40.0, 0.0, 0.0), dt=1 / 60)
    for side in (-1.0, 1.0):
        simulation.add(collider={"plane": {"normal": (-side, 0.0, 0.0), "offset": -0.2}}, material={"restitution": 1.0})
    simulation.add(collider={"box": {"size": (9.0, 9.0, 9.0)}, "sensor": True})
    assert times(simulation, 20) == [("enter", 0.0)]


ON_A_SLOPE = {"sphere": 0.25 + 0.25 * sqrt(5.0), "ellipsoid": 0.25 + sqrt(0.25 + 0.25 * 0.49), "point": 0.25}


@pytest.mark.parametrize("sensor", [kind for kind in KINDS if kind != "point"])
@pytest.mark.parametrize("body", [kind for kind in KINDS if kind != "mesh"])
def test_every_shape_enters_every_other(sensor: str, body: str) -> None:
    """All reach 0.5 m along x, a point 0: at 3 m/s from 2 m away they are in when that much is left.

    The slope of a cone, x = 0.25 - y / 2, is touched by what is round where its normal is (2, 1): as far off as there
    is of the round one along that.
    """
    simulation, _ = flying(KINDS[body], (-2.0, 0.0, 0.0), (3.0, 0.0, 0.0))
    simulation.add(collider={**KINDS[sensor], "sensor": True})
    wide = 0.5 if body == "point" else 1.0
    if "cone" in (sensor, body):
        wide = ON_A_SLOPE.get(body if sensor == "cone" else sensor, wide)
    assert times(simulation, 40)[0] == near("enter", (2.0 - wide) / 3.0, 1e-8)


def test_a_sensor_that_moves() -> None:
    """A kinematic sensor at 2 m/s comes to a ball at rest 3 m away after (3 - 0.6) / 2 s, and leaves it 0.6 s later."""
    simulation, ball = flying(BALL, (3.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    gate = simulation.add(collider=GATE, body={"type": "kinematic"}, motion={"linear": (2.0, 0.0, 0.0)})
    assert events(simulation, 120) == [
        (*near("enter", 1.2), gate, ball),
        (*near("exit", 1.8), gate, ball),
    ]


@pytest.mark.parametrize("spin", [1.0, 20.0])
def test_a_sensor_that_turns(spin: float) -> None:
    """A rod that turns about y comes to a ball 0.4 rad ahead, less the angle under which it sees their half widths."""
    away, half = 1.0, 0.01
    place = (away * np.cos(0.4), 0.0, -away * np.sin(0.4))
    simulation, ball = flying(BALL, place, (0.0, 0.0, 0.0))
    rod = simulation.add(
        collider={"box": {"size": (3.0, 0.1, 2.0 * half)}, "sensor": True},
        body={"type": "kinematic"}, motion={"angular": (0.0, spin, 0.0)},
    )  # fmt: skip
    (first, *_) = events(simulation, round(30 / spin) + 1)
    assert first == (*near("enter", (0.4 - asin((0.1 + half) / away)) / spin, 1e-8), rod, ball)


def test_a_child_is_a_sensor() -> None:
    """A sensor that a body carries 1 m ahead of it comes to what it flies at 1 m earlier than the body."""
    simulation, body = flying(BALL, (-4.0, 0.0, 0.0), (2.0, 0.0, 0.0))
    ahead = simulation.add(
        collider={"sphere": {"radius": 0.3}, "sensor": True},
        parent={"entity": body, "position": (1.0, 0.0, 0.0)},
    )
    goal = simulation.add(collider=BALL, body={"mass": 1.0})
    assert events(simulation, 90) == [(*near("enter", (3.0 - 0.4) / 2.0), ahead, goal)]
