"""Rigs: where a camera of a world file is at a moment: on its path, following an entity or orbiting a place."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from carom.ecs import Transform, World
from carom.ecs.column import Floats
from carom.ecs.errors import CaromError, EntityError
from carom.ecs.spatial import quaternion
from carom.systems.settings import time_of
from carom.tools.cameras import Camera, Vector, front
from carom.worlds.builder import LoadedWorld
from carom.worlds.camera import Camera as Words
from carom.worlds.camera import Orbit, along, check_cameras
from carom.worlds.camera_path import Way
from carom.worlds.check import check_item
from carom.worlds.comers import all_names, pose_of_comer
from carom.worlds.source import Source
from carom.worlds.writing.columns import plain


class AbsentError(CaromError):
    """Somebody whom a camera follows or looks at is gone."""


@dataclass(frozen=True)
class Rig:
    """A camera in the words of a world file, its ``name`` there, and the direction that is up in that world."""

    name: str
    words: Words
    up: Vector = (0.0, 1.0, 0.0)

    @classmethod
    def stated(cls, world: World, words: Mapping[str, Any], name: str = "main", up: Vector = (0.0, 1.0, 0.0)) -> Rig:
        """Return a camera of a world in the words of files: ``{"follow": {"entity": "ball", "offset": (0, 1, 4)}}``.

        Raises CaromError naming everything that is wrong with them.
        """
        source, path = Source("", ""), ("cameras", name)
        found = check_item(source, "cameras", path, plain(dict(words)))
        if found is not None:
            check_cameras(source, {name: found}, all_names(world))
        if source.faults:
            raise CaromError("\n".join(str(replace(fault, line=0)) for fault in source.faults))
        return cls(name, found, up)

    @property
    def moves(self) -> bool:
        """Whether it may be elsewhere, or look elsewhere, at another time."""
        words = self.words
        return words.position is None or isinstance(words.target, str)

    @cached_property
    def _way(self) -> Way:
        return Way(self.words)

    def camera(self, world: World, time: float | None = None, poses: Transform | None = None) -> Camera:
        """Return the camera as the world is now; at another time (s), with the poses of all rows then, where stated.

        Raises CaromError when an entity that it follows or looks at is gone, or when it stands at its target.
        """
        where = poses if poses is not None else world[Transform]
        words, target, toward = self.words, self.words.target, front(self.up)
        elapsed = time_of(world) if time is None else time
        lens: dict[str, Any] = {"fov": words.fov, "height": words.height}
        if words.orbit is not None:
            centre = self._place(world, where, words.orbit.around)
            toward = self._horizontal(words.orbit, elapsed)
            position = centre + words.orbit.distance * self._risen(toward, words.orbit.elevation)
            target = words.orbit.around if target is None else target
        elif words.follow is not None:
            position = self._followed(world, where)
            target = words.follow.entity if target is None else target
        elif words.keyframes is not None:
            position = self._way.position(elapsed)
            led = self._way.target(elapsed, lambda place: self._place(world, where, place))
            target, lens = target if led is None else _vector(led), lens | self._way.lens(elapsed)
        else:
            assert words.position is not None, "the schema asks for one place"
            position = np.array(words.position)
        at = self._place(world, where, (0.0, 0.0, 0.0) if target is None else target)
        if np.array_equal(position, at):
            raise CaromError(f"camera {self.name}: it stands where it looks at, {tuple(position.tolist())}")
        up = self._upright(at - position, toward)
        return Camera(_vector(position), _vector(at), up, **lens, sky_up=self.up)

    def _horizontal(self, orbit: Orbit, time: float) -> Floats:
        """Return the horizontal direction (3,) from the middle of the orbit to the camera."""
        angle = orbit.azimuth + orbit.rate * time
        return math.cos(angle) * front(self.up) + math.sin(angle) * np.cross(self.up, front(self.up))

    def _risen(self, horizontal: Floats, elevation: float) -> Floats:
        return math.cos(elevation) * horizontal + math.sin(elevation) * np.array(self.up)

    def _followed(self, world: World, poses: Transform) -> Floats:
        """Return the position (3,) at the offset from the entity."""
        follow = self.words.follow
        assert follow is not None
        offset: Floats = np.array(follow.offset)
        if follow.frame == "body":
            offset = quaternion.rotate(self._pose(world, poses, follow.entity)[1], offset)
        return self._place(world, poses, follow.entity) + offset

    def _place(self, world: World, poses: Transform, place: str | Vector) -> Floats:
        """Return the point (3,) that a file means: the origin of the entity of that name, or the point itself."""
        return np.array(self._pose(world, poses, place)[0] if isinstance(place, str) else place)

    def _pose(self, world: World, poses: Transform, name: str) -> tuple[Floats, Floats]:
        """Return where somebody is, or will come: position (3,) and rotation (4,)."""
        try:
            row = world.row(world.find(name))
        except EntityError as fault:
            if (coming := pose_of_comer(name, world)) is not None:
                return coming
            raise AbsentError(f"camera {self.name}: {fault}") from None
        return poses.position[row], poses.rotation[row]

    def _upright(self, sight: Floats, toward: Floats) -> Vector:
        """Return what is up in the picture: where up is along the sight, what it would be a little less steep."""
        up = self.words.up or self.up
        if not along(up, sight.tolist()):
            return up
        return _vector(np.copysign(1.0, sight @ np.array(up)) * toward)


def rigs_of(loaded: LoadedWorld) -> list[Rig]:
    """Return the cameras of a world file."""
    return [Rig(name, words, loaded.up) for name, words in loaded.cameras.items()]


def _vector(numbers: Floats) -> Vector:
    x, y, z = numbers.tolist()
    return x, y, z
