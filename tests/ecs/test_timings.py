"""Every system is measured in every frame, and that is no part of the state."""

from __future__ import annotations

from typing import Any

import pytest
from named_systems import named

from carom.ecs import Phase, Schedule, System, Transform, World, every, state_hash, take_snapshot
from carom.ecs.commands import Commands
from carom.ecs.timings import COMMANDS, Timings


@pytest.fixture
def ticking(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Replace the clock by a number of milliseconds that systems add to."""
    now = [0]
    monkeypatch.setattr("carom.ecs.phase.perf_counter_ns", lambda: now[0] * 1_000_000)
    return now


def busy(now: list[int], name: str, milliseconds: int, **declared: Any) -> System:
    """Return a system that takes so long."""

    def work(world: World) -> None:
        now[0] += milliseconds
        if Commands in declared.get("writes", ()):
            world[Commands].ask(lambda world: now.__setitem__(0, now[0] + 1))

    return named(name, work, **declared)


def test_every_system_is_timed(ticking: list[int]) -> None:
    """Seconds and calls in the last frame and in all; commands count for themselves, listeners for nobody."""
    world = World()
    world.add(Commands())
    schedule = Schedule(
        Phase("first", busy(ticking, "ask", 2, writes=(Commands,)), busy(ticking, "rare", 6, when=every(2))),
        Phase("second", busy(ticking, "solve", 3), repeat=lambda world: 4),
    )
    for _ in range(3):
        world.frame += 1
        schedule.run(world, 0.1, after=lambda system: ticking.__setitem__(0, ticking[0] + 100))
    timings = world[Timings]
    assert timings.frames == 3
    assert list(timings) == ["ask", "rare", "solve", COMMANDS]
    assert timings["solve"] == pytest.approx((0.012, 4, 0.036, 12))
    assert timings["ask"] == pytest.approx((0.002, 1, 0.006, 3))
    assert timings["rare"] == pytest.approx((0.0, 0, 0.006, 1))
    assert timings[COMMANDS] == pytest.approx((0.001, 2, 0.003, 6))
    assert timings.table() == (
        "system      ms per frame  share  last ms  calls\n"
        "----------  ------------  -----  -------  -----\n"
        "solve             12.000    71%   12.000     12\n"
        "ask                2.000    12%    2.000      3\n"
        "rare               2.000    12%    0.000      1\n"
        "(commands)         1.000     6%    1.000      6\n"
        "all               17.000   100%   15.000\n"
    )
    timings.clear()
    assert timings.table().splitlines()[2:] == ["all            0.000           0.000"]
    schedule.run(world, 0.1)
    assert timings["solve"] == pytest.approx((0.012, 4, 0.012, 4))


def test_a_phase_within_another_is_timed_once(ticking: list[int]) -> None:
    """What its systems take is not counted for who comes after it, also where it ends before its last repeat."""
    world = World()
    inner = Phase("inner", busy(ticking, "inside", 2), repeat=lambda world: 3, when=lambda world: ticking[0] < 4)
    Schedule(Phase("outer", busy(ticking, "before", 1), inner, busy(ticking, "behind", 8))).run(world, 0.1)
    assert dict(world[Timings]) == {
        "before": pytest.approx((0.001, 1, 0.001, 1)),
        "inside": pytest.approx((0.004, 2, 0.004, 2)),
        "behind": pytest.approx((0.008, 1, 0.008, 1)),
        COMMANDS: pytest.approx((0.0, 1, 0.0, 1)),
    }


def test_another_schedule_keeps_the_times_of_those_it_has(ticking: list[int]) -> None:
    """Those it has not are gone from the timings, new ones begin."""
    world = World()
    schedule = Schedule(Phase("only", busy(ticking, "stay", 1), busy(ticking, "go", 2)))
    schedule.run(world, 0.1)
    schedule.replace("go", busy(ticking, "come", 4)).run(world, 0.1)
    timings = world[Timings]
    assert dict(timings) == {
        "stay": pytest.approx((0.001, 1, 0.002, 2)),
        "come": pytest.approx((0.004, 1, 0.004, 1)),
        COMMANDS: pytest.approx((0.0, 1, 0.0, 2)),
    }


def test_timings_are_no_state() -> None:
    """Neither the hash nor a snapshot knows of them."""
    world = World()
    world.spawn(Transform())
    before = state_hash(world)
    Schedule(Phase("only", named("rest"))).run(world, 0.1)
    assert Timings in world
    assert state_hash(world) == before
    assert take_snapshot(world).resources == {}
