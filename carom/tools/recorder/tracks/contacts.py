"""Contacts: where colliders touch, as points, and their numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs import Collider, Motion, RigidBody, Transform, Visual, World
from carom.ecs.column import Column
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.systems.compound import bodies_of
from carom.systems.kernels.observing import note_contacts
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns, Room
from carom.tools.recorder.rows import RowTrack
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "world/contacts"
POINTS = f"{PATH}/points"
COLOR = (255, 90, 60, 255)
KINDS: dict[str, tuple[tuple[int, ...], type]] = {
    "a": ((), np.int64), "b": ((), np.int64), "depth": ((), np.float64), "impulse": ((), np.float64),
    "point": ((3,), np.float32), "normal": ((3,), np.float32), "speed": ((), np.float32),
}  # fmt: skip
POINT_RADIUS = -3.0  # negative: points of the screen, visible at any scale


class Contacts(RowTrack):
    """The touching rows of the contact table; rows that only may touch within a step are left out."""

    key: ClassVar[str] = "contacts"
    path: ClassVar[str] = POINTS
    columns: ClassVar[Mapping[str, Column]] = {
        **{name: Contact.columns[name] for name in ("a", "b", "depth")},
        "speed": Impact.columns["speed"],
        **{name: Contact.columns[name] for name in ("impulse", "point", "normal")},
    }
    drawn: ClassVar[Mapping[str, str]] = {"point": "Points3D:positions"}

    def __init__(self) -> None:
        super().__init__()
        self._pending = self._room = Room(KINDS)
        self._structure = -1
        self._unseen = np.zeros(0, np.int64)

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write colour and size of the points."""
        import rerun

        stream.static(POINTS, rerun.Points3D.from_fields(colors=[COLOR], radii=[POINT_RADIUS]))

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the contacts of this frame."""
        world = simulation.world
        if self._structure != world.structure:
            self._structure = world.structure
            self._name_unseen(world, stamp, stream)
        super().sample(simulation, stamp, stream)

    def rows(self, simulation: Simulation) -> Columns:
        """Return the points that touch, and how fast (m/s) both sides close along the normal; below 0: they part."""
        world = simulation.world
        owners, slots = bodies_of(world), world.slots
        with world.faces(None):  # as within a system: else kernels are handed copies of columns
            table, motion, pose = world[Contact], world[Motion], world[Transform]
            rows = self._room.offer(table.count)
            found = note_contacts(
                table.count, table.a, table.b, table.depth, table.impulse, table.point, table.normal,
                slots.alive, slots.generations, slots.row_shift, owners,
                pose.position, pose.rotation, world[RigidBody].center_of_mass, motion.linear, motion.angular,
                *rows.values(),
            )  # fmt: skip
        return {name: column[:found] for name, column in rows.items()}

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Return the points."""
        import rerun

        return block.drawn(rerun.Points3D.from_fields(positions=block.columns["point"]))

    def _name_unseen(self, world: World, stamp: Stamp, stream: Stream) -> None:
        """Write the names of bodies and colliders that are not among those that are drawn."""
        import rerun

        drawn = world.row_numbers(Visual)
        drawn = drawn[world[Visual].visible[drawn]]
        drawn = drawn if self.only is None else drawn[self.only.rows(world)[drawn]]
        named = np.union1d(world.row_numbers(Collider), world.row_numbers(RigidBody))
        rows = np.setdiff1d(named, drawn)
        entities = world.entities(rows)
        if not np.array_equal(entities, self._unseen):
            self._unseen = entities
            stream.row(PATH, stamp, rerun.AnyValues(collider=entities, name=world.names_told(entities)))
