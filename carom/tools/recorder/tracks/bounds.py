"""Bounds: the boxes by which the broad phase finds who may meet."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Column
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.rows import RowTrack, handle
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track

PATH = "world/bounds"
COLOR = (255, 217, 77, 255)
RADIUS = -0.8  # px


class Bounds(RowTrack):
    """The box of each collider, as the last step had it; endless shapes have none, and nobody before the first step."""

    key: ClassVar[str] = "bounds"
    detail: ClassVar[str] = "full"
    path: ClassVar[str] = PATH
    columns: ClassVar[Mapping[str, Column]] = {
        "collider": handle("whose it is"),
        "lower": ColliderPose.columns["lower"],
        "upper": ColliderPose.columns["upper"],
    }

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write how they look."""
        import rerun

        look = rerun.Boxes3D.from_fields(colors=[COLOR], radii=[RADIUS], fill_mode="majorwireframe")
        stream.static(PATH, look)

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show none."""
        layout.hide(PATH)

    def rows(self, simulation: Simulation) -> Columns:
        """Return a row for each box."""
        world = simulation.world
        rows, pose = world.row_numbers(Collider, ColliderPose), world[ColliderPose]
        lower, upper = pose.lower[rows], pose.upper[rows]
        bounded = (np.isfinite(lower) & np.isfinite(upper) & (lower < upper)).all(axis=1)
        return {"collider": world.entities(rows[bounded]), "lower": lower[bounded], "upper": upper[bounded]}

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Return the boxes."""
        import rerun

        lower, upper = block.columns["lower"], block.columns["upper"]
        return block.drawn(rerun.Boxes3D.from_fields(centers=0.5 * (lower + upper), half_sizes=0.5 * (upper - lower)))
