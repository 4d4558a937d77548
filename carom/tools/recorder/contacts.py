"""Contacts: where colliders touch, as points, arrows along the normal, and their numbers."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs import Collider, RigidBody, World
from carom.ecs.relations.contact import Contact
from carom.systems.simulation import Simulation
from carom.tools.recorder.stream import Stamp, Stream

PATH = "world/contacts"
POINTS, NORMALS = f"{PATH}/points", f"{PATH}/normals"
COLOR = (255, 90, 60, 255)
POINT_RADIUS = -3.0  # negative: points of the screen, visible at any scale
ARROW_RADIUS = -1.5


class Contacts:
    """The touching rows of the contact table; rows that only may touch within a step are left out."""

    def __init__(self) -> None:
        self._pending: list[tuple[Stamp, dict[str, Any]]] = []
        self._length = 0.0

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the contacts of this frame."""
        import rerun

        world = simulation.world
        if not self._pending and not self._length:
            self._length = typical_radius(world)
            stream.static(POINTS, rerun.Points3D.from_fields(colors=[COLOR], radii=[POINT_RADIUS]))
            stream.static(NORMALS, rerun.Arrows3D.from_fields(colors=[COLOR], radii=[ARROW_RADIUS]))
        table = world[Contact]
        live = slice(0, table.count)
        touching = np.nonzero((table.depth[live] >= 0.0) | (table.impulse[live] > 0.0))[0]
        columns = ("a", "b", "point", "normal", "depth", "impulse")
        self._pending.append((stamp, {name: getattr(table, name)[touching] for name in columns}))

    def write(self, stream: Stream) -> None:
        """Write the kept contacts, one block for points with their numbers and one for arrows."""
        import pyarrow
        import rerun

        if not self._pending:
            return
        stamps = [stamp for stamp, _ in self._pending]
        counts = [len(rows["a"]) for _, rows in self._pending]
        joined = {name: np.concatenate([rows[name] for _, rows in self._pending]) for name in self._pending[0][1]}
        normals = pyarrow.FixedSizeListArray.from_arrays(pyarrow.array(joined["normal"].ravel()), 3)
        numbers = {name: pyarrow.array(joined[name]) for name in ("a", "b", "depth", "impulse")}
        points, arrows = joined["point"], joined["normal"] * self._length
        stream.rows(POINTS, stamps, rerun.Points3D.columns(positions=points).partition(counts))
        stream.rows(POINTS, stamps, rerun.AnyValues.columns(normal=normals, **numbers).partition(counts))
        stream.rows(NORMALS, stamps, rerun.Arrows3D.columns(origins=points, vectors=arrows).partition(counts))
        self._pending = []


def typical_radius(world: World) -> float:
    """Return the median half extent (m) of the bodies that move, 1 where there are none."""
    rows = world.row_numbers(RigidBody, Collider)
    collider = world[Collider]
    radii = np.linalg.norm(collider.bound_half[rows], axis=1) + collider.bound_radius[rows]
    return float(np.median(radii)) if len(radii) else 1.0
