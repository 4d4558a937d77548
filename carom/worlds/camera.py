"""Cameras of a world file: fixed, on a path, following an entity, or orbiting a place; by a lens or parallel light."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Any

import numpy as np
from pydantic import Field, model_validator

from carom.worlds.camera_path import CameraKeyframes, Fov, Height, Place, faults_of_camera, named
from carom.worlds.errors import Path, WordError, shown
from carom.worlds.names import known
from carom.worlds.rotation import Direction
from carom.worlds.source import Source
from carom.worlds.values import In, Lengths, Words, word_of

Angle = Annotated[float, In("rad")]
Elevation = Annotated[float, In("rad", least=-math.pi / 2.0, most=math.pi / 2.0)]
PLACES = ("position", "follow", "orbit", "keyframes")
ALONG = 1e-6  # sine of the angle under which two directions count as one


class Follow(Words):
    """Keeps a camera at an offset from an entity."""

    entity: str = Field(description="name of the entity")
    offset: Lengths = Field(description="from the entity's origin to the camera (m)")
    frame: word_of("world", "body") = Field("world", description="axes of the offset; those of the body turn with it")  # type: ignore[valid-type]


class Orbit(Words):
    """Leads a camera around a place on a circle."""

    around: Place = Field((0.0, 0.0, 0.0), description="point in the world (m), or name of an entity")
    distance: Annotated[float, In("m", above=0.0)] = Field(description="from that place to the camera (m)")
    elevation: Elevation = Field(math.radians(20.0), description="angle above the horizon of that place")
    azimuth: Angle = Field(0.0, description="where it starts, anticlockwise seen from above; 0 is in front, +z or -y")
    rate: Annotated[float, In("rad/s")] = Field(0.0, description="by which the azimuth grows (rad/s)")


class Camera(Words):
    """A view of the world: from a position, a path, an entity it follows or an orbit, by a lens or parallel light."""

    position: Lengths | None = Field(None, description="where it is (m)")
    follow: Follow | None = Field(None, description="an entity it moves with")
    orbit: Orbit | None = Field(None, description="a circle it moves on")
    keyframes: CameraKeyframes | None = Field(
        None, description="a path it is led along, smoothly, and when it is where"
    )
    target: Place | None = Field(
        None, description="point (m) or name of an entity it looks at, by default who it follows, or what it orbits"
    )
    fov: Fov = Field(math.radians(50.0), description="vertical angle")
    height: Height | None = Field(None, description="of what is seen in parallel light (m), instead of fov")
    up: Direction | None = Field(None, description="up in the picture, the world's up by default")

    @model_validator(mode="after")
    def check(self) -> Camera:
        """Refuse a camera that is nowhere or in several places, and one that sees nothing."""
        places = [key for key in PLACES if getattr(self, key) is not None]
        if len(places) != 1:
            received = " and ".join(places) or "none"
            raise WordError(
                "must state one place", received=received, accepted=f"{', '.join(PLACES[:-1])} or {PLACES[-1]}"
            )
        if self.height is not None and "fov" in self.model_fields_set:
            raise WordError(
                "must state one lens", received="fov and height", accepted="fov, or height for parallel light"
            )
        self._check_sight()
        return self

    def _check_sight(self) -> None:
        start, end = self.position, self.target or (0.0, 0.0, 0.0)
        if self.follow is not None and self.target in (None, self.follow.entity):
            start, end = self.follow.offset, (0.0, 0.0, 0.0)
        if start is None or isinstance(end, str):
            return  # only a world knows where that is
        sight = [b - a for a, b in zip(start, end, strict=True)]
        if not any(sight):
            raise WordError("looks at where it stands", accepted="a target elsewhere")
        if self.position is not None and self.up is not None and along(self.up, sight):
            raise WordError("looks along up", received=f"up {shown(list(self.up))}", accepted="an up across the view")


def along(one: Sequence[float], other: Sequence[float]) -> bool:
    """Tell whether two directions, of any length but 0, are the same or opposite but for rounding."""
    return bool(np.linalg.norm(np.cross(one, other)) <= ALONG * math.hypot(*one) * math.hypot(*other))


def check_cameras(source: Source, cameras: dict[str, Any], names: Sequence[str]) -> None:
    """Report what is wrong with keyframes, and who is followed, looked at or orbited and is not in the world."""
    for name, words in cameras.items():
        if words is None:
            continue
        for fault in faults_of_camera(words) if words.keyframes is not None else ():
            source.report_value(("cameras", name, *fault.steps), fault)
        for path, entity in _entities(words):
            try:
                known("entity", entity, names)
            except WordError as fault:
                source.report_value(("cameras", name, *path), fault)


def _entities(camera: Camera) -> Iterator[tuple[Path, str]]:
    if camera.follow is not None:
        yield ("follow", "entity"), camera.follow.entity
    if camera.orbit is not None and isinstance(camera.orbit.around, str):
        yield ("orbit", "around"), camera.orbit.around
    if isinstance(camera.target, str):
        yield ("target",), camera.target
    if camera.keyframes is not None:
        yield from named(camera)
