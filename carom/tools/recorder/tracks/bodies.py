"""Bodies: everything visible, one Rerun entity per (shape, size, colour), one instance per carom entity."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs import Transform, Visual, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.systems.compound import shape_at
from carom.systems.kernels.observing import note_poses
from carom.systems.shapes import Shape
from carom.systems.simulation import Simulation
from carom.tools.recorder.choice import Choice
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.surfaces import mesh_of
from carom.tools.recorder.track import Track
from carom.tools.visible import visible_rows

ROOT = "world"
LOOK = ("shape", "size", "geometry", "position", "rotation")


class Poses(NamedTuple):
    """Positions (n, 3) and rotations (n, 4)."""

    places: npt.NDArray[np.float32]
    turns: npt.NDArray[np.float32]


Noted = tuple[Stamp, Poses, Booleans]  # poses at one time, and which groups have moved


@dataclass(frozen=True)
class Group:
    """Entities that look alike: their path in the recording, handles, and place among the rows of a frame."""

    path: str
    entities: Integers
    span: slice


class Bodies(Track):
    """Poses of all visible entities, float32 as Rerun keeps them; a group's are written only where they changed.

    Bodies may come and go: which entity is which instance is written whenever it changes, and a group that loses its
    last entity is cleared. Those ``alone`` are never drawn as one with others. Groups stand below ``root``, and whose
    they are is written as ``whose``.
    """

    key: ClassVar[str] = "bodies"

    def __init__(self, root: str = ROOT, whose: str = "entity") -> None:
        self.alone = Choice(())
        self._root, self._whose = root, whose
        self.groups: dict[bytes, Group] = {}
        self._paths: dict[bytes, str] = {}
        self._rows: Integers = np.zeros(0, np.int64)
        self._starts: Integers = self._rows
        self._last = Poses(np.zeros((0, 3), np.float32), np.zeros((0, 4), np.float32))
        self.structure = -1
        self._looks: list[npt.NDArray[np.generic]] = []
        self._pending: list[Noted] = []

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the poses of this frame; write groups anew where bodies came, went or changed their look."""
        world = simulation.world
        if self._changed(world):
            self.write(stream)
            self._regroup(world, stamp, stream)
        with world.faces(None):  # as within a system: else kernels are handed copies of columns
            poses = self.poses(simulation)
            self._last, moved = self.noted(poses.position, poses.rotation, self._last)
        if moved.any():
            self._pending.append((stamp, self._last, moved))
            self.kept += self._last.places.nbytes + self._last.turns.nbytes

    def poses(self, simulation: Simulation) -> Transform:
        """Return the poses of all rows."""
        return simulation.world[Transform]

    def seen(self, world: World) -> Integers:
        """Return the rows of all who are drawn."""
        rows = visible_rows(world)
        return rows if self.only is None else rows[self.only.rows(world)[rows]]

    def colors(self, world: World, rows: Integers) -> Floats:
        """Return the colours (n, 4) of some rows."""
        return world[Visual].color[rows]

    def noted(self, position: Floats, rotation: Floats, before: Poses) -> tuple[Poses, Booleans]:
        """Return the poses of all who are seen, and in which groups anybody was elsewhere before."""
        count = len(self._rows)
        poses = Poses(np.empty((count, 3), np.float32), np.empty((count, 4), np.float32))
        moved = np.empty(len(self._starts), np.bool_)
        note_poses(self._rows, position, rotation, self._starts, *before, *poses, moved)
        return poses, moved

    def nowhere(self) -> Poses:
        """Return poses of as many, from which all have moved."""
        count = len(self._rows)
        return Poses(np.full((count, 3), np.nan, np.float32), np.full((count, 4), np.nan, np.float32))

    def write(self, stream: Stream) -> None:
        """Write the kept poses, one block per group."""
        write_poses(self._pending, list(self.groups.values()), stream.rows)
        self._pending, self.kept = [], 0

    def _changed(self, world: World) -> bool:
        visual = world[Visual]
        rows = world.rows(Visual, Transform)
        looks = [visual.visible[rows], visual.color[rows]]
        if self.structure == world.structure and all(map(np.array_equal, looks, self._looks)):
            return False
        self.structure, self._looks = world.structure, [look.copy() for look in looks]
        return True

    def _regroup(self, world: World, stamp: Stamp, stream: Stream) -> None:
        import rerun

        visual = world[Visual]
        rows, alone = self.seen(world), self.alone.rows(world)
        colors = self.colors(world, rows)
        columns = [np.asarray(getattr(visual, name)[rows], np.float64) for name in LOOK]
        looks = np.column_stack([*columns, colors])
        members: dict[bytes, list[int]] = defaultdict(list)
        for row, look in zip(rows, looks, strict=True):
            own = world.name(int(world.entities(row)[()])).encode() if alone[row] else b""
            members[look.tobytes() + own].append(int(row))
        before, self.groups = self.groups, {}
        at = 0
        for look, alike in members.items():
            entities = world.entities(np.array(alike))
            names = world.names_told(entities)
            shape = shape_at(world, alike[0], Visual)
            path = self._paths.setdefault(look, self._path(shape, names[0], bool(alone[alike[0]])))
            if look not in before:
                drawn = shape, visual.position[alike[0]], visual.rotation[alike[0]]
                stream.row(path, stamp, mesh_of(*drawn, colors[np.searchsorted(rows, alike[0])]))
            if look not in before or not np.array_equal(before[look].entities, entities):
                stream.row(path, stamp, rerun.AnyValues(**{self._whose: entities}, name=names))
            self.groups[look] = Group(path, entities, slice(at, at + len(alike)))
            at += len(alike)
        for look in before.keys() - members.keys():
            stream.row(before[look].path, stamp, rerun.Clear(recursive=False))
        self._rows = np.array([row for alike in members.values() for row in alike], np.int64)
        self._starts = np.array([group.span.start for group in self.groups.values()], np.int64)
        self._last = self.nowhere()

    def _path(self, shape: Shape, name: str, alone: bool) -> str:
        """Return a path that no group has, called after its first entity, and in full (not ``rain``) for one alone."""
        import rerun

        stem = name if alone else name.partition("[")[0] or shape.key
        path = rerun.new_entity_path([*self._root.split("/"), shape.key, stem])
        taken = set(self._paths.values())
        number = 2
        while path in taken:
            path = rerun.new_entity_path([*self._root.split("/"), shape.key, f"{stem}-{number}"])
            number += 1
        return str(path)


def write_poses(kept: Sequence[Noted], groups: Sequence[Group], rows: Callable[..., None]) -> None:
    """Write poses that were kept at several times, a block for each group, by a function that writes rows."""
    import rerun

    moved = np.array([moved for _, _, moved in kept]).reshape(len(kept), len(groups))
    for group, moves in zip(groups, moved.T, strict=True):
        held = [kept[at] for at in np.nonzero(moves)[0].tolist()]
        if held:
            places = np.stack([poses.places[group.span] for _, poses, _ in held])
            turns = np.stack([poses.turns[group.span] for _, poses, _ in held])
            columns = rerun.InstancePoses3D.columns(translations=places, quaternions=turns)
            rows(group.path, [stamp for stamp, _, _ in held], columns)
