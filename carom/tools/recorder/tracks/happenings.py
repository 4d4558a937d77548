"""Happenings: impacts, sensors entered and left and joints that break, as lines of a log at their simulated times."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from carom.ecs import World
from carom.ecs.column import Integers
from carom.ecs.relations.enter import Enter, Exit
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.joint_break import JointBreak
from carom.systems.simulation import Simulation
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import TIME, Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "log"
MOST_LINES = 50  # of impacts a step: beyond it nobody reads them, and a pile of bodies has thousands


class Happenings(Track):
    """Lines for what happened in every step, recorded frame or not."""

    key: ClassVar[str] = "log"
    every_step: ClassVar[bool] = True

    def __init__(self) -> None:
        self._pending: list[tuple[Stamp, str, str]] = []

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the lines with their times."""
        import rerun.blueprint as rrb

        columns = rrb.TextLogColumns(timeline_columns=[TIME], text_log_columns=["body"])
        layout.texts.append(rrb.TextLogView(origin=PATH, name="Log", columns=columns))

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep a line for each impact, sensor entered or left, and joint broken in the last step."""
        world = simulation.world
        impact = world[Impact]
        rows = self._kept(world, impact.a[: impact.count], impact.b[: impact.count])
        told = rows[:MOST_LINES]
        names = (world.names_told(handles[told]) for handles in (impact.a, impact.b))
        numbers = (getattr(impact, name)[told].tolist() for name in ("time", "speed", "impulse"))
        for a, b, time, speed, impulse in zip(*names, *numbers, strict=True):
            text = f"{a} and {b} strike at {speed:.3g} m/s, {impulse:.3g} N s"
            self._pending.append((Stamp(stamp.frame, time), "DEBUG", text))
        if len(rows) > MOST_LINES:
            self._pending.append((stamp, "DEBUG", f"{len(rows) - MOST_LINES} more impacts in this step"))
        self._tell_breaks(world, stamp)
        for table, crosses in ((world[Enter], "enters"), (world[Exit], "leaves")):
            for row in self._kept(world, table.entity[: table.count], table.sensor[: table.count]).tolist():
                text = f"{world.name(int(table.entity[row]))} {crosses} {world.name(int(table.sensor[row]))}"
                self._pending.append((Stamp(stamp.frame, float(table.time[row])), "INFO", text))

    def _tell_breaks(self, world: World, stamp: Stamp) -> None:
        broken = world[JointBreak]
        rows = self._kept(world, broken.a[: broken.count], broken.b[: broken.count])
        names = world.names_told(broken.joint[rows])
        for name, force, torque in zip(names, broken.force[rows], broken.torque[rows], strict=True):
            self._pending.append((stamp, "WARN", f"{name} breaks under {force:.3g} N and {torque:.3g} N m"))

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
