"""Two simulations side by side: the system after which they differ is named, with what it wrote."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from carom.ecs import Force, Motion, Transform, World, restore_snapshot, state_hash, take_snapshot
from carom.ecs.column import Floats, Integers
from carom.systems.divergence import first_divergence
from carom.systems.simulation import Simulation


def falling(**settings: object) -> Simulation:
    """Return a box and two balls that fall onto a floor."""
    simulation = Simulation(dt=1 / 60, **settings)
    simulation.add(collider={"plane": {}}, name="floor")
    for k, shape in enumerate(({"box": {"size": (1.0, 1.0, 1.0)}}, {"sphere": {"radius": 0.4}})):
        place = {"position": (1.5 * k, 0.6, 0.0)}
        simulation.add(collider=shape, body={"mass": 1.0}, transform=place, name=("box", "ball")[k])
    return simulation


def test_equal_simulations_do_not_diverge() -> None:
    """However many steps they take; both have taken them."""
    a, b = falling(), falling()
    assert first_divergence(a, b, 20) is None
    assert (a.frame, b.frame) == (20, 20)


def test_a_difference_from_the_start_needs_no_step() -> None:
    """It is told as it is."""
    a, b = falling(), falling()
    b.world.spawn(Transform(), name="extra")
    assert str(first_divergence(a, b, 20)) == "frame 0: entity 'extra' lives only in the second"
    assert a.frame == 0


def test_another_gravity_is_found_where_it_is_first_felt() -> None:
    """Before any velocity or force: detection foresees how far bodies fall within the step."""
    found = first_divergence(falling(), falling(gravity=(0.0, -9.8, 0.0)), 5)
    assert found is not None
    assert str(found) == (
        "frame 1, system 'place_colliders', run 1 in phase 'detect': ColliderPose.lower[0] of entity 'box' is "
        f"{found.first!r} in the first and {found.second!r} in the second, {found.ulps} ulps apart"
    )
    assert found.first < found.second
    assert (found.system, found.phase, found.run, found.component) == ("place_colliders", "detect", 1, "ColliderPose")


def one_place_more(when: Callable[[World], bool]) -> Callable[[World, Integers], Floats]:
    """Return a force law of no force, but for 1e-9 N on the last body when ``when`` says so."""

    def nudge(world: World, rows: Integers) -> Floats:
        force = np.zeros((len(rows), 3))
        force[-1, 2] = 1e-9 * when(world)
        return force

    return nudge


@pytest.mark.parametrize("both", [True, False])
def test_a_force_in_one_of_them_is_named(both: bool) -> None:
    """In its frame; whether the other has a system of that name or none, and whatever has left derived columns."""
    a, b = falling(), falling()
    b.step(3)
    restore_snapshot(b.world, take_snapshot(a.world))
    b.force_function(one_place_more(lambda world: world.frame == 12), "nudge")
    if both:
        a.force_function(one_place_more(lambda world: False), "nudge")
    found = first_divergence(a, b, 30)
    assert str(found) == (
        "frame 12, system 'nudge', run 1 in phase 'laws': Force.force[2] of entity 'ball' "
        f"is 0.0 in the first and 1e-09 in the second, {int(np.float64(1e-9).view('i8'))} ulps apart"
    )
    assert (a.frame, b.frame) == (12, 12)
    assert first_divergence(b, a, 1) is not None


def test_later_runs_in_a_frame_are_told_apart() -> None:
    """The third substep's force is named as run 3."""
    a, b = falling(), falling()
    calls = iter(range(1000))
    b.force_function(one_place_more(lambda world: next(calls) % 4 == 2), "nudge")
    found = first_divergence(a, b, 30)
    assert found is not None
    assert (found.frame, found.system, found.run) == (1, "nudge", 3)


def test_no_system_is_named_where_the_frame_does_not_happen_again() -> None:
    """A force that counts its calls did it the first time only: told as found at the end of the frame."""
    a, b = falling(), falling()
    calls = iter(range(1000))
    b.force_function(one_place_more(lambda world: next(calls) == 9), "nudge")
    found = first_divergence(a, b, 30)
    assert found is not None
    assert (found.frame, found.system, found.entity) == (3, "", "ball")
    assert found.component in ("Motion", "Transform")


def test_observers_see_every_frame_once() -> None:
    """The frame that is run again is theirs already; what it leads to is the same."""

    class Watcher:
        def __init__(self) -> None:
            self.seen: list[tuple[int, str]] = []

        def begin(self, simulation: Simulation) -> None:
            """Do nothing."""

        def observe(self, simulation: Simulation) -> None:
            """Note frame and state."""
            self.seen.append((simulation.frame, state_hash(simulation.world)))

        def end(self, simulation: Simulation) -> None:
            """Do nothing."""

    a, b = falling(), falling()
    with b.world.edit(Motion) as motion:
        motion.linear[1, 0] = np.nextafter(0.0, 1.0)
    assert first_divergence(a, b, 3) is not None
    a, b, watcher = falling(), falling(gravity=(0.0, -9.8, 0.0)), Watcher()
    a.observers.append(watcher)
    assert first_divergence(a, b, 3) is not None
    assert watcher.seen == [(1, state_hash(a.world))]
    assert Force in a.world
