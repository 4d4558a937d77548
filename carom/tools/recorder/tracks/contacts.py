"""Contacts: where colliders touch, as points, arrows along the normal, and their numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from carom.ecs import Collider, Motion, RigidBody, Visual, World
from carom.ecs.column import Column, Floats, Integers
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.systems.compound import bodies_of
from carom.systems.energy import centers_of_mass
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.rows import RowTrack
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track

PATH = "world/contacts"
POINTS, NORMALS = f"{PATH}/points", f"{PATH}/normals"
COLOR = (255, 90, 60, 255)
POINT_RADIUS = -3.0  # negative: points of the screen, visible at any scale
ARROW_RADIUS = -1.5


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
        self._length = 1.0
        self._structure = -1
        self._unseen = np.zeros(0, np.int64)

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write colours and sizes of points and arrows."""
        import rerun

        self._length = typical_radius(simulation.world)
        stream.static(POINTS, rerun.Points3D.from_fields(colors=[COLOR], radii=[POINT_RADIUS]))
        stream.static(NORMALS, rerun.Arrows3D.from_fields(colors=[COLOR], radii=[ARROW_RADIUS]))

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the points without the arrows."""
        layout.hide(NORMALS)

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the contacts of this frame."""
        world = simulation.world
        if self._structure != world.structure:
            self._structure = world.structure
            self._name_unseen(world, stamp, stream)
        super().sample(simulation, stamp, stream)

    def rows(self, simulation: Simulation) -> Columns:
        """Return the points that touch."""
        table = simulation.world[Contact]
        live = slice(0, table.count)
        touching = np.nonzero((table.depth[live] >= 0.0) | (table.impulse[live] > 0.0))[0]
        rows = {name: getattr(table, name)[touching] for name in self.columns if name != "speed"}
        return rows | {"speed": closing_speeds(simulation.world, rows)}

    def draw(self, block: Block, stream: Stream) -> None:
        """Write points, and arrows along the normals."""
        import rerun

        points, arrows = block.columns["point"], block.columns["normal"] * self._length
        stream.rows(POINTS, block.stamps, rerun.Points3D.columns(positions=points).partition(block.counts))
        columns = rerun.Arrows3D.columns(origins=points, vectors=arrows)
        stream.rows(NORMALS, block.stamps, columns.partition(block.counts))

    def _name_unseen(self, world: World, stamp: Stamp, stream: Stream) -> None:
        """Write the names of bodies and colliders that nobody sees, which are not among those that are drawn."""
        import rerun

        drawn = world.row_numbers(Visual)
        named = np.union1d(world.row_numbers(Collider), world.row_numbers(RigidBody))
        rows = np.setdiff1d(named, drawn[world[Visual].visible[drawn]])
        entities = world.entities(rows)
        if not np.array_equal(entities, self._unseen):
            self._unseen = entities
            names = [world.name(entity) for entity in entities]
            stream.row(PATH, stamp, rerun.AnyValues(collider=entities, name=names))


def closing_speeds(world: World, contacts: Columns) -> npt.NDArray[np.float32]:
    """Return how fast (m/s) the two sides of each contact move against each other along its normal; below 0: part."""
    away = [_velocities(world, contacts[side], contacts["point"]) for side in ("a", "b")]
    speeds: npt.NDArray[np.float32] = ((away[0] - away[1]) * contacts["normal"]).sum(axis=1).astype(np.float32)
    return speeds


def _velocities(world: World, colliders: Integers, points: Floats) -> Floats:
    """Return the velocity (m/s) of points of colliders, zero of those that never move or are gone in the same step."""
    live = world.slots.live(colliders)
    owners = np.full(len(colliders), -1)
    owners[live] = bodies_of(world)[world.slots.rows(colliders[live])]
    moving = owners >= 0
    bodies, motion, velocities = owners[moving], world[Motion], np.zeros((len(colliders), 3))
    arm = points[moving] - centers_of_mass(world, bodies)
    velocities[moving] = motion.linear[bodies] + np.cross(motion.angular[bodies], arm)
    return velocities


def typical_radius(world: World) -> float:
    """Return the median half extent (m) of the bodies that move, 1 where there are none."""
    rows = world.row_numbers(RigidBody, Collider)
    collider = world[Collider]
    radii = np.linalg.norm(collider.bound_half[rows], axis=1) + collider.bound_radius[rows]
    return float(np.median(radii)) if len(radii) else 1.0
