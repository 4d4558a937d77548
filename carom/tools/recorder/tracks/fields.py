"""Fields: wells, winds and whatever else acts by where one is, as arrows on a grid."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Column
from carom.systems.forces.law import EVERYBODY, Forces, Law
from carom.systems.forces.reach import Reach
from carom.systems.forces.region import Region
from carom.systems.forces.sampling import Sample, probe, sampled
from carom.systems.settings import Settings, time_of
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.grid import MOST, Grid, extent, grid
from carom.tools.recorder.rows import RowTrack, number, text
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track

PATH = "world/fields"
FORCE, FLOW = 0xC8A8FFFF, 0x7CE8C0FF  # violet, green
RADIUS = -1.5  # px
TYPICAL, LONGEST = 0.6, 1.2  # distances of points: the arrow of a median, and of what is far larger


class Fields(RowTrack):
    """What each law does to 1 kg at rest, and how each medium flows; written anew where these are others than before.

    A law that has a region is told within it, any other around all that is there when the recording begins.
    """

    key: ClassVar[str] = "fields"
    detail: ClassVar[str] = "full"
    path: ClassVar[str] = PATH
    columns: ClassVar[Mapping[str, Column]] = {
        "field": text("the law; the second of a kind is number 2"),
        "force": number("N", "force on a body of 1 kg at rest, world frame", 3),
        "flow": number("m/s", "velocity of the medium, world frame", 3),
        "point": number("m", "where, world frame", 3),
    }
    drawn: ClassVar[Mapping[str, str]] = {"point": "Arrows3D:origins"}
    sparse: ClassVar[bool] = True

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Fill the world with points; write how wide arrows are."""
        import rerun

        self._probe = probe(MOST)
        self._grids: dict[Region | None, Grid] = {None: grid(*extent(simulation.world))}
        self._told: tuple[Settings, list[tuple[Law, Reach]]] | None = None
        self._scales: dict[str, float] = {}
        stream.static(PATH, rerun.Arrows3D.from_fields(radii=[RADIUS]))

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return the rows of all fields where any has changed; nothing of a world without any."""
        world, time = simulation.world, time_of(simulation.world)
        laws = [one for entries in world[Forces].entries.values() for one in entries if one[1].acts_at(time)]
        now = world[Settings], laws
        if now == self._told and all(law.steady for law, _ in laws):
            return None
        self._told = now
        samples = list(sampled(self._probe, world, time, lambda reach: self._grid(reach).points))
        if not samples and not self._scales:
            return None
        parts = [self._arrows(one) for one in (NOTHING, *samples)]
        return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Return an arrow for each row."""
        import rerun

        columns = {name: block.columns[column] for name, column in ARROWS.items()}
        return block.drawn(rerun.Arrows3D.from_fields(**columns))

    def _grid(self, reach: Reach) -> Grid:
        """Return the grid for a reach, always the same."""
        if reach.region not in self._grids:
            assert reach.region is not None, "that of the whole world is there from the start"
            whole = grid(*reach.region.bounds())
            self._grids[reach.region] = whole._replace(points=whole.points[reach.region.contains(whole.points)])
        return self._grids[reach.region]

    def _arrows(self, sample: Sample) -> Columns:
        """Return rows with their arrows, on the scale of the first median; those of what is far larger are cut."""
        pushes = np.asarray(sample.force.any(axis=1))
        vectors = np.where(pushes[:, None], sample.force, sample.flow)
        sizes = np.sqrt((vectors * vectors).sum(axis=1, keepdims=True))
        spacing = self._grid(sample.reach).spacing
        scale = self._scales.setdefault(sample.name, TYPICAL * spacing / float(np.median(sizes))) if len(sizes) else 1.0
        return {
            "field": np.full(len(sizes), sample.name),
            "force": sample.force,
            "flow": sample.flow,
            "point": sample.point,
            "arrow": np.minimum(scale, LONGEST * spacing / sizes) * vectors,
            "color": np.where(pushes, FORCE, FLOW).astype(np.uint32),
        }


ARROWS = {"origins": "point", "vectors": "arrow", "colors": "color"}
NOTHING = Sample("", EVERYBODY, *(np.zeros((0, 3)) for _ in range(3)))
