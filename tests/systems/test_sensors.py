"""Sensors tell of everyone who enters, once, and touch nobody."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Collider, Motion
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.enter import Enter, Inside
from carom.systems.detection.broad import BroadPhase
from carom.systems.simulation import Simulation

GATE = {"box": {"size": (1.0, 1.0, 1.0)}, "sensor": True}


def flying_through(collision: str = "auto", collider: dict[str, object] | None = None) -> tuple[Simulation, int, int]:
    """Return a body that comes from x = -2.01 m at 4 m/s towards a gate of 1 m at the origin."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0), collision=collision)
    gate = simulation.add(collider=GATE, name="gate")
    ball = simulation.add(
        collider=collider or {"sphere": {"radius": 0.1}},
        body={"mass": 1.0},
        transform={"position": (-2.01, 0.0, 0.0)},
        motion={"linear": (4.0, 0.0, 0.0)},
    )
    return simulation, gate, ball


def entered(simulation: Simulation, frames: int) -> list[tuple[int, int, int, float]]:
    """Return (frame, sensor, entity, time) of every enter in the next frames."""
    found = []
    for _ in range(frames):
        simulation.step()
        enter = simulation.world[Enter]
        found += [
            (simulation.frame, int(enter.sensor[k]), int(enter.entity[k]), float(enter.time[k]))
            for k in range(enter.count)
        ]
    return found


@pytest.mark.parametrize("collision", ["auto", "fcl"])
def test_entering_is_told_once_and_stops_nobody(collision: str) -> None:
    """The ball is in after 1.41 m, 0.3525 s, in the step that ends at 22/60 s; it flies on."""
    simulation, gate, ball = flying_through(collision)
    assert entered(simulation, 60) == [(22, gate, ball, pytest.approx(0.3525, abs=1e-12))]
    assert simulation[ball].motion.linear.tolist() == [4.0, 0.0, 0.0]
    assert simulation.world.count(Contact) == 0


def test_who_comes_to_be_a_sensor_touches_nobody() -> None:
    """In a world that had none: the wall lets the ball through, and is told of it; a wall again, it stops the next."""
    simulation, gate, ball = flying_through()
    with simulation.world.edit(Collider) as collider:
        collider.sensor[simulation.world.row(gate)] = False
    simulation.step(10)
    assert not simulation.world[BroadPhase].senses
    simulation[gate].collider.sensor = True
    assert entered(simulation, 50) == [(22, gate, ball, pytest.approx(0.3525, abs=1e-12))]
    assert simulation[ball].motion.linear.tolist() == [4.0, 0.0, 0.0]
    simulation[gate].collider.sensor = False
    simulation[ball].motion.linear = (-4.0, 0.0, 0.0)
    assert entered(simulation, 60) == []
    assert simulation[ball].transform.position[0] > 0.5


def test_a_manifold_enters_once() -> None:
    """A box has several points in the gate but comes in once."""
    simulation, gate, box = flying_through(collider={"box": {"size": (0.2, 0.2, 0.2)}})
    assert [(sensor, entity) for _, sensor, entity, _ in entered(simulation, 60)] == [(gate, box)]


def test_who_leaves_enters_again() -> None:
    """After turning round outside, coming back is told anew; staying inside is not."""
    simulation, gate, ball = flying_through()
    assert len(entered(simulation, 60)) == 1
    assert simulation.world.count(Inside) == 0
    simulation[ball].motion.linear = (-4.0, 0.0, 0.0)
    found = entered(simulation, 30)
    assert [(sensor, entity) for _, sensor, entity, _ in found] == [(gate, ball)]
    assert simulation.world.count(Inside) == 1
    simulation[ball].motion.linear = (0.0, 0.0, 0.0)
    assert entered(simulation, 10) == []


def test_a_layer_given_to_who_enters() -> None:
    """From the next step on the ball falls through what its old layer met; others still rest on it."""
    simulation = Simulation(dt=1 / 120)
    simulation.layers({"lost": []})
    simulation.add(collider={"plane": {}})
    hole = {"sphere": {"radius": 0.2}, "sensor": True, "on_enter": {"layer": "lost"}}
    simulation.add(collider=hole)
    place = [{"position": (x, 0.1, 0.0)} for x in (0.1, 3.0)]
    over, beside = (simulation.add(collider={"sphere": {"radius": 0.1}}, body={}, transform=at) for at in place)
    simulation.step(60)
    assert simulation[over].collider.layer != simulation[beside].collider.layer
    assert simulation[over].transform.position[1] == pytest.approx(0.1 - 9.81 * 0.25 / 2.0, abs=0.1)
    assert simulation[beside].transform.position[1] == pytest.approx(0.1, abs=1e-9)


def test_despawned_inside() -> None:
    """Whoever goes while inside leaves no trace, and who gets its row enters in its own name."""
    simulation, gate, ball = flying_through()
    entered(simulation, 25)
    assert simulation.world.count(Inside) == 1
    simulation.world.despawn(ball)
    assert entered(simulation, 2) == []
    assert simulation.world.count(Inside) == 0
    other = simulation.add(collider={"sphere": {"radius": 0.1}}, body={"mass": 1.0})
    assert simulation.world.row(other) == simulation.world.row(gate) + 1
    assert [(sensor, entity) for _, sensor, entity, _ in entered(simulation, 3)] == [(gate, other)]


def test_a_sensor_that_goes() -> None:
    """A despawned sensor tells of nobody; two sensors do not sense each other."""
    simulation, gate, ball = flying_through()
    second = simulation.add(collider=GATE, body={"mass": 1.0}, motion={"linear": (0.1, 0.0, 0.0)})
    found = entered(simulation, 25)
    assert [(sensor, entity) for _, sensor, entity, _ in found] == [(gate, ball), (second, ball)]
    simulation.world.despawn(gate)
    simulation.step(2)
    inside = simulation.world[Inside]
    assert inside.sensor[: inside.count].tolist() == [second]
    assert np.isfinite(simulation.world[Motion].linear).all()
