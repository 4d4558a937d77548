"""Contacts: where colliders touch, as points, and their numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs import Collider, Motion, RigidBody, Transform, Visual, World
from carom.ecs.column import Column, Floats, Integers
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.systems.compound import bodies_of
from carom.systems.kernels.observing import find_closing_speeds
from carom.systems.simulation import Simulation
from carom.systems.touching import touching_rows
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.rows import RowTrack
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "world/contacts"
POINTS = f"{PATH}/points"
COLOR = (255, 90, 60, 255)
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
        """Return the points that touch."""
        world = simulation.world
        with world.faces(None):  # as within a system: else kernels are handed copies of columns
            table = world[Contact]
            touching = touching_rows(table)
            rows = {name: getattr(table, name).take(touching) for name in ("a", "b", "depth", "impulse")}
            return rows | closing(world, touching, table.a, table.b, table.point, table.normal)

    def draw(self, block: Block, stream: Stream) -> None:
        """Write the points."""
        import rerun

        columns = rerun.Points3D.columns(positions=block.columns["point"])
        stream.rows(POINTS, block.stamps, columns.partition(block.counts))

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


def closing(world: World, rows: Integers, a: Integers, b: Integers, point: Floats, normal: Floats) -> Columns:
    """Return where contacts ``rows`` are, and how fast (m/s) both sides close along the normal; below 0: they part."""
    count, slots, owners = len(rows), world.slots, bodies_of(world)
    points, normals, speeds = (np.empty(shape, np.float32) for shape in ((count, 3), (count, 3), count))
    with world.faces(None):
        motion, pose, centers = world[Motion], world[Transform], world[RigidBody].center_of_mass
        find_closing_speeds(
            rows, a, b, point, normal, slots.alive, slots.generations, slots.row_shift, owners,
            pose.position, pose.rotation, centers, motion.linear, motion.angular, points, normals, speeds,
        )  # fmt: skip
    return {"point": points, "normal": normals, "speed": speeds}
