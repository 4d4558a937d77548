"""What has come to rest is left alone, bit for bit."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from sleepers import BALL, BOX, asleep, choose, sleeping, stacks

from carom.ecs import (
    Collider,
    Entity,
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
from carom.ecs.components.external_force import ExternalForce
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.sleeping_contact import SleepingContact
from carom.ecs.relations.touching import ContactBegin, ContactEnd, Touching
from carom.ecs.snapshot_bytes import bytes_from_snapshot, snapshot_from_bytes
from carom.systems.settings import Settings
from carom.systems.simulation import Simulation
from carom.systems.step import STEP

HIGH = {"position": (0.0, 30.0, 0.0)}


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


def test_what_drifts_slowly_never_falls_asleep() -> None:
    """Newton's first law: 1 mm/s for 20 s are 20 mm."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(name="drifter", collider=BOX, body={}, motion={"linear": (1e-3, 0.0, 0.0)})
    simulation.add(name="still", collider=BOX, body={}, transform={"position": (5.0, 0.0, 0.0)})
    simulation.step(1200)
    assert asleep(simulation, "drifter", "still") == [False, True]
    assert simulation["drifter"].transform.position[0] == pytest.approx(0.02, abs=1e-12)


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


def test_who_is_put_to_sleep_from_outside_sleeps_until_asked() -> None:
    """In mid-air, as long as nobody touches it."""
    simulation = Simulation()
    simulation.add(name="ball", collider=BALL, body={}, transform=HIGH)
    simulation["ball"].motion.asleep = True
    simulation.step(30)
    assert asleep(simulation, "ball") == [True]
    assert simulation["ball"].transform.position[1] == 30.0
    simulation.wake("ball")
    simulation.step()
    assert asleep(simulation, "ball") == [False]
    assert simulation["ball"].transform.position[1] < 30.0


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


@pytest.mark.parametrize("speed", [0.3, 0.6, 0.9, 1.2])
def test_who_sleeps_in_a_snapshot_is_found_from_as_far_as_before(speed: float) -> None:
    """A ball rolls up to a box that sleeps; from a snapshot of before, in another world, it wakes in the same step."""
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    simulation.add(name="box", collider=BOX, body={}, transform={"position": (0.0, 0.5, 0.0)})
    ball = simulation.add(collider=BALL, body={}, transform={"position": (-2.5, 0.5, 0.0)})
    while not simulation["box"].motion.asleep:
        simulation.step()
    simulation[ball].motion.linear[0] = speed
    simulation.step(10)
    assert simulation["box"].motion.asleep
    snapshot, frames = take_snapshot(simulation.world), []
    while simulation["box"].motion.asleep:
        simulation.step()
        frames.append(state_hash(simulation.world))
    other = Simulation()
    restore_snapshot(other.world, snapshot)
    for frame in frames:
        other.step()
        assert state_hash(other.world) == frame


def _write(name: str, kind: type, column: str, value: object) -> Callable[[Simulation], None]:
    def write(simulation: Simulation) -> None:
        world = simulation.world
        with world.edit(kind) as table:
            getattr(table, column)[world.row(world.find(name))] = value

    return write


def _open_settings(simulation: Simulation) -> None:
    with simulation.world.edit(Settings):
        simulation.wake("a2")


@pytest.mark.parametrize(  # where somebody is moved, all who sleep are woken after the snapshot
    ("disturb", "others"),
    [
        pytest.param(_write("a2", Motion, "linear", (1.0, 0.0, 0.0)), (4.0,), id="pushed"),
        pytest.param(_write("a2", ExternalForce, "force", (0.0, 50.0, 0.0)), (4.0,), id="pulled"),
        pytest.param(_write("a2", Transform, "position", (0.0, 4.0, 0.0)), (), id="lifted"),
        pytest.param(_write("floor", Transform, "position", (0.0, -1.5, 0.0)), (), id="floor lowered"),
        pytest.param(_write("a2", Material, "friction", 0.1), (4.0,), id="oiled"),
        pytest.param(_write("a2", RigidBody, "inverse_mass", 0.5), (4.0,), id="loaded"),
        pytest.param(
            lambda simulation: simulation.world.despawn(simulation.world.find("floor")), (4.0,), id="floor gone"
        ),
        pytest.param(lambda simulation: simulation.world.despawn(simulation.world.find("a1")), (4.0,), id="one gone"),
        pytest.param(
            lambda simulation: simulation.explode(impulse=20.0, position=(0.0, 0.0, 0.0)), (4.0,), id="blown up"
        ),
        pytest.param(lambda simulation: simulation.wake("a2"), (4.0,), id="woken"),
        pytest.param(_open_settings, (4.0,), id="settings opened, woken"),
    ],
)
def test_a_snapshot_between_a_change_and_the_step_that_answers_it_leads_where_the_change_leads(
    disturb: Callable[[Simulation], None], others: tuple[float, ...]
) -> None:
    """In this world and, as bytes, in another: who sleeps wakes as without it, and nobody else."""
    simulation = sleeping(0.0, *others)
    disturb(simulation)
    snapshot = take_snapshot(simulation.world)
    simulation.step()
    woken, other = asleep(simulation, "a0"), stacks(0.0, *others)
    assert woken == [False]
    simulation.step(9)
    future = state_hash(simulation.world)
    for again, kept in (
        (simulation, snapshot),
        (other, snapshot_from_bytes(bytes_from_snapshot(snapshot), other.world)),
    ):
        restore_snapshot(again.world, kept)
        again.step()
        assert asleep(again, "a0") == woken
        again.step(9)
        assert state_hash(again.world) == future


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


def test_a_step_in_which_all_sleep_asks_nobody() -> None:
    """No system of detection and substeps runs; those that a user puts into the frame do."""
    simulation = sleeping(0.0)
    run: list[str] = []
    simulation.step(after=lambda system: run.append(system.name))
    skipped = [system.name for phase, system in STEP if phase.name in ("detect", "substep", "forces", "laws")]
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
