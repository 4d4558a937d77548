"""Sensors tell who came in and went out, and when inside the step: times are those of closed forms."""

from __future__ import annotations

from math import asin, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from carom.ecs import Transform, restore_snapshot, state_hash, take_snapshot
from carom.ecs.relations.enter import Enter, Exit, Inside
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation

G = 9.81
BALL = {"sphere": {"radius": 0.1}}
GATE = {"box": {"size": (1.0, 1.0, 1.0)}, "sensor": True}
CUBE = hull_of(np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]))
Event = tuple[str, float, int, int]


def events(simulation: Simulation, steps: int) -> list[Event]:
    """Return (what, time, sensor, entity) of all that sensors tell in the next steps, in order of their tables."""
    found: list[Event] = []
    for _ in range(steps):
        simulation.step()
        for kind in (Enter, Exit):
            table = simulation.world[kind]
            for row in range(table.count):
                told = float(table.time[row]), int(table.sensor[row]), int(table.entity[row])
                found.append((kind.key, *told))
    return found


def times(simulation: Simulation, steps: int) -> list[tuple[str, float]]:
    """Return (what, time) of the same."""
    return [event[:2] for event in events(simulation, steps)]


def near(what: str, time: float, within: float = 1e-9) -> tuple[str, Any]:
    """Return an event to compare with."""
    return what, pytest.approx(time, abs=within)


def flying(collider: dict[str, Any], position: Any, velocity: Any, **words: Any) -> tuple[Simulation, int]:
    """Return a world without gravity in which a body flies."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), **words)
    body = simulation.add(
        collider=collider, body={"mass": 1.0}, transform={"position": position}, motion={"linear": velocity}
    )
    return simulation, body


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


KINDS: dict[str, dict[str, Any]] = {
    "sphere": {"sphere": {"radius": 0.5}},
    "box": {"box": {"size": (1.0, 1.0, 1.0)}},
    "capsule": {"capsule": {"radius": 0.5, "length": 1.0}},
    "cylinder": {"cylinder": {"radius": 0.5, "length": 1.0}},
    "cone": {"cone": {"radius": 0.5, "length": 1.0}},
    "ellipsoid": {"ellipsoid": {"radii": (0.5, 0.7, 0.6)}},
    "convex": {"convex": {"points": CUBE.vertices}},
    "mesh": {"shape": Mesh(CUBE)},
    "point": {"point": {}},
}


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


def test_created_inside() -> None:
    """Who is inside at the start enters then; who is made inside in the middle of a run enters with the next step."""
    simulation, ball = flying(BALL, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), dt=0.01)
    gate = simulation.add(collider=GATE)
    assert events(simulation, 10) == [("enter", 0.0, gate, ball)]
    other = simulation.add(collider=BALL, body={"mass": 1.0}, transform={"position": (0.3, 0.3, 0.0)})
    assert events(simulation, 10) == [(*near("enter", 0.1), gate, other)]
    inside = simulation.world[Inside]
    assert inside.since[: inside.count] == pytest.approx([0.0, 0.1])


def test_removed_inside() -> None:
    """Who is removed inside has left with the next step, under the handle that is gone, and so with the sensor."""
    simulation, ball = flying(BALL, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), dt=0.01)
    gates = [simulation.add(collider=GATE) for _ in range(3)]
    events(simulation, 10)
    simulation.world.despawn(gates[1])
    assert events(simulation, 10) == [(*near("exit", 0.1), gates[1], ball)]
    simulation.world.despawn(ball)
    assert events(simulation, 10) == [(*near("exit", 0.2), gate, ball) for gate in (gates[0], gates[2])]
    assert simulation.world.count(Inside) == 0


def test_teleported() -> None:
    """Who is put inside or outside by hand crosses at the start of the step, without a way between."""
    simulation, ball = flying(BALL, (5.0, 0.0, 0.0), (0.0, 0.0, 0.0), dt=0.01)
    gate = simulation.add(collider=GATE)
    assert events(simulation, 10) == []
    for step, (place, what) in enumerate([((0.0, 0.2, 0.0), "enter"), ((-5.0, 0.0, 0.0), "exit")]):
        simulation[ball].transform.position = place
        assert events(simulation, 10) == [(*near(what, 0.1 * (step + 1)), gate, ball)]
    simulation[ball].transform.position = (5.0, 0.0, 0.0)
    assert events(simulation, 10) == []


def test_who_lies_at_the_border_stays() -> None:
    """A box at rest on the ground that is also a sensor came in once, and trembles in and out no more."""
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    simulation.add(collider={"plane": {}, "sensor": True})
    simulation.add(collider=GATE | {"sensor": False}, body={}, transform={"position": (0.0, 0.501, 0.0)})
    found = times(simulation, 600)
    assert [what for what, _ in found] == ["enter"]


def test_the_order_is_that_of_time_then_handles() -> None:
    """Balls that cross at once are told in order of sensor and entity; those that come sooner before."""
    simulation = Simulation(dt=0.1, gravity=(0.0, 0.0, 0.0))
    balls = [
        simulation.add(
            collider={"sphere": {"radius": 0.01}}, body={"mass": 1.0},
            transform={"position": (-0.5 - late, 0.1 * k, 0.0)}, motion={"linear": (10.0, 0.0, 0.0)},
        )
        for k, late in enumerate((0.26, 0.21, 0.21, 0.26))
    ]  # fmt: skip
    gates = [simulation.add(collider=GATE) for _ in range(2)]
    wanted = [
        (*near("enter", time), gate, balls[k])
        for time, pair in ((0.02, (1, 2)), (0.025, (0, 3))) for gate in gates for k in pair
    ]  # fmt: skip
    assert events(simulation, 1) == wanted


def rain(threads: int = 1) -> Simulation:
    """Return balls and boxes that fall through sensors that turn."""
    simulation = Simulation(threads=threads)
    simulation.add(collider={"plane": {}}, material={"restitution": 0.7})
    for k in range(4):
        simulation.add(
            collider={**[GATE, KINDS["cylinder"], KINDS["capsule"], KINDS["convex"]][k], "sensor": True},
            body={"type": "kinematic"}, transform={"position": (k - 1.5, 0.6, 0.0)},
            motion={"angular": (0.3, 1.0 + k, 0.0)},
        )  # fmt: skip
    for k in range(24):
        simulation.add(
            collider=(BALL, {"box": {"size": (0.1, 0.2, 0.3)}}, {"cylinder": {"radius": 0.1, "length": 0.2}})[k % 3],
            body={}, transform={"position": (0.3 * (k % 12) - 1.6, 1.4 + 0.1 * k, 0.02 * k)},
        )  # fmt: skip
    return simulation


def test_threads_and_snapshots_change_nothing() -> None:
    """The same events to the last bit with 1, 2 and 4 threads, and from a snapshot taken in the middle."""
    simulation = rain()
    first, kept = events(simulation, 60), take_snapshot(simulation.world)
    rest = events(simulation, 60)
    assert len(first) > 30
    assert len(rest) > 30
    for threads in (2, 4):
        assert events(rain(threads), 120) == first + rest
    again = rain()
    restore_snapshot(again.world, kept)
    assert events(again, 60) == rest
    assert state_hash(again.world) == state_hash(simulation.world)


def test_positions_of_shapes_are_left_as_they_were() -> None:
    """To sense measures shapes at other times, and leaves no trace in how bodies move."""
    ways = []
    for sensor in (True, False):
        simulation = rain()
        if not sensor:
            world = simulation.world
            world.despawn(world.entities(np.arange(1, 5)))
        simulation.step(60)
        ways.append(simulation.world[Transform].position[5:29].copy())
    assert ways[0].tobytes() == ways[1].tobytes()
