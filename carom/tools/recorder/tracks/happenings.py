"""Happenings: who strikes, touches, parts, enters and leaves, and joints that break, as lines at simulated times."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from carom.ecs import World
from carom.ecs.column import Integers
from carom.ecs.relations.enter import Enter, Exit
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.joint_break import JointBreak
from carom.ecs.relations.touching import ContactBegin, ContactEnd
from carom.systems.settings import Settings, time_of
from carom.systems.simulation import Simulation
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import TIME, Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "log"
MOST_LINES = 20  # of pairs a step: beyond it nobody reads them, and a pile of bodies has thousands

TOUCH, PART = ("DEBUG", "touch"), ("DEBUG", "part")


class Happenings(Track):
    """Lines for what happened in every step, recorded frame or not."""

    key: ClassVar[str] = "log"
    every_step: ClassVar[bool] = True

    def __init__(self) -> None:
        self._pending: list[tuple[Stamp, str, str]] = []
        self._structure = -1
        self._names: dict[int, str] = {}  # that were told while nobody came or went

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the lines with their times."""
        import rerun.blueprint as rrb

        columns = rrb.TextLogColumns(timeline_columns=[TIME], text_log_columns=["body"])
        layout.texts.append(rrb.TextLogView(origin=PATH, name="Log", columns=columns))

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep a line for each impact, pair that touches or parts, sensor entered or left, and joint that broke."""
        world = simulation.world
        self._tell_pairs(world, stamp)
        self._tell_breaks(world, stamp)
        for table, crosses in ((world[Enter], "enters"), (world[Exit], "leaves")):
            for row in self._kept(world, table.entity[: table.count], table.sensor[: table.count]).tolist():
                text = f"{world.name(int(table.entity[row]))} {crosses} {world.name(int(table.sensor[row]))}"
                self._pending.append((Stamp(stamp.frame, float(table.time[row])), "INFO", text))

    def _tell_breaks(self, world: World, stamp: Stamp) -> None:
        broken = world[JointBreak]
        if not broken.count:
            return
        rows = self._kept(world, broken.a[: broken.count], broken.b[: broken.count])
        names = world.names_told(broken.joint[rows])
        for name, force, torque in zip(names, broken.force[rows], broken.torque[rows], strict=True):
            self._pending.append((stamp, "WARN", f"{name} breaks under {force:.3g} N and {torque:.3g} N m"))

    def _tell_pairs(self, world: World, stamp: Stamp) -> None:
        """Tell of impacts first, which say that a pair begins to touch."""
        impact, begin, end = world[Impact], world[ContactBegin], world[ContactEnd]
        quiet = np.nonzero(begin.time[: begin.count] == time_of(world))[0]
        tables = (impact, slice(0, impact.count)), (begin, quiet), (end, slice(0, end.count))
        a, b, time = (np.concatenate([getattr(table, of)[rows] for table, rows in tables]) for of in ("a", "b", "time"))
        rows = self._kept(world, a, b)
        told = rows[:MOST_LINES]
        if not len(told):
            return
        names = self._told(world, np.concatenate([a[told], b[told]]))
        strikes = _strikes(world, told[told < impact.count])
        others = [TOUCH if row < impact.count + len(quiet) else PART for row in told[len(strikes) :].tolist()]
        lines = zip(time[told].tolist(), names, names[len(told) :], strikes + others, strict=False)
        for moment, one, other, (level, deed) in lines:
            self._pending.append((Stamp(stamp.frame, moment), level, f"{one} and {other} {deed}"))
        if len(rows) > len(told):
            more = f"{len(rows) - len(told)} more impacts and contacts in this step"
            self._pending.append((stamp, "DEBUG", more))

    def _told(self, world: World, entities: Integers) -> list[str]:
        """Return names; those not told before are asked for at once, which costs as much as ten lines."""
        if self._structure != world.structure:
            self._structure, self._names = world.structure, {}
        handles = entities.tolist()
        if new := [handle for handle in handles if handle not in self._names]:
            self._names |= zip(new, world.names_told(np.array(new)), strict=True)
        return [self._names[handle] for handle in handles]

    def _kept(self, world: World, a: Integers, b: Integers) -> Integers:
        """Return the rows of a table of pairs in which somebody is chosen."""
        if self.only is None:
            return np.arange(len(a))
        return np.nonzero(self.only.has(world, a) | self.only.has(world, b))[0]

    def write(self, stream: Stream) -> None:
        """Write the kept lines."""
        import rerun

        if self._pending:
            stamps, levels, texts = zip(*self._pending, strict=True)
            stream.rows(PATH, stamps, rerun.TextLog.columns(text=texts, level=levels))
            self._pending = []


def _strikes(world: World, rows: Integers) -> list[tuple[str, str]]:
    """Return level and words of impacts (rows); those that are hits are told louder."""
    impact, loud = world[Impact], world[Settings].hit_speed
    numbers = zip(impact.speed[rows].tolist(), impact.impulse[rows].tolist(), strict=True)
    return [
        ("INFO" if speed >= loud else "DEBUG", f"strike at {speed:.3g} m/s, {impulse:.3g} N s")
        for speed, impulse in numbers
    ]
