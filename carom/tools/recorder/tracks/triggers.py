"""Triggers: who is inside of which sensor, as a table and a lane for each sensor."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.column import Column, Integers
from carom.ecs.relations.enter import Inside
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Columns
from carom.tools.recorder.lanes import Lanes, told
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.rows import RowTrack
from carom.tools.recorder.stream import Stamp, Stream

EMPTY = "empty"
NOBODY = np.zeros(0, np.int64)


class Triggers(RowTrack):
    """The occupants of every sensor in every frame; a lane tells who, or how many, or that it is empty."""

    key: ClassVar[str] = "triggers"
    path: ClassVar[str] = "triggers"
    sparse: ClassVar[bool] = True
    columns: ClassVar[Mapping[str, Column]] = {name: Inside.columns[name] for name in ("sensor", "entity", "since")}

    def __init__(self) -> None:
        super().__init__()
        self._lanes = Lanes("triggers", {EMPTY: (90, 90, 90)})
        self._state: tuple[int, bytes, bytes] | None = None

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the lanes where there are sensors."""
        layout.lanes |= len(_sensors(world)) > 0

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep who is inside of whom."""
        world = simulation.world
        sensors = _sensors(world)
        if not len(sensors):
            return
        super().sample(simulation, stamp, stream)
        inside = world[Inside]
        state = world.structure, inside.sensor[: inside.count].tobytes(), inside.entity[: inside.count].tobytes()
        if state == self._state:
            return
        self._state, occupants = state, defaultdict(list)
        for sensor, entity in zip(inside.sensor[: inside.count], inside.entity[: inside.count], strict=True):
            occupants[world.name(int(sensor))].append(world.name(int(entity)))
        names = [world.name(int(sensor)) for sensor in world.entities(sensors)]
        self._lanes.note_all(stamp, {name: told(occupants[name], "inside") or EMPTY for name in names})

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return a row for each occupant of each sensor."""
        inside = simulation.world[Inside]
        return {name: getattr(inside, name)[: inside.count].copy() for name in self.columns}

    def write(self, stream: Stream) -> None:
        """Write the rows and the lanes."""
        super().write(stream)
        self._lanes.write(stream)


def _sensors(world: World) -> Integers:
    sensor = world[Collider].sensor[: world.used()]
    if not sensor.any():  # in most worlds, and told much faster than whose they are
        return NOBODY
    rows = world.row_numbers(Collider)
    return np.asarray(rows[sensor[rows]])
