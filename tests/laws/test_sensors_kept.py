"""Who is inside a sensor is so until it leaves: made there, removed or put elsewhere, in one order everywhere."""

from __future__ import annotations

import numpy as np
import pytest
from gates import BALL, GATE, KINDS, events, flying, near, times

from carom.ecs import Transform, restore_snapshot, state_hash, take_snapshot
from carom.ecs.relations.enter import Inside
from carom.systems.simulation import Simulation


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
