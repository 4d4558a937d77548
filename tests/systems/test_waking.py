"""Who wakes sleepers and who does not: a blow, a change, a support that sets out, a push."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from sleepers import BALL, BOX, asleep, choose, sleeping, stacks

from carom.ecs import ExternalForce, Motion, RigidBody, restore_snapshot, take_snapshot
from carom.systems.constants import SLEEP_SPEED
from carom.systems.progress import Progress
from carom.systems.simulation import Simulation
from carom.systems.why_awake import why_awake


def test_a_stack_wakes_without_a_jolt() -> None:
    """Warm starts are kept: a stack that is woken moves no faster than it did before it fell asleep."""
    simulation = stacks(0.0, high=8, sleeping=False)
    simulation.step(300)
    rows, motion = simulation.world.row_numbers(RigidBody), simulation.world[Motion]
    calm = np.abs(motion.linear[rows]).max()
    assert 0.0 < calm < 0.1 * SLEEP_SPEED
    choose(simulation, sleeping=True)
    simulation.step(60)
    assert asleep(simulation, "a0", "a7") == [True, True]
    simulation.wake("a3")
    for _ in range(20):
        simulation.step()
        assert asleep(simulation, "a0", "a7") == [False, False]
        assert np.abs(motion.linear[rows]).max() < calm


def test_a_blow_wakes_and_is_exact() -> None:
    """A ball of the same mass, e = 1, hands its velocity to a sleeping one: momentum and energy to rounding."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    elastic = {"restitution": 1.0, "friction": 0.0}
    for name, x in (("runner", -8.0), ("sleeper", 0.0)):
        simulation.add(
            name=name, collider=BALL, body={"mass": 1.0}, material=elastic, transform={"position": (x, 0, 0)}
        )
    simulation["runner"].motion.linear = (2.0, 0.0, 0.0)
    simulation.step(120)
    assert asleep(simulation, "sleeper") == [True]
    simulation.step(120)
    assert simulation["runner"].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert simulation["sleeper"].motion.linear == pytest.approx([2.0, 0.0, 0.0], abs=1e-12)
    hit = 7.0 / 2.0  # s
    assert simulation["sleeper"].transform.position[0] == pytest.approx(2.0 * (simulation.time - hit), abs=1e-9)


def _remove_floor(simulation: Simulation) -> None:
    simulation.world.despawn(simulation.world.find("floor"))


def _lower_floor(simulation: Simulation) -> None:
    simulation["floor"].transform.position = (0.0, -2.0, 0.0)


def _turn_gravity(simulation: Simulation) -> None:
    choose(simulation, gravity=(0.0, 0.0, 9.81))


def _push(simulation: Simulation) -> None:
    with simulation.world.edit(ExternalForce) as external:
        external.force[simulation.world.row(simulation.world.find("a2"))] = (40.0, 0.0, 0.0)


def _set(entity: str, component: str, column: str, value: Any) -> Callable[[Simulation], None]:
    return lambda simulation: setattr(getattr(simulation[entity], component), column, value)


def _put_wall(simulation: Simulation) -> None:
    simulation.add(collider=BOX, transform={"position": (0.9, 0.5, 0.0)})


@pytest.mark.parametrize(
    "change",
    [
        _remove_floor,
        _lower_floor,
        _turn_gravity,
        _push,
        _put_wall,
        _set("a1", "motion", "linear", (0.0, 0.0, 1.0)),
        _set("a1", "transform", "position", (0.0, 1.6, 0.0)),
        _set("a1", "rigid_body", "inverse_mass", 0.5),
        _set("floor", "material", "friction", 0.0),
        lambda simulation: simulation.force("constant_push", force=(1.0, 0.0, 0.0)),
        lambda simulation: simulation.world.despawn(simulation.world.find("a0")),
        lambda simulation: simulation.wake("a0"),
    ],
)
def test_a_change_wakes_whom_it_concerns(change: Callable[[Simulation], Any]) -> None:
    """Supports that go, pushes, velocities, places, masses, materials, gravity, laws, walls that come."""
    simulation = sleeping(0.0)
    change(simulation)
    simulation.step()
    assert asleep(simulation, "a1", "a2") == [False, False]


def test_a_wall_that_comes_wakes_sleepers_where_it_is_crowded() -> None:
    """Where gravel falls, detection bounds everybody twice: who has come since the last step has come still.

    One flies off, so that the gravel is no stream.
    """
    simulation = sleeping(0.0)
    simulation.add(
        motion={"linear": (0.0, 4.0 * 216, 0.0)}, transform={"position": (99.0, 0.0, 0.0)}, body={"mass": 1.0}
    )
    for k in range(216):
        place = (20.0 + 0.02 * (k % 6), 9.0 + 0.02 * (k // 36), 0.02 * (k // 6 % 6))
        simulation.add(
            collider={"box": {"size": (0.01, 0.01, 0.01)}}, body={},
            transform={"position": place}, motion={"linear": (0.0, -4.0, 0.0)},
        )  # fmt: skip
    simulation.step()
    assert simulation.world[Progress].crowded
    assert asleep(simulation, "a1", "a2") == [True, True]
    _put_wall(simulation)
    simulation.step()
    assert simulation.world[Progress].crowded
    assert asleep(simulation, "a1", "a2") == [False, False]


def test_who_is_not_concerned_sleeps_on() -> None:
    """To despawn a cube, to move another and to drop a third wakes nobody in another stack."""
    simulation = sleeping(0.0, 4.0)
    simulation.world.despawn(simulation.world.find("a2"))
    simulation["a1"].motion.linear = (0.0, 0.0, -1.0)
    simulation.add(name="late", collider=BOX, body={}, transform={"position": (-4.0, 5.0, 0.0)})
    for _ in range(60):
        simulation.step()
        assert asleep(simulation, "b0", "b1", "b2") == [True] * 3


def test_a_support_that_sets_out_wakes_whom_it_carries() -> None:
    """What lies on a lift sleeps while that stands, and goes up with it."""
    simulation = Simulation()
    slab = {"box": {"size": (4.0, 1.0, 4.0)}}
    simulation.add(name="lift", collider=slab, body={"type": "kinematic"}, transform={"position": (0.0, -0.5, 0.0)})
    simulation.add(name="crate", collider=BOX, body={}, transform={"position": (0.0, 0.5, 0.0)})
    simulation.step(60)
    assert asleep(simulation, "crate") == [True]
    simulation["lift"].motion.linear = (0.0, 0.005, 0.0)  # slower than what may fall asleep
    simulation.step(60)
    assert asleep(simulation, "crate") == [False]
    assert why_awake(simulation, "crate") == "'crate' is awake since 'lift', which moves, touches or holds it"
    assert simulation["crate"].transform.position[1] == pytest.approx(0.505, abs=1e-4)


def test_a_force_function_wakes_whom_it_begins_to_push() -> None:
    """Nobody knows beforehand what it does; it is asked about sleepers too."""
    simulation = stacks(0.0)
    pushing = [0.0]
    simulation.force_function(lambda world, rows: np.full((len(rows), 3), pushing), "lean")
    simulation.step(90)
    assert asleep(simulation, "a0", "a2") == [True, True]
    pushing[0] = 1.0
    simulation.step(2)
    assert asleep(simulation, "a0", "a2") == [False, False]


@pytest.mark.parametrize(
    "change",
    [
        _set("a1", "motion", "linear", (0.0, 0.0, 1.0)),
        _set("a1", "transform", "position", (0.0, 1.6, 0.0)),
        _set("a1", "rigid_body", "inverse_mass", 0.5),
        _push,
    ],
)
def test_a_change_right_after_a_snapshot_was_restored_wakes_too(change: Callable[[Simulation], Any]) -> None:
    """What the step does not know of, since it has not seen the world restored, counts all the same."""
    simulation = sleeping(0.0)
    restore_snapshot(simulation.world, take_snapshot(simulation.world))
    change(simulation)
    simulation.step()
    assert asleep(simulation, "a0", "a1", "a2") == [False] * 3


def test_what_was_changed_before_a_snapshot_is_restored_wakes_nobody() -> None:
    """The change is undone with the rest."""
    simulation = sleeping(0.0)
    snapshot = take_snapshot(simulation.world)
    simulation["a1"].motion.linear = (0.0, 0.0, 1.0)
    restore_snapshot(simulation.world, snapshot)
    simulation.step(2)
    assert asleep(simulation, "a0", "a1", "a2") == [True] * 3
