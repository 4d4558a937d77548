"""Forces that stay the same within a step are summed once in it, and nobody can tell from what bodies do."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from onlookers import looked_on
from sleepers import BALL, BOX, asleep, stacks

from carom.ecs import ExternalForce, Motion, Timings, World, restore_snapshot, state_hash, system, take_snapshot
from carom.systems.simulation import Simulation


@system()
def look_on(world: World, dt: float) -> None:
    """Do nothing; but with a system that is not carom's in the frame, forces may do anything."""


def tumbling(integrator: str) -> Simulation:
    """Return bodies that fall on a stack, one of them damped, one hung on a joint, one without gravity."""
    simulation = stacks(0.0, integrator=integrator)
    for k, body in enumerate(({"linear_damping": 0.3, "angular_damping": 0.2}, {}, {"gravity_scale": 0.0})):
        simulation.add(
            name=f"falling{k}",
            collider=BALL if k else BOX,
            body={"mass": 1.0 + k, **body},
            transform={"position": (0.3 * k, 4.5 + k, 0.1)},
            motion={"linear": (0.0, -2.0, 0.1), "angular": (1.0, 2.0, 3.0)},
        )
    simulation.add(joint={"ball": {"b": "falling1", "at": (0.0, 6.5, 0.1)}})
    return simulation


def woken(integrator: str) -> Simulation:
    """Return a stack that sleeps, and a ball before it that is struck by another within the first step.

    As from a file: what of forces was known when the stack fell asleep is not known here.
    """
    slept, simulation = (stacks(0.0, integrator=integrator) for _ in range(2))
    slept.step(90)
    assert asleep(slept, "a0", "a1", "a2") == [True] * 3
    restore_snapshot(simulation.world, take_snapshot(slept.world))
    for x, speed in ((-1.5, 0.0), (-2.8, 60.0)):
        simulation.add(
            collider=BALL, body={"mass": 1.0, "gravity_scale": 0.0}, material={"restitution": 1.0},
            transform={"position": (x, 2.2, 0.0)}, motion={"linear": (speed, 0.0, 0.0)},
        )  # fmt: skip
    return simulation


def test_no_law_is_asked_where_there_is_none() -> None:
    """Once there is one, all are, in each substep."""
    simulation, calls = stacks(0.0), []
    for _ in range(2):
        simulation.step()
        calls.append([simulation.world[Timings][f"apply_{name}"].last_calls for name in ("wind", "lift", "springs")])
        simulation.force("wind", velocity=(1.0, 0.0, 0.0))
    assert calls == [[0, 0, 0], [4, 4, 4]]


@pytest.mark.parametrize("integrator", ["euler", "semi_implicit", "verlet"])
@pytest.mark.parametrize("make", [tumbling, woken])
def test_the_same_comes_out(make: Callable[[str], Simulation], integrator: str) -> None:
    """To the last bit, as where they are summed in every substep."""
    once, always = make(integrator), make(integrator)
    always.schedule = always.schedule.insert(look_on, after="apply_gravity")
    for _ in range(40):
        for simulation in (once, always):
            simulation.step()
        assert state_hash(once.world) == state_hash(always.world)
    assert once.world[Motion].linear.any()


def runs(simulation: Simulation) -> int:
    """Return how often weights are summed in a step."""
    simulation.step()
    return simulation.world[Timings].calls["apply_gravity"]


def falling() -> Simulation:
    """Return a ball and a box in free fall."""
    simulation = Simulation()
    for name, collider, x in (("ball", BALL, 0.0), ("box", BOX, 2.0)):
        simulation.add(name=name, collider=collider, body={"mass": 1.0}, transform={"position": (x, 5.0, 0.0)})
    return simulation


def push(simulation: Simulation, by: str) -> None:
    """Push the box from outside, by its force or torque."""
    with simulation.world.edit(ExternalForce) as external:
        getattr(external, by)[simulation.world.row(simulation.world.find("box"))] = (0.0, 0.0, 0.1)


def test_what_stays_is_summed_once() -> None:
    """Weight, damping and a force from outside."""
    simulation = falling()
    push(simulation, "force")
    assert runs(simulation) == 1


@pytest.mark.parametrize(
    "change",
    [
        lambda simulation: simulation.force("linear_drag", coefficient=1.0),
        lambda simulation: simulation.add(spring={"a": simulation.world.find("ball"), "stiffness": 10.0}),
        lambda simulation: setattr(simulation, "schedule", simulation.schedule.insert(look_on, after="kick")),
        lambda simulation: push(simulation, "torque"),
        looked_on,
    ],
    ids=["law", "spring", "own system", "torque", "heard"],
)
def test_what_may_change_is_summed_in_every_substep(change: Callable[[Simulation], object]) -> None:
    """By where bodies are, how fast, and when; and where somebody hears of every force."""
    simulation = falling()
    change(simulation)
    assert runs(simulation) == 4
