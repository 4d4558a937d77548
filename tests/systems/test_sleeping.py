"""What has come to rest is left alone, bit for bit, and wakes as if it had never slept."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from carom.ecs import (
    Collider,
    Entity,
    ExternalForce,
    Material,
    Motion,
    RigidBody,
    Transform,
    World,
    restore_snapshot,
    state_hash,
    system,
    take_snapshot,
)
from carom.ecs.commands import Commands
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.ecs.relations.touching import ContactBegin, ContactEnd, Touching
from carom.systems.awake import Awake
from carom.systems.constants import SLEEP_SPEED
from carom.systems.detection.why import why_no_contact
from carom.systems.simulation import Simulation
from carom.systems.step import STEP
from carom.systems.why_awake import why_awake

BOX = {"box": {"size": (1.0, 1.0, 1.0)}}
BALL = {"sphere": {"radius": 0.5}}
FLOOR = {"box": {"size": (20.0, 1.0, 20.0)}}
HIGH = {"position": (0.0, 30.0, 0.0)}


def stacks(*places: float, high: int = 3, **settings: Any) -> Simulation:
    """Return stacks of cubes at places along x, on a floor: first of a0, a1 and so on, then of b0."""
    simulation = Simulation(**settings)
    simulation.add(name="floor", collider=FLOOR, transform={"position": (0.0, -0.5, 0.0)})
    for letter, x in zip("abc", places, strict=False):
        for k in range(high):
            simulation.add(
                name=f"{letter}{k}", collider=BOX, body={"mass": 1.0}, transform={"position": (x, 0.5 + k, 0)}
            )
    return simulation


def asleep(simulation: Simulation, *names: str) -> list[bool]:
    """Return who sleeps."""
    world = simulation.world
    return [bool(world[Motion].asleep[world.row(world.find(name))]) for name in names]


def sleeping(*places: float, **settings: Any) -> Simulation:
    """Return stacks that have fallen asleep."""
    simulation = stacks(*places, **settings)
    simulation.step(90)
    assert len(simulation.world[Awake].rows) == 0
    return simulation


def choose(simulation: Simulation, **settings: Any) -> None:
    """Let a world go on by other settings."""
    simulation.settings = replace(simulation.settings, **settings)
    simulation.world.add(simulation.settings)


def frozen_part(simulation: Simulation) -> list[bytes]:
    """Return what of a world is not to change while all sleep."""
    world = simulation.world
    columns = [(kind, name) for kind in (Transform, Motion, SleepingContact) for name in kind.columns]
    return [world.table(kind).arrays[name].tobytes() for kind, name in columns]


def test_what_sleeps_is_frozen_bit_for_bit() -> None:
    """Poses, velocities, timers and contacts stay as they are; time goes on."""
    simulation = sleeping(0.0, 4.0)
    before = frozen_part(simulation)
    assert simulation.world.count(SleepingContact) > 0
    assert simulation.world.count(Contact) == 0
    simulation.step(100)
    assert frozen_part(simulation) == before
    assert simulation.world.frame == 190


def test_what_sleeps_has_no_velocity_and_keeps_the_impulses_that_carry_it() -> None:
    """What carries sleepers can still be read: their weight times dt."""
    simulation = sleeping(0.0)
    world = simulation.world
    sleeps, dt = world[SleepingContact], simulation.settings.dt
    assert not world[Motion].linear.any()
    assert not world[Motion].angular.any()
    on_floor = sleeps.a[: sleeps.count] == world.find("floor")
    carried = sleeps.impulse[: sleeps.count][on_floor].sum()
    assert carried == pytest.approx(3.0 * 9.81 * dt, rel=1e-3)  # three cubes of 1 kg; what the relaxing leaves open


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


def test_who_sleeps_goes_on_touching() -> None:
    """To fall asleep ends no contact, to wake begins none, also while others move; to despawn does end them."""
    simulation = sleeping(0.0, 4.0)
    world = simulation.world
    pairs = world.count(Touching)
    assert pairs == 6
    simulation.add(collider=BALL, body={}, transform={"position": (-6.0, 20.0, 0.0)})
    for frame in range(60):
        if frame == 20:
            simulation.wake("a0")
        simulation.step()
        assert (world.count(ContactBegin), world.count(ContactEnd), world.count(Touching)) == (0, 0, pairs)
    world.despawn(world.find("b1"))
    simulation.step()
    assert (world.count(ContactBegin), world.count(ContactEnd), world.count(Touching)) == (0, 2, pairs - 2)


def test_islands_wake_one_by_one() -> None:
    """To wake one of a stack wakes that stack."""
    simulation = sleeping(0.0, 4.0)
    simulation.wake("a2")
    simulation.step()
    assert asleep(simulation, "a0", "a1", "a2", "b0", "b1", "b2") == [False] * 3 + [True] * 3
    assert simulation.world.count(Contact) == simulation.world.count(SleepingContact)


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


def test_what_drifts_slowly_never_falls_asleep() -> None:
    """Newton's first law: 1 mm/s for 20 s are 20 mm."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(name="drifter", collider=BOX, body={}, motion={"linear": (1e-3, 0.0, 0.0)})
    simulation.add(name="still", collider=BOX, body={}, transform={"position": (5.0, 0.0, 0.0)})
    simulation.step(1200)
    assert asleep(simulation, "drifter", "still") == [False, True]
    assert simulation["drifter"].transform.position[0] == pytest.approx(0.02, abs=1e-12)


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


def test_sleeping_is_a_choice() -> None:
    """Of a world, and of a body: it keeps its island awake."""
    simulation = stacks(0.0, sleeping=False)
    simulation.step(120)
    assert asleep(simulation, "a0", "a1", "a2") == [False] * 3
    simulation = sleeping(0.0)
    choose(simulation, sleeping=False)
    simulation.step()
    assert asleep(simulation, "a0", "a1", "a2") == [False] * 3
    simulation = stacks(0.0, 4.0)
    simulation["a1"].rigid_body.sleeps = False
    simulation.step(120)
    assert asleep(simulation, "a0", "a1", "a2", "b0") == [False] * 3 + [True]


def _drop(simulation: Simulation) -> list[str]:
    simulation.add(name="late", collider=BALL, body={}, transform={"position": (0.3, 4.5, 0.1)})
    hashes = []
    for _ in range(60):
        simulation.step()
        hashes.append(state_hash(simulation.world))
    assert asleep(simulation, "a0") == [False]
    return hashes


def test_a_snapshot_of_sleepers_goes_on_the_same_way() -> None:
    """The future is the same from a snapshot, in this world and in another, before and after they are woken."""
    simulation = sleeping(0.0, 4.0)
    snapshot = take_snapshot(simulation.world)
    simulation.step(10)
    future = state_hash(simulation.world)
    dropped = _drop(simulation)
    for other in (simulation, stacks(0.0, 4.0)):
        restore_snapshot(other.world, snapshot)
        other.step(10)
        assert state_hash(other.world) == future
        assert _drop(other) == dropped


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


def test_rows_may_change_under_sleepers() -> None:
    """Who sleeps is found again when a world is made compact, and wakes to the same bits."""
    futures = []
    for compacts in (False, True):
        simulation = stacks(0.0, 4.0)
        early: list[Entity] = [simulation.add(collider=BALL, transform={"position": (k, 50.0, 0)}) for k in range(3)]
        simulation.step(90)
        simulation.world.despawn(*early, simulation.world.find("b2"))
        if compacts:
            simulation.world.compact()
        simulation.step(40)
        assert asleep(simulation, "a0", "a1", "a2") == [True] * 3
        futures.append(_drop(simulation)[-1])
    assert futures[0] == futures[1]


def test_why_a_body_is_awake() -> None:
    """One reason at a time, with who it is, numbers and limits."""
    simulation = stacks(0.0)
    simulation.add(
        name="late", collider=BALL, body={}, transform={"position": (0.0, 3.5, 0.0)}, motion={"linear": (1, 0, 0)}
    )
    simulation.step()
    told = why_awake(simulation, "a0")
    assert told.startswith("'a0' is awake since 'late', in its island of 4 bodies, moves at ")
    assert told.endswith(" m/s; at 0.03 m/s or less it may fall asleep")
    assert why_awake(simulation.world, "floor") == "'floor' has no body; it stands"
    simulation = stacks(0.0)
    simulation.step(20)
    assert why_awake(simulation, "a2").startswith("'a2' is awake since 'a")
    assert why_awake(simulation, "a2").endswith(" s; after 0.5 s it falls asleep")
    simulation.step(60)
    assert why_awake(simulation, "a2") == "'a2' sleeps"
    assert why_awake(stacks(0.0, sleeping=False), "a0") == (
        "'a0' is awake since nobody falls asleep in this world: sleeping is off"
    )
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(name="drifter", collider=BOX, body={}, motion={"linear": (1e-3, 0.0, 0.0)})
    simulation.add(name="restless", collider=BOX, body={"sleeps": False}, transform={"position": (5.0, 0.0, 0.0)})
    simulation.add(name="lift", collider=BOX, body={"type": "kinematic"}, transform={"position": (9.0, 0.0, 0.0)})
    simulation.step(60)
    assert why_awake(simulation, "drifter") == (
        "'drifter' is awake since nothing that stands touches or holds it: what drifts slowly goes on"
    )
    assert why_awake(simulation, "restless") == (
        "'restless' is awake since it may not fall asleep: its body says so (sleeps)"
    )
    assert why_awake(simulation, "lift") == "'lift' is kinematic; it neither rests nor sleeps"
    simulation.force("mutual_gravitation")
    simulation.step()
    assert why_awake(simulation, "drifter") == (
        "'drifter' is awake since it is pushed another way in every step, by mutual_gravitation"
    )


def test_why_two_that_sleep_have_no_contact() -> None:
    """`why_no_contact` says that they sleep, and what there would be."""
    simulation = sleeping(0.0)
    told = why_no_contact(simulation, "a0", "a1")
    assert told.startswith(
        "'a0' and 'a1' sleep, so that nobody looks for contacts of the two; they are in contact: 4 poin"
    )
    told = why_no_contact(simulation, "floor", "a0")
    assert told.startswith("'a0' sleeps, so that nobody looks for contacts of the two; they are in contact: 4 points")
    simulation.wake("a0")
    simulation.step()
    assert why_no_contact(simulation, "floor", "a0").startswith("they are in contact: 4 points")


def test_a_step_in_which_all_sleep_asks_nobody() -> None:
    """No system of detection and substeps runs; those that a user puts into the frame do."""
    simulation = sleeping(0.0)
    run: list[str] = []
    simulation.step(after=lambda system: run.append(system.name))
    skipped = [system.name for phase, system in STEP if phase.name in ("detect", "substep")]
    assert (run[0], run[-1]) == ("begin_step", "check_finite")
    assert not set(run) & {*skipped, "hand_impulses_over", "tell_contacts", "fall_asleep"}
    assert Collider in simulation.world
    assert Material in simulation.world


def test_commands_between_the_phases_of_a_step_are_seen_at_once() -> None:
    """Who is removed or comes after detection is not flown on, or is, in the same step."""
    simulation = stacks(0.0)

    @system(writes=(Commands,))
    def exchange(world: World, dt: float) -> None:
        """Take a cube away and put a ball in, in the second step."""
        if world.frame == 2:
            world[Commands].ask(lambda world: world.despawn(world.find("a2")))
            world[Commands].ask(lambda world: simulation.add(name="ball", collider=BALL, body={}, transform=HIGH))

    simulation.schedule = simulation.schedule.insert(exchange, after="find_contacts")
    simulation.step(2)
    assert simulation["ball"].motion.linear[1] == pytest.approx(-9.81 / 60.0)
    simulation.step(60)
    assert asleep(simulation, "a0", "a1") == [True, True]
