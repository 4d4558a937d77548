"""Schedules are changed by name in one line, and ask their conditions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from faults import error
from named_systems import named

from carom.ecs import (
    AccessError,
    Component,
    DeclarationError,
    Motion,
    Phase,
    Schedule,
    Transform,
    World,
    column,
)
from carom.ecs.commands import Commands
from carom.ecs.component import Record
from carom.ecs.explain import explain
from carom.ecs.system import every, system


class Draft(Component):
    """Something one system leaves to a later one."""

    value = column(unit="1", doc="scratch", role="derived")


Record.registry.pop("draft")


READ, WRITE, MOVE = named("read_draft", reads=(Draft,)), named("write_draft", writes=(Draft,)), named("move")
FRAME = Schedule(Phase("first", WRITE, MOVE), Phase("second", READ, repeat=lambda world: 2, when=every(1)))


def names(schedule: Schedule) -> list[tuple[str, str]]:
    """Return each system with its phase."""
    return [(phase.name, system.name) for phase, system in schedule]


# One line -------------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("change", "order"),
    [
        (lambda: FRAME.insert(named("fly"), after="write_draft"), "first: write_draft fly move, second: read_draft"),
        (lambda: FRAME.insert(named("fly"), before="read_draft"), "first: write_draft move, second: fly read_draft"),
        (
            lambda: FRAME.insert(named("fly"), named("land"), before="move"),
            "first: write_draft fly land move, second: read_draft",
        ),
        (lambda: FRAME.replace("move", named("fly")), "first: write_draft fly, second: read_draft"),
        (lambda: FRAME.replace("move", named("move")), "first: write_draft move, second: read_draft"),
        (lambda: FRAME.remove("move"), "first: write_draft, second: read_draft"),
        (lambda: FRAME.remove("write_draft", "read_draft"), "first: move, second: "),
    ],
    ids=["after", "before", "two", "another", "its like", "removed", "writer and reader"],
)
def test_a_schedule_is_changed_by_name(change: Callable[[], Schedule], order: str) -> None:
    """Another schedule comes out, with everything else as it was; the one asked is what it was."""
    changed = change()
    phases = (f"{phase.name}: {' '.join(system.name for _, system in phase)}" for phase in changed.phases)
    assert ", ".join(phases) == order
    assert changed.phases[1].repeat is FRAME.phases[1].repeat
    assert changed.phases[1].when is FRAME.phases[1].when
    assert names(FRAME) == [("first", "write_draft"), ("first", "move"), ("second", "read_draft")]


NEEDS = "needs Draft, which neither files nor an earlier system supply; place a system that writes it before"
THERE = "there are write_draft, move, read_draft"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda: FRAME.insert(named("fly"), after="moved"),
            f"no system is named 'moved'; did you mean 'move'? {THERE}",
        ),
        (lambda: FRAME.insert(named("fly"), before="kick"), f"no system is named 'kick'; {THERE}"),
        (
            lambda: FRAME.replace("raed_draft", named("fly")),
            f"no system is named 'raed_draft'; did you mean 'read_draft'? {THERE}",
        ),
        (lambda: FRAME.remove("move", "kick"), f"no system is named 'kick'; {THERE}"),
        *[
            (
                change,
                ('a system is inserted either before or after another; write insert(my_system, after="apply_gravity")'),
            )
            for change in (
                lambda: FRAME.insert(named("fly")),
                lambda: FRAME.insert(named("fly"), before="move", after="move"),
            )
        ],
        (
            lambda: FRAME.insert(named("move"), before="read_draft"),
            "with 'move' the schedule is wrong:\n  system 'move' in phase 'second' is placed twice; place it once",
        ),
        (
            lambda: FRAME.replace("move", WRITE),
            (
                "with 'write_draft' in the place of 'move' the schedule is wrong:\n"
                "  system 'write_draft' in phase 'first' is placed twice; place it once"
            ),
        ),
        (
            lambda: FRAME.insert(named("look", reads=(Draft,)), before="write_draft"),
            f"with 'look' the schedule is wrong:\n  system 'look' in phase 'first' {NEEDS}",
        ),
        (
            lambda: FRAME.remove("write_draft"),
            "without 'write_draft' the schedule is wrong:\n  system 'read_draft' in phase 'second' " + NEEDS,
        ),
        (
            lambda: FRAME.remove("read_draft", "move"),
            (
                "without 'read_draft', 'move' the schedule is wrong:\n"
                "  Draft is written by write_draft and read by nobody; read it or remove it"
            ),
        ),
        (
            lambda: FRAME.insert(test_a_schedule_is_changed_by_name, after="move"),  # type: ignore[arg-type]
            (
                "phase 'first' takes systems, received test_a_schedule_is_changed_by_name; "
                "write @system(reads=..., writes=...) above the function"
            ),
        ),
        (
            lambda: FRAME.replace("move", 3),  # type: ignore[arg-type]
            "phase 'first' takes systems, received 3; write @system(reads=..., writes=...) above the function",
        ),
        (lambda: every(0), "every() counts in frames, 1 or more; received 0"),
    ],
)
def test_a_wrong_change_is_refused(change: Callable[[], object], message: str) -> None:
    """The message says which name is unknown, or what the changed schedule would lack, and how to mend it."""
    with error(DeclarationError, message):
        change()


# Conditions -----------------------------------------------------------------------------------------------------------
def runs(world: World, schedule: Schedule, frames: int, *, checked: bool) -> list[str]:
    """Return what ran in a number of frames."""
    ran: list[str] = []
    for _ in range(frames):
        world.frame += 1
        schedule.run(world, 0.1, checked=checked, after=lambda system: ran.append(f"{system.name} {world.frame}"))
    return ran


@pytest.mark.parametrize("checked", [True, False])
def test_a_condition_is_asked_right_before(checked: bool) -> None:
    """A system's in every repeat, after those before it; a phase's once in a frame. What does not run is not told."""
    world = World()
    world.spawn(Transform())
    count = named("count", lambda world: world[Transform].position.__iadd__(1.0), writes=(Transform,))

    def odd(world: World) -> bool:
        return bool(world[Transform].position[0, 0] % 2)

    schedule = Schedule(
        Phase("rare", named("rarely"), when=every(3)),
        Phase("twice", count, named("half", reads=(Transform,), when=odd), repeat=lambda world: 2),
        Phase("none", named("never"), repeat=lambda world: 0),
    )
    assert runs(world, schedule, 3, checked=checked) == [
        *("count 1", "half 1", "count 1"),
        *("count 2", "half 2", "count 2"),
        *("rarely 3", "count 3", "half 3", "count 3"),
    ]


@pytest.mark.parametrize("checked", [True, False])
def test_a_phase_within_a_phase(checked: bool) -> None:
    """Is run in its place in every repeat, if its condition then holds, and its time is a part of the repeat's."""
    world, shares = World(), []
    world.spawn(Transform())
    count = named("count", lambda world: world[Transform].position.__iadd__(1.0), writes=(Transform,))

    def odd(world: World) -> bool:
        return bool(world[Transform].position[0, 0] % 2)

    @system(reads=(Transform,))
    def inside(world: World, dt: float) -> None:
        shares.append(dt)

    inner = Phase("inner", inside, repeat=lambda world: 2, when=odd)
    schedule = Schedule(Phase("outer", count, inner, named("last"), repeat=lambda world: 4))
    in_each = [*("count 1", "inside 1", "inside 1", "last 1"), *("count 1", "last 1")]
    assert runs(world, schedule, 1, checked=checked) == 2 * in_each
    assert shares == 4 * [0.1 / 4 / 2]
    assert names(schedule) == [("outer", "count"), ("inner", "inside"), ("outer", "last")]
    assert names(schedule.insert(named("more"), after="inside"))[1:3] == [("inner", "inside"), ("inner", "more")]
    assert names(schedule.remove("inside")) == [("outer", "count"), ("outer", "last")]
    assert [line.split("  ")[0] for line in explain(schedule).splitlines()[2:5]] == [
        "outer (repeated)",
        "inner (repeated) (if odd)",
        "outer",
    ]


@pytest.mark.parametrize("of_phase", [True, False])
@pytest.mark.parametrize(
    ("look", "message"),
    [
        (
            lambda world: world[Motion].linear.any(),
            "{condition} touches Motion but declares only Transform; add Motion to reads= of {owner}",
        ),
        (
            lambda world: world[Transform].position.fill(1.0),
            (
                "{condition} writes to a column it declares to read (Transform); "
                "a condition only looks; write in the system"
            ),
        ),
    ],
    ids=["undeclared", "written"],
)
def test_a_condition_sees_what_its_systems_declare(look: Any, message: str, of_phase: bool) -> None:
    """In checked mode it reads that and writes nothing."""
    look.__name__ = "at_night"
    glow = named("glow", writes=(Transform,), when=None if of_phase else look)
    schedule = Schedule(Phase("lamps", glow, when=look if of_phase else None))
    world = World()
    world.spawn(Transform(), Motion())
    one = "phase 'lamps'" if of_phase else "system 'glow'"
    owner = "one of its systems" if of_phase else "the system"
    with error(AccessError, message.format(condition=f"condition 'at_night' of {one}", owner=owner)):
        schedule.run(world, 0.1, checked=True)
    assert not world[Transform].position.any()


class Asleep:
    """A condition with a memory."""

    def __call__(self, world: World) -> bool:
        """Hold."""
        return True


def test_explain_shows_conditions() -> None:
    """Behind the name of what waits for them."""
    schedule = Schedule(
        Phase("first", named("glow", when=every(2)), named("move")),
        Phase("second", named("rest"), repeat=lambda world: 2, when=Asleep()),
    )
    assert explain(schedule).splitlines()[2:5] == [
        "first                          glow (if every(2))",
        "                               move",
        "second (repeated) (if Asleep)  rest",
    ]


# Who runs -------------------------------------------------------------------------------------------------------------
def test_the_world_knows_who_runs() -> None:
    """Systems and their conditions are known while they run, so that misuse is told by name; commands are nobody's."""
    world = World()
    world.add(Commands())
    seen: list[str | None] = []

    def look(world: World) -> bool:
        seen.append(None if world.running is None else world.running.name)
        return True

    ask = named("ask", lambda world: world[Commands].ask(look), writes=(Commands,), when=look)
    Schedule(Phase("only", ask, named("see", look))).run(world, 0.1, checked=True)
    assert seen == ["ask", "see", None]
    assert world.running is None
