"""Systems touch only what they declare, schedules are checked when they are built, and changes wait for their phase."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from faults import error

from carom.ecs import (
    AccessError,
    Component,
    DeclarationError,
    EntityError,
    Motion,
    Phase,
    RigidBody,
    Schedule,
    System,
    Transform,
    World,
    column,
    system,
)
from carom.ecs.commands import Commands
from carom.ecs.component import Record
from carom.ecs.explain import explain
from carom.ecs.relations.contact import Contact
from carom.systems.kernels.forces import add_weight


class Scratch(Component):
    """Something one system leaves to a later one."""

    value = column(unit="1", doc="scratch", role="derived")


Record.registry.pop("scratch")


@system(writes=(Scratch,))
def write_scratch(world: World, dt: float) -> None:
    """Write the scratch."""


@system(reads=(Scratch,), writes=(Motion,))
def read_scratch(world: World, dt: float) -> None:
    """Read the scratch."""


@system(adds=(Scratch,))
def add_scratch(world: World, dt: float) -> None:
    """Add to the scratch."""


@pytest.fixture
def world() -> Iterator[World]:
    """Give a world of one entity and a command queue."""
    world = World()
    world.add(Commands())
    world.spawn(Transform(), Motion(), RigidBody(), Scratch(), name="ball")
    yield world


def run(world: World, *systems: System, checked: bool = True) -> None:
    """Run one frame of these systems."""
    Schedule(Phase("only", *systems)).run(world, 0.1, checked=checked)


def accumulate(world: World, dt: float) -> None:
    """Touch everything the tests below declare or do not."""
    world[Motion].linear[0] += dt


def touch_row(world: World, dt: float) -> None:
    """Reach an undeclared component through an entity."""
    world[0].motion.linear = (dt, 0.0, 0.0)


def weigh(world: World, dt: float) -> None:
    """Hand a column to a kernel that writes it."""
    body = world[RigidBody]
    add_weight(world.row_numbers(RigidBody), body.mass, body.gravity_scale, dt, dt, dt, world[Motion].linear)


def resize(world: World, dt: float) -> None:
    """Resize a relation."""
    world.resize(Contact, 1)


@pytest.mark.parametrize(
    ("function", "access", "message"),
    [
        (
            accumulate,
            {"reads": (Transform,)},
            (
                "system 'accumulate' touches Motion but declares only Transform; "
                "add Motion to reads=, writes= or adds= of @system"
            ),
        ),
        (
            accumulate,
            {},
            (
                "system 'accumulate' touches Motion but declares only nothing; "
                "add Motion to reads=, writes= or adds= of @system"
            ),
        ),
        (
            accumulate,
            {"reads": (Transform, Motion)},
            (
                "system 'accumulate' writes to a column it declares to read (Transform, Motion); "
                "move the component to writes= (or adds=) of @system"
            ),
        ),
        (
            touch_row,
            {"writes": (Transform,)},
            (
                "system 'touch_row' touches Motion but declares only Transform; "
                "add Motion to reads=, writes= or adds= of @system"
            ),
        ),
        (
            touch_row,
            {"reads": (Motion,)},
            (
                "system 'touch_row' writes to a column it declares to read (Motion); "
                "move the component to writes= (or adds=) of @system"
            ),
        ),
        (
            weigh,
            {"reads": (RigidBody, Motion)},
            (
                "kernel 'add_weight' writes 'force', which is read-only here; "
                "declare the component in writes= (or adds=) of the calling @system"
            ),
        ),
        (resize, {"reads": (Contact,)}, "only a system that writes Contact may resize it"),
    ],
    ids=["undeclared", "nothing declared", "read", "undeclared by row", "read by row", "read by kernel", "resized"],
)
def test_undeclared_access_is_refused(
    world: World, function: Callable[[World, float], None], access: dict[str, Any], message: str
) -> None:
    """The message names the system, the component and the edit to make; nothing was written."""
    with error(AccessError, message):
        run(world, system(**access)(function))
    assert not world[Motion].linear.any()
    with error(ValueError, "assignment destination is read-only"):  # the guard is down, the world closed again
        world[Motion].linear[0] = 1.0


@pytest.mark.parametrize("access", ["writes", "adds"])
@pytest.mark.parametrize("checked", [True, False])
def test_declared_access_is_granted(world: World, access: str, checked: bool) -> None:
    """What is declared in writes or adds can be written, guarded or not, also through a row and by a kernel."""
    run(world, system(reads=(RigidBody,), **{access: (Motion,)})(weigh), checked=checked)
    run(world, system(**{access: (Motion,)})(accumulate), checked=checked)
    assert world[0].motion.linear.tolist() == [0.2, 0.2, 0.2]
    run(world, system(**{access: (Motion,)})(touch_row), checked=checked)
    assert world[0].motion.linear.tolist() == [0.1, 0.0, 0.0]


def test_a_fault_of_the_system_itself_comes_through(world: World) -> None:
    """Only writing to read-only columns is taken for an access fault."""

    @system(writes=(Motion,))
    def shaped(world: World, dt: float) -> None:
        world[Motion].linear[0] = (1.0, 2.0)

    with pytest.raises(ValueError, match=r"^could not broadcast input array from shape \(2,\) into shape \(3,\)$"):
        run(world, shaped)


def test_structural_changes_wait_for_the_end_of_their_phase(world: World) -> None:
    """Systems of the phase still see the entity, those of the next do not; changes come in the order asked."""
    seen: list[tuple[str, int]] = []

    @system(reads=(Commands,))
    def ask(world: World, dt: float) -> None:
        world[Commands].ask(lambda world: world.spawn(Transform(), name="new"))
        world[Commands].ask(lambda world: world.despawn(world.find("new"), 0))

    @system(reads=(Transform,))
    def look(world: World, dt: float) -> None:
        seen.append(("same", world.count(Transform)))

    @system(reads=(Transform,))
    def look_again(world: World, dt: float) -> None:
        seen.append(("next", world.count(Transform)))

    Schedule(Phase("first", ask, look), Phase("second", look_again)).run(world, 0.1, checked=True)
    assert seen == [("same", 1), ("next", 0)]
    assert world[Commands].queue == []
    with pytest.raises(EntityError, match=r"^no entity is named 'ball'$"):
        world.find("ball")


def test_a_phase_shares_the_step_among_its_repeats(world: World) -> None:
    """A phase run four times gives each run a quarter of dt; what listens hears of each."""
    shares: list[float] = []
    heard: list[str] = []

    @system()
    def note(world: World, dt: float) -> None:
        shares.append(dt)

    schedule = Schedule(Phase("substep", note, repeat=lambda world: 4))
    schedule.run(world, 0.5, after=lambda system: heard.append(system.name))
    assert shares == [0.125] * 4
    assert heard == ["note"] * 4


@pytest.mark.parametrize(
    ("phases", "faults"),
    [
        (
            [Phase("first", read_scratch), Phase("second", write_scratch)],
            [
                (
                    "system 'read_scratch' in phase 'first' needs Scratch, which neither files nor an earlier system "
                    "supply; place a system that writes it before"
                )
            ],
        ),
        (
            [Phase("first", add_scratch, read_scratch)],
            [
                f"system '{name}' in phase 'first' needs Scratch, which neither files nor an earlier system "
                "supply; place a system that writes it before"
                for name in ("add_scratch", "read_scratch")
            ],
        ),
        (
            [Phase("first", write_scratch)],
            ["Scratch is written by write_scratch and read by nobody; read it or remove it"],
        ),
        (
            [Phase("first", write_scratch, read_scratch), Phase("second", read_scratch)],
            ["system 'read_scratch' in phase 'second' is placed twice; place it once"],
        ),
    ],
    ids=["read before written", "supplied by nobody", "written and never read", "placed twice"],
)
def test_a_wrong_schedule_is_refused_when_built(phases: list[Phase], faults: list[str]) -> None:
    """All faults are told at once, each with the way to mend it."""
    with error(DeclarationError, "the schedule is wrong:\n  " + "\n  ".join(faults)):
        Schedule(*phases)


def test_explain_shows_phases_systems_and_access() -> None:
    """The table of a small schedule, to the letter."""
    schedule = Schedule(Phase("first", write_scratch, add_scratch), Phase("second", read_scratch, repeat=lambda w: 2))
    assert explain(schedule) == (
        "phase              system         reads    writes   adds\n"
        "-----------------  -------------  -------  -------  -------\n"
        "first              write_scratch           Scratch\n"
        "                   add_scratch                      Scratch\n"
        "second (repeated)  read_scratch   Scratch  Motion\n"
        "\n"
        "write_scratch  Write the scratch.\n"
        "add_scratch    Add to the scratch.\n"
        "read_scratch   Read the scratch.\n"
    )
