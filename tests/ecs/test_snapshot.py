"""A snapshot holds all state: what follows from it is the same to the last bit, and its hash tells states apart."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from heaps import bin_of_balls, hashes

from carom.ecs import (
    EntityError,
    Material,
    Motion,
    Resource,
    Snapshot,
    SnapshotError,
    Transform,
    World,
    bytes_from_snapshot,
    restore_snapshot,
    state_hash,
    take_snapshot,
)
from carom.ecs.component import Relation
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.enter import Inside
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.touching import Touching
from carom.ecs.snapshot import held_columns
from carom.ecs.snapshot_faults import SAVED
from carom.systems.detection.fcl_objects import FclObjects
from carom.systems.resting import Resting
from carom.systems.settings import Random
from carom.systems.simulation import Simulation


def bouncing_and_resting(**settings: Any) -> Simulation:
    """Return balls that bounce among boxes that come to rest, with a sensor and drag: much touches at any time."""
    simulation = Simulation(dt=1 / 120, seed=3, **settings)
    simulation.add(collider={"plane": {}}, name="floor")
    for k in range(3):
        place = {"position": (0.1 * k, 0.5 + 1.01 * k, 0.0)}
        simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform=place, name=f"box{k}")
    for k in range(8):
        simulation.add(
            collider={"sphere": {"radius": 0.2}},
            body={"mass": 1.0},
            material={"restitution": 0.7, "rolling_friction": 0.01},
            transform={"position": (0.9 + 0.41 * (k % 4), 0.3 + 0.5 * (k // 4), 0.05 * k)},
            motion={"linear": (-2.0, 0.0, 0.1 * k)},
            name=f"ball{k}",
        )
    trap = {"box": {"size": (1.0, 1.0, 1.0)}, "sensor": True}
    simulation.add(collider=trap, transform={"position": (1.5, 0.5, 0.0)}, name="trap")
    simulation.force("linear_drag", coefficient=0.01)
    return simulation


@pytest.mark.parametrize("collision", ["auto", "fcl"])
@pytest.mark.parametrize("frame", [1, 20, 60])
def test_a_restored_snapshot_has_the_same_future(frame: int, collision: str) -> None:
    """Balls bounce, boxes rest: warm starts and manifolds are in the snapshot, so not a bit differs afterwards."""
    simulation = bouncing_and_resting(collision=collision)
    simulation.step(frame)
    assert simulation.world.count(Contact) >= 8
    snapshot, then = take_snapshot(simulation.world), state_hash(simulation.world)
    expected = hashes(simulation, 30)
    restore_snapshot(simulation.world, snapshot)
    assert simulation.frame == frame
    assert state_hash(simulation.world) == then
    assert hashes(simulation, 30) == expected
    elsewhere = bouncing_and_resting(collision=collision)
    elsewhere.step(5)
    restore_snapshot(elsewhere.world, snapshot)
    assert hashes(elsewhere, 30) == expected


@pytest.mark.parametrize("frame", [20, 60])
def test_a_heap_restored_into_a_fresh_world_has_the_same_future(frame: int) -> None:
    """There the table of impacts is as small as at the start: its capacity is no state and changes no bit.

    When the flight stopped for a full table, that flight went on with other roundings and new patience.
    """
    simulation = bin_of_balls(60)
    simulation.step(frame)
    snapshot = take_snapshot(simulation.world)
    expected = hashes(simulation, 40)
    fresh, roomy = bin_of_balls(60), bin_of_balls(60)
    roomy.world.table(Impact).grow(8192, 0)
    assert simulation.world.table(Impact).capacity > fresh.world.table(Impact).capacity
    for other in (fresh, roomy):
        restore_snapshot(other.world, snapshot)
        assert hashes(other, 40) == expected


def test_caches_can_be_dropped_at_any_time() -> None:
    """FCL's objects, groups, queries and derived columns leave no trace in what follows, nor in the hash."""
    kept, dropping = bouncing_and_resting(), bouncing_and_resting()
    for _ in range(30):
        before = state_hash(dropping.world)
        dropping.world.add(FclObjects())
        dropping.world.add(Resting())
        dropping.world._queries.clear()
        for kind, table in dropping.world.tables.items():
            for name, column in kind.columns.items():
                if column.role not in SAVED:
                    table.arrays[name][:] = -77 if column.dtype.kind in "if" else 0
        assert state_hash(dropping.world) == before
        dropping.step()
        kept.step()
        assert state_hash(dropping.world) == state_hash(kept.world)


def test_who_came_and_went_is_undone() -> None:
    """Restoring brings back the despawned, removes the new, and gives rows out in the same order as before."""
    simulation = bouncing_and_resting()
    world = simulation.world
    simulation.step(10)
    world.despawn(world.find("ball3"), world.find("ball1"))
    snapshot = take_snapshot(world)
    ball, gone = world.find("ball0"), world.find("ball5")
    words = {"collider": {"sphere": {"radius": 0.1}}, "body": {}, "transform": {"position": (5.0, 1.0, 0.0)}}
    first = [simulation.add(**words), simulation.add(**words), simulation.add(**words)]
    expected = hashes(simulation, 5)
    world.spawn_many(100, Transform())
    world.despawn(gone)
    simulation.step(5)
    restore_snapshot(world, snapshot)
    assert world.row(gone) == world.row(world.find("ball5"))
    assert world.find("ball0") == ball
    assert world.count(Transform) == 11
    for entity in first:
        with pytest.raises(EntityError):
            world.row(entity)
    assert [simulation.add(**words), simulation.add(**words), simulation.add(**words)] == first
    assert hashes(simulation, 5) == expected


def test_the_random_generator_goes_on_where_it_was() -> None:
    """Its position is state, to the half of a draw that 32-bit numbers leave over."""
    simulation = Simulation(seed=5)
    generator = simulation.world[Random].generator
    generator.normal(size=3)
    generator.integers(0, 100, dtype=np.uint32)
    snapshot = take_snapshot(simulation.world)
    expected = [*generator.integers(0, 10**9, 3, dtype=np.uint32).tolist(), *generator.normal(size=3).tolist()]
    other = Simulation(seed=6)
    for world in (simulation.world, other.world):
        restore_snapshot(world, snapshot)
        drawn = world[Random].generator
        assert [*drawn.integers(0, 10**9, 3, dtype=np.uint32).tolist(), *drawn.normal(size=3).tolist()] == expected


class Weather(Resource):
    """A resource with a state that it takes back only if it is fair."""

    def __init__(self, sky: bytes) -> None:
        self.sky = sky

    def state(self) -> bytes:
        """Return the sky."""
        return self.sky

    def restore(self, state: bytes) -> None:
        """Take back a sky without storms."""
        self.sky = state
        if state == b"storm":
            raise SnapshotError("no storms here")


def refused(world: World, snapshot: Snapshot) -> str:
    """Return the message with which a snapshot is refused; the world is as it was before."""
    before = bytes_from_snapshot(take_snapshot(world))
    with pytest.raises(SnapshotError) as fault:
        restore_snapshot(world, snapshot)
    assert bytes_from_snapshot(take_snapshot(world)) == before
    return str(fault.value)


def test_a_snapshot_of_another_kind_of_world_is_refused() -> None:
    """With all that does not fit, and nothing is changed: neither by halves nor in part."""
    simulation = bouncing_and_resting()
    simulation.step(20)
    snapshot = take_snapshot(simulation.world)
    world = World()
    world.add(Weather(b"sun"))
    world.spawn(Transform(position=(1.0, 2.0, 3.0)))
    rows, columns = snapshot.tables[Motion]
    wrong = {name: values for name, values in columns.items() if name != "angular"} | {
        "linear": columns["linear"].astype(np.float32),
        "colour": columns["linear"],
    }
    assert isinstance(rows, slice)
    outside = (slice(rows.start + 8, rows.stop + 8), snapshot.tables[Transform][1])
    tables = snapshot.tables | {Motion: (rows, wrong), Transform: outside}
    assert refused(world, replace(snapshot, tables=tables)) == (
        "the snapshot does not fit this world:\n"
        "  it holds Motion.colour, which is no state here\n"
        "  Motion.linear is float32 of shape (11, 3), declared here is float64 of shape (11, 3)\n"
        "  it does not hold Motion.angular\n"
        "  Transform.position is float64 of shape (13, 3), declared here is float64 of shape (11, 3)\n"
        "  Transform.rotation is float64 of shape (13, 4), declared here is float64 of shape (11, 4)\n"
        "  Transform stands in rows where nobody lives\n"
        "  it holds Random, which this world does not have; add it with world.add(Random(...))\n"
        "  it does not hold Weather, whose state this world needs"
    )


def test_who_lives_must_make_sense() -> None:
    """Two rows of one id, or a list cut short, would break the world later."""
    world = World()
    world.spawn_many(3, Transform())
    snapshot = take_snapshot(world)
    twice = snapshot.slots | {"id_shift": np.array([1, 0, 0], np.int32)}
    short = snapshot.slots | {"generations": snapshot.slots["generations"][:2]}
    for slots in (twice, short):
        assert refused(world, replace(snapshot, slots=slots)) == (
            "the snapshot does not fit this world:\n  its table of who lives contradicts itself"
        )
    without = {name: values for name, values in snapshot.slots.items() if name != "died_at"}
    assert refused(world, replace(snapshot, slots=without)) == (
        "the snapshot does not fit this world:\n  its table of who lives has other columns than here"
    )


def test_handles_that_never_were_are_no_state() -> None:
    """Kernels look them up by number, without asking whether the number is one."""
    simulation = bouncing_and_resting()
    simulation.step(20)
    snapshot = take_snapshot(simulation.world)
    snapshot.tables[Contact][1]["b"][2] = 12_345
    assert refused(simulation.world, snapshot) == (
        "the snapshot does not fit this world:\n  Contact.b holds entities that never lived"
    )


def test_what_a_resource_refuses_changes_no_other() -> None:
    """The generator, restored before it, is set back too."""
    simulation = Simulation(seed=2)
    simulation.world.add(Weather(b"storm"))
    snapshot = take_snapshot(simulation.world)
    simulation.world[Random].generator.normal()
    simulation.world.add(Weather(b"rain"))
    assert refused(simulation.world, snapshot) == "no storms here"
    assert simulation.world[Weather].sky == b"rain"


def test_memory_of_a_snapshot_nobody_needs_is_taken_over() -> None:
    """If it is large enough; what is in the new snapshot is the same."""
    simulation = bouncing_and_resting()
    simulation.step(20)
    old = take_snapshot(simulation.world)
    simulation.step(1)
    fresh = take_snapshot(simulation.world)
    reused = take_snapshot(simulation.world, reuse=old)
    assert reused.memory is old.memory
    assert bytes_from_snapshot(reused) == bytes_from_snapshot(fresh)
    simulation.world.spawn_many(1000, Transform())
    assert take_snapshot(simulation.world, reuse=old).memory is not old.memory


def test_the_hash_changes_with_every_state_column() -> None:
    """One bit of one row of any saved column makes another hash, and undoing it the old one."""
    simulation = bouncing_and_resting()
    simulation.step(60)
    columns = [(kind, name) for kind, _, names in held_columns(simulation.world) for name in names]
    assert {kind for kind, _ in columns} >= {Transform, Motion, Material, Contact, Inside, Touching}
    before = state_hash(simulation.world)
    for kind, name in columns:
        array = simulation.world.table(kind).arrays[name]
        row = 0 if issubclass(kind, Relation) else int(simulation.world.row_numbers(kind)[0])
        raw = array[row : row + 1].view(np.uint8)
        raw.flat[0] ^= 1
        assert state_hash(simulation.world) != before, f"{kind.__name__}.{name}"
        raw.flat[0] ^= 1
        assert state_hash(simulation.world) == before


def test_the_hash_changes_with_who_has_what() -> None:
    """A component more, an entity more, even with no component, another frame or the draw of a number."""
    found = {state_hash(bouncing_and_resting().world)}
    for change in (
        lambda s: s.world.attach(s.world.find("floor"), Motion()),
        lambda s: s.world.spawn(Transform()),
        lambda s: s.world.spawn(),
        lambda s: setattr(s.world, "frame", 1),
        lambda s: s.world.despawn(s.world.find("ball7")),
        lambda s: s.world[Random].generator.normal(),
    ):
        simulation = bouncing_and_resting()
        change(simulation)
        found.add(state_hash(simulation.world))
    assert len(found) == 7
