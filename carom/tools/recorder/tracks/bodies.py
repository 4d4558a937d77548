"""Bodies: everything visible, one Rerun entity per (shape, size, colour), one instance per carom entity."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from carom.ecs import Transform, Visual, World
from carom.ecs.column import Integers
from carom.systems.shapes import BY_NUMBER, Shape
from carom.systems.shapes.geometry import Geometries
from carom.systems.simulation import Simulation
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.surfaces import mesh_of
from carom.tools.recorder.track import Track

ROOT = "world"
LOOK = ("shape", "size", "geometry", "position", "rotation", "color")
Poses = npt.NDArray[np.float32]


@dataclass(frozen=True)
class Group:
    """Entities that look alike: their path in the recording, handles, and place among the rows of a frame."""

    path: str
    entities: Integers
    span: slice


class Bodies(Track):
    """Poses of all visible entities, float32 as Rerun keeps them; a group's are written only where they changed.

    Bodies may come and go: which entity is which instance is written whenever it changes, and a group that loses its
    last entity is cleared.
    """

    key: ClassVar[str] = "bodies"

    def __init__(self) -> None:
        self._groups: dict[bytes, Group] = {}
        self._paths: dict[bytes, str] = {}
        self._rows: Integers = np.zeros(0, np.int64)
        self._starts: Integers = self._rows
        self._last: Poses = np.zeros((0, 7), np.float32)
        self._structure = -1
        self._looks: list[npt.NDArray[np.generic]] = []
        self._pending: list[tuple[Stamp, list[tuple[str, Poses]]]] = []

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep the poses of this frame; write groups anew where bodies came, went or changed their look."""
        world = simulation.world
        if self._changed(world):
            self._regroup(world, stamp, stream)
        transform = world[Transform]
        poses = np.empty((len(self._rows), 7), np.float32)
        poses[:, :3] = transform.position[self._rows]
        poses[:, 3:] = transform.rotation[self._rows]
        if len(poses):
            moves = np.logical_or.reduceat((poses != self._last).any(axis=1), self._starts)
            groups = [group for group, moved in zip(self._groups.values(), moves, strict=True) if moved]
            self._pending.append((stamp, [(group.path, poses[group.span]) for group in groups]))
        self._last = poses

    def write(self, stream: Stream) -> None:
        """Write the kept poses, one block per group."""
        import rerun

        blocks: dict[str, tuple[list[Stamp], list[Poses]]] = defaultdict(lambda: ([], []))
        for stamp, moved in self._pending:
            for path, poses in moved:
                blocks[path][0].append(stamp)
                blocks[path][1].append(poses)
        for path, (stamps, parts) in blocks.items():
            poses = np.concatenate(parts)
            columns = rerun.InstancePoses3D.columns(translations=poses[:, :3], quaternions=poses[:, 3:])
            stream.rows(path, stamps, columns.partition([len(part) for part in parts]))
        self._pending = []

    def _changed(self, world: World) -> bool:
        visual = world[Visual]
        rows = world.rows(Visual, Transform)
        looks = [visual.visible[rows], visual.color[rows]]
        same = self._structure == world.structure and all(map(np.array_equal, looks, self._looks))
        self._structure, self._looks = world.structure, [look.copy() for look in looks]
        return not same

    def _regroup(self, world: World, stamp: Stamp, stream: Stream) -> None:
        import rerun

        visual = world[Visual]
        rows = world.row_numbers(Visual, Transform)
        rows = rows[visual.visible[rows]]
        columns = [np.asarray(getattr(visual, name)[rows], np.float64).reshape(len(rows), -1) for name in LOOK]
        looks = np.concatenate(columns, axis=1)
        members: dict[bytes, list[int]] = defaultdict(list)
        for row, look in zip(rows, looks, strict=True):
            members[look.tobytes()].append(int(row))
        before, self._groups = self._groups, {}
        at = 0
        for look, alike in members.items():
            entities = world.entities(np.array(alike))
            names = [world.name(entity) for entity in entities]
            path = self._paths.setdefault(look, self._path(_shape(world, alike[0]), names[0]))
            if look not in before:
                drawn = _shape(world, alike[0]), visual.position[alike[0]], visual.rotation[alike[0]]
                stream.row(path, stamp, mesh_of(*drawn, visual.color[alike[0]]))
            if look not in before or not np.array_equal(before[look].entities, entities):
                stream.row(path, stamp, rerun.AnyValues(entity=entities, name=names))
            self._groups[look] = Group(path, entities, slice(at, at + len(alike)))
            at += len(alike)
        for look in before.keys() - members.keys():
            stream.row(before[look].path, stamp, rerun.Clear(recursive=False))
        self._rows = np.array([row for alike in members.values() for row in alike], np.int64)
        self._starts = np.array([group.span.start for group in self._groups.values()], np.int64)
        self._last = np.full((len(self._rows), 7), np.nan, np.float32)

    def _path(self, shape: Shape, name: str) -> str:
        """Return a path called after the first entity of a group (``rain[3,0,1]``: ``rain``) that no group has."""
        import rerun

        stem = name.partition("[")[0] or shape.key
        path = rerun.new_entity_path([ROOT, shape.key, stem])
        taken = set(self._paths.values())
        number = 2
        while path in taken:
            path = rerun.new_entity_path([ROOT, shape.key, f"{stem}-{number}"])
            number += 1
        return str(path)


def _shape(world: World, row: int) -> Shape:
    visual = world[Visual]
    number = int(visual.geometry[row])
    geometry = world[Geometries].items[number] if number >= 0 else None
    return BY_NUMBER[int(visual.shape[row])].from_size(visual.size[row], geometry)
