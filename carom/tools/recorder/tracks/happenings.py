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
from carom.systems.settings import Settings
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
        left, more = MOST_LINES, 0
        for table, words in ((world[Impact], STRIKE), (world[ContactBegin], TOUCH), (world[ContactEnd], PART)):
            if not table.count:
                continue
            rows = self._kept(world, table.a[: table.count], table.b[: table.count])
            if isinstance(table, ContactBegin):  # without an impact, in which case it is at the end of the step
                rows = rows[table.time[rows] == stamp.time]
            told = rows[:left]
            left, more = left - len(told), more + len(rows) - len(told)
            if not len(told):
                continue
            names = self._told(world, table.a[told].tolist() + table.b[told].tolist())
            values: list[list[Any]] = [names[: len(told)], names[len(told) :]]
            levels = ["DEBUG"] * len(told)
            if isinstance(table, Impact):
                speeds, loud = table.speed[told].tolist(), world[Settings].hit_speed
                values += speeds, table.impulse[told].tolist()
                levels = ["INFO" if speed >= loud else "DEBUG" for speed in speeds]
            self._tell(stamp.frame, table.time[told].tolist(), levels, words, *values)
        if more:
            self._tell(stamp.frame, [stamp.time], ["DEBUG"], MORE, [more])

    def _told(self, world: World, entities: list[int]) -> list[str]:
        """Return names; as soon as nobody comes or goes those of all are asked for at once."""
        if self._structure != world.structure:
            self._structure, self._names = world.structure, {}
            return world.names_told(np.array(entities))
        if not self._names:
            everybody = world.handles()
            self._names = dict(zip(everybody.tolist(), world.names_told(everybody), strict=True))
        names = self._names
        return [names[handle] if handle in names else world.name(handle) for handle in entities]

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
