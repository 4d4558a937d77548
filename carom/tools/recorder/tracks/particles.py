"""Particles: all of them as one batch of points, in their colours and sizes.

Rerun's points let nothing through, so those that would cover what is behind them by a share cover that share of it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs.column import Column
from carom.ecs.components.emitter import Drawn, Emitter
from carom.ecs.relations.particle import Particle
from carom.systems.simulation import Simulation
from carom.tools.particles import POINT_WIDTH, clouds
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.rows import RowTrack, handle, number
from carom.tools.recorder.stream import Stamp, Stream


class Particles(RowTrack):
    """The particles of all emitters; a world without any costs nothing."""

    key: ClassVar[str] = "particles"
    path: ClassVar[str] = "world/particles"
    columns: ClassVar[Mapping[str, Column]] = {
        "emitter": handle("whose it is"),
        "number": Particle.columns["number"],
        "position": number("m", "position, world frame", 3, dtype="float32"),
    }
    drawn: ClassVar[Mapping[str, str]] = {"position": "Points3D:positions"}
    sparse: ClassVar[bool] = True

    def __init__(self) -> None:
        super().__init__()
        self._told: list[int] = []
        self._structure = -1

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the particles of this frame; tell the names of emitters where there are others than before."""
        import rerun

        world = simulation.world
        if self._structure != world.structure:
            self._structure, emitters = world.structure, world.query(Emitter).entities
            if emitters.tolist() != self._told:
                self._told, names = emitters.tolist(), world.names_told(emitters)
                stream.row(f"{self.path}/emitters", stamp, rerun.AnyValues(entity=emitters, name=names))
        if self._told or world.count(Particle):
            super().sample(simulation, stamp, stream)

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return a row for each particle; none at all where nothing emits."""
        world = simulation.world
        seen, particle = list(clouds(world)), world[Particle]
        if not seen:
            return _nothing() if world.count(Emitter) else None
        radii = [
            np.full(len(cloud.places), -0.5 * POINT_WIDTH)  # px
            if cloud.drawn == Drawn.POINTS
            else 0.5 * cloud.diameters * np.sqrt(cloud.colors[:, 3])
            for cloud in seen
        ]
        return {
            "emitter": np.concatenate([particle.emitter[cloud.piece.rows] for cloud in seen]),
            "number": np.concatenate([particle.number[cloud.piece.rows] for cloud in seen]),
            "position": np.concatenate([cloud.places for cloud in seen]).astype(np.float32),
            "radius": np.concatenate(radii).astype(np.float32),
            "color": np.rint(255.0 * np.concatenate([cloud.colors[:, :3] for cloud in seen])).astype(np.uint8),
        }

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Return the points."""
        import rerun

        columns = block.columns
        return block.drawn(
            rerun.Points3D.from_fields(positions=columns["position"], radii=columns["radius"], colors=columns["color"])
        )


def _nothing() -> Columns:
    shapes = {"emitter": (0,), "number": (0,), "position": (0, 3), "radius": (0,), "color": (0, 3)}
    kinds = {"emitter": np.int64, "number": np.int64, "color": np.uint8}
    return {name: np.zeros(shape, kinds.get(name, np.float32)) for name, shape in shapes.items()}
