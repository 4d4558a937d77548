"""Happenings: who strikes, touches, parts, enters and leaves, and joints that break, as lines at simulated times."""

from __future__ import annotations

from itertools import chain
from typing import Any, ClassVar

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

STRIKE, TOUCH, PART = "%s and %s strike at %.3g m/s, %.3g N s", "%s and %s touch", "%s and %s part"
ENTER, LEAVE = "%s enters %s", "%s leaves %s"
BREAK, MORE = "%s breaks under %.3g N and %.3g N m", "%d more impacts and contacts in this step"
END = "\0"  # of a line, while all are put into words at once, which takes a third of doing so one by one


class Happenings(Track):
    """Lines for what happened in every step, recorded frame or not."""

    key: ClassVar[str] = "log"
    every_step: ClassVar[bool] = True

    def __init__(self) -> None:
        self._begin()
        self._structure = -1
        self._names: dict[int, str] = {}  # that were told while nobody came or went

    def _begin(self) -> None:
        """Begin a block without lines: when each is, how loud, in which words, and what goes into these."""
        self._stamps: list[Stamp] = []
        self._levels: list[str] = []
        self._words: list[str] = []
        self._values: list[Any] = []

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
        for table, crosses in ((world[Enter], ENTER), (world[Exit], LEAVE)):
            if table.count:
                rows = self._kept(world, table.entity[: table.count], table.sensor[: table.count])
                names = [world.names_told(handles[rows]) for handles in (table.entity, table.sensor)]
                self._tell(stamp.frame, table.time[rows].tolist(), ["INFO"] * len(rows), crosses, *names)

    def _tell(self, frame: int, times: list[float], levels: list[str], words: str, *values: list[Any]) -> None:
        """Keep lines in the same words, with a value of each list."""
        self._stamps += [Stamp(frame, time) for time in times]
        self._levels += levels
        self._words += [words] * len(times)
        self._values += chain.from_iterable(zip(*values, strict=True))

    def _tell_breaks(self, world: World, stamp: Stamp) -> None:
        broken = world[JointBreak]
        if not broken.count:
            return
        rows = self._kept(world, broken.a[: broken.count], broken.b[: broken.count])
        values = world.names_told(broken.joint[rows]), broken.force[rows].tolist(), broken.torque[rows].tolist()
        self._tell(stamp.frame, [stamp.time] * len(rows), ["WARN"] * len(rows), BREAK, *values)

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
        names, times = self._told(world, np.concatenate([a[told], b[told]])), time[told].tolist()
        one, other = names[: len(told)], names[len(told) :]
        struck, touch = np.searchsorted(told, (impact.count, impact.count + len(quiet))).tolist()
        speeds, impulses = (values[told[:struck]].tolist() for values in (impact.speed, impact.impulse))
        loud = world[Settings].hit_speed
        levels = ["INFO" if speed >= loud else "DEBUG" for speed in speeds]
        strikes = slice(0, struck)
        self._tell(stamp.frame, times[strikes], levels, STRIKE, one[strikes], other[strikes], speeds, impulses)
        for words, part in ((TOUCH, slice(struck, touch)), (PART, slice(touch, len(told)))):
            self._tell(stamp.frame, times[part], ["DEBUG"] * len(times[part]), words, one[part], other[part])
        if len(rows) > len(told):
            self._tell(stamp.frame, [stamp.time], ["DEBUG"], MORE, [len(rows) - len(told)])

    def _told(self, world: World, entities: Integers) -> list[str]:
        """Return names; as soon as nobody comes or goes those of all are asked for at once."""
        if self._structure != world.structure:
            self._structure, self._names = world.structure, {}
            return world.names_told(entities)
        if not self._names:
            everybody = world.handles()
            self._names = dict(zip(everybody.tolist(), world.names_told(everybody), strict=True))
        names = self._names
        return [names[handle] if handle in names else world.name(handle) for handle in entities.tolist()]

    def _kept(self, world: World, a: Integers, b: Integers) -> Integers:
        """Return the rows of a table of pairs in which somebody is chosen."""
        if self.only is None:
            return np.arange(len(a))
        return np.nonzero(self.only.has(world, a) | self.only.has(world, b))[0]

    def write(self, stream: Stream) -> None:
        """Put the kept lines into words and write them."""
        import rerun

        if self._stamps:
            texts = (END.join(self._words) % tuple(self._values)).split(END)
            stream.rows(PATH, self._stamps, rerun.TextLog.columns(text=texts, level=self._levels))
            self._begin()
