"""Normals: an arrow along the normal of each contact, hidden at first."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs import Collider, RigidBody, World
from carom.ecs.relations.contact import Contact
from carom.systems.compound import bounding_radii
from carom.systems.simulation import Simulation
from carom.systems.touching import touching_rows
from carom.tools.recorder.block import Columns, joined
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.contacts import COLOR, PATH

NORMALS = f"{PATH}/normals"
ARROW_RADIUS = -1.5


class Normals(Track):
    """Arrows from points that touch onto b, as long as half a typical body."""

    key: ClassVar[str] = "normals"
    detail: ClassVar[str] = "full"

    def __init__(self) -> None:
        self._pending: list[tuple[Stamp, Columns]] = []
        self._length = np.float32(1.0)

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write colour and width."""
        import rerun

        self._length = np.float32(typical_radius(simulation.world))
        stream.static(NORMALS, rerun.Arrows3D.from_fields(colors=[COLOR], radii=[ARROW_RADIUS]))

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the points without the arrows."""
        layout.hide(NORMALS)

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the arrows of this frame."""
        contact = simulation.world[Contact]
        rows = touching_rows(contact)
        along = self._length * contact.normal[rows].astype(np.float32)
        self._pending.append((stamp, {"origin": contact.point[rows].astype(np.float32), "vector": along}))

    def write(self, stream: Stream) -> None:
        """Write the kept arrows."""
        import rerun

        if self._pending:
            block = joined(self._pending)
            arrows = rerun.Arrows3D.from_fields(origins=block.columns["origin"], vectors=block.columns["vector"])
            stream.rows(NORMALS, block.stamps, block.drawn(arrows))
            self._pending = []


def typical_radius(world: World) -> float:
    """Return the median half extent (m) of the bodies that move, 1 where there are none."""
    radii = bounding_radii(world, world.row_numbers(RigidBody, Collider))
    return float(np.median(radii)) if len(radii) else 1.0
