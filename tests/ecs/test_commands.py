"""Systems ask for structural changes, which come true between phases."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from faults import error

from carom.ecs import AccessError, Material, Motion, Name, Phase, RigidBody, Schedule, Transform, World, system
from carom.ecs.commands import Commands


def frame(world: World, function: Callable[[World], object], *, checked: bool = True) -> None:
    """Run one frame of one system."""

    @system(reads=(Transform,), writes=(Commands, Motion))
    def meddle(world: World, dt: float) -> None:
        function(world)

    Schedule(Phase("only", meddle)).run(world, 0.1, checked=checked)


@pytest.mark.parametrize(
    ("verb", "change"),
    [
        ("spawn", lambda world: world.spawn(Transform())),
        ("despawn", lambda world: world.despawn(0)),
        ("attach", lambda world: world.attach(0, Material())),
        ("detach", lambda world: world.detach(0, Transform)),
        ("compact", lambda world: world.compact()),
    ],
)
def test_a_structural_change_inside_a_system_is_refused(verb: str, change: Callable[[World], object]) -> None:
    """The message says how to ask for it; afterwards the world is open again."""
    world = World()
    world.add(Commands())
    ball = world.spawn(Transform())
    message = (
        f"system 'meddle' asks the world to {verb} while the step runs; "
        f"ask for it instead: world[Commands].ask(lambda world: world.{verb}(...)), with Commands in writes="
    )
    for checked in (True, False):
        with error(AccessError, message):
            frame(world, change, checked=checked)
    assert world.rows(Transform) == slice(0, 1)
    change(world)
    assert (ball in world) == (verb != "despawn")


def test_commands_come_true_in_the_order_asked() -> None:
    """Whoever is despawned twice, or gone when a change was asked for it, is no fault."""
    world = World()
    world.add(Commands())
    first, second, third = world.spawn_many(3, Transform(), names=list("abc")).tolist()

    def ask(world: World) -> None:
        commands = world[Commands]
        commands.spawn(Transform(), name="new")
        commands.spawn_many(2, Transform(), Motion(), names=["x", "y"])
        commands.attach(second, Material())
        commands.detach(third, Name)
        commands.despawn(first)
        commands.despawn(np.array([first, second]), world.query(Motion))
        commands.attach(first, Motion())
        commands.detach(first, Transform)
        commands.ask(lambda world: world.attach(world.find("new"), Motion()))
        assert world.count(Transform) == 3

    frame(world, ask)
    assert world.names() == ["new", "x", "y"]
    assert [entity in world for entity in (first, second, third)] == [False, False, True]
    assert world.query(Motion).entities.tolist() == [world.find("new"), world.find("x"), world.find("y")]


def test_commands_take_one_many_and_queries_like_the_world() -> None:
    """Values follow their entities, also where some of these are gone by then."""
    world = World()
    world.add(Commands())
    first, second, third = world.spawn_many(3, Transform()).tolist()

    def ask(world: World) -> None:
        commands = world[Commands]
        commands.despawn(second)
        commands.attach(np.array([third, second, first]), Motion(linear=np.outer([3.0, 2.0, 1.0], (1.0, 0.0, 0.0))))
        commands.attach(world.query(Transform), RigidBody(mass=[5.0, 6.0, 7.0], center_of_mass=(0.0, 1.0, 0.0)))
        commands.detach(np.array([second, first]), Transform)

    frame(world, ask)
    assert world[Motion].linear[:3, 0].tolist() == [1.0, 0.0, 3.0]
    assert world[RigidBody].mass[:3].tolist() == [5.0, 0.0, 7.0]
    assert world[RigidBody].center_of_mass[:3, 1].tolist() == [1.0, 0.0, 1.0]
    assert world.query(Transform).entities.tolist() == [third]
