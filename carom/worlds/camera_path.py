"""Paths of cameras: keyframes that say when it is where, what it looks at then, and how wide it sees."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from pydantic import Field

from carom.ecs.column import Floats
from carom.ecs.components.path import Repeat
from carom.systems.curves import Curve
from carom.systems.parameters import WordFault
from carom.systems.paths import REPEATS, faults_of_times, stated
from carom.worlds.sections import Time
from carom.worlds.values import In, Lengths, Words, either, word_of

if TYPE_CHECKING:
    from carom.worlds.camera import Camera

Place: Any = either(Lengths, str, str)  # a point, or the origin of the entity of that name
Fov = Annotated[float, In("rad", above=0.0, most=math.pi)]
Height = Annotated[float, In("m", above=0.0)]
Steps = tuple[str | int, ...]
LENSES = ("fov", "height")
POINTS = ("position", "target")
LED = (*POINTS, *LENSES)  # words of a keyframe between which the way is smooth


class CameraKeyframe(Words):
    """Where a camera is at a time; what it leaves out is as in the keyframe before."""

    at: Time = Field(description="simulated time (s)")
    position: Lengths | None = Field(None, description="where it is (m)")
    target: Place | None = Field(None, description="point (m) or name of an entity it looks at")
    fov: Fov | None = Field(None, description="vertical angle of what it sees; of the first, that of the camera")
    height: Height | None = Field(None, description="of what it sees in parallel light (m), instead of fov")


class CameraPath(Words):
    """Keyframes of a camera, and what follows the last."""

    frames: list[CameraKeyframe] = Field(description="two or more, in order of their times")
    repeat: word_of(*REPEATS) = Field(REPEATS[0], description="once, loop, or ping_pong: there and back")  # type: ignore[valid-type]


CameraKeyframes: Any = either(list[CameraKeyframe], CameraPath)


class Way:
    """How a camera is led, smoothly, where it has keyframes: by the position, the target and the lens of each."""

    def __init__(self, camera: Camera) -> None:
        frames, repeat, _ = _stated(camera)
        self._at, self._repeat = np.array([frame["at"] for frame in frames]), Repeat[repeat.upper()]
        self._said = {name: said for name in LED if (said := _said(camera, frames, name))[0] is not None}

    def position(self, time: float) -> Floats:
        """Return where it is (3,), m, at a time, s."""
        return self._between(self._said["position"], time)

    def target(self, time: float, place: Callable[[Any], Floats]) -> Floats | None:
        """Return the point (3,), m, that it looks at, None where its keyframes do not say so.

        ``place`` returns where somebody is now who is looked at, so that the way leads from one who moves to another.
        """
        return None if "target" not in self._said else self._between(list(map(place, self._said["target"])), time)

    def lens(self, time: float) -> dict[str, float]:
        """Return what its keyframes say of the lens: ``fov`` (rad) or ``height`` (m).

        A picture grows or shrinks by equal shares in equal times, as by a zoom lens, and never comes to nothing.
        """
        if "height" in self._said:
            logarithms = [[math.log(height)] for height in self._said["height"]]
            return {"height": math.exp(self._between(logarithms, time)[0])}
        if "fov" in self._said:
            logarithms = [[math.log(math.tan(0.5 * fov))] for fov in self._said["fov"]]
            return {"fov": 2.0 * math.atan(math.exp(self._between(logarithms, time)[0]))}
        return {}

    def _between(self, values: list[Any], time: float) -> Floats:
        return Curve(self._at, np.array(values, np.float64), self._repeat).point(time)


def faults_of_camera(camera: Camera) -> Iterator[WordFault]:
    """Yield what is wrong with the keyframes of a camera."""
    frames, repeat, place = _stated(camera)
    untimely = list(faults_of_times(frames, place))
    yield from untimely
    if untimely:
        return
    lenses = list(_faults_of_lenses(camera, frames, place))
    yield from lenses
    led = [name for name in (POINTS if lenses else LED) if name == "position" or any(name in frame for frame in frames)]
    said = {name: _said(camera, frames, name) for name in led}
    for name in led:
        if said[name][0] is None:
            yield WordFault((*place, 0, name), "is missing; the first keyframe says where the path begins")
        elif repeat == "loop" and said[name][0] != said[name][-1]:
            what = f"must have the {name} of the first, for the path to begin anew there; close it, or state ping_pong"
            yield WordFault((*place, len(frames) - 1), what)
    if "target" in led and camera.target is not None:
        yield WordFault(("target",), "keyframes say what it looks at; remove one of the two")
        return
    aims = said.get("target", [camera.target or (0.0, 0.0, 0.0)] * len(frames))
    for number, (position, aim) in enumerate(zip(said["position"], aims, strict=True)):
        if position is not None and position == aim:
            yield WordFault((*place, number), "looks at where it stands", accepted="a target elsewhere")


def _faults_of_lenses(camera: Camera, frames: Any, place: Steps) -> Iterator[WordFault]:
    """Yield where there is another lens than the camera or a keyframe before has, or the camera's once more."""
    stated: list[tuple[Steps, str]] = [((name,), name) for name in LENSES if name in camera.model_fields_set]
    if stated and stated[0][1] in frames[0]:
        yield WordFault(stated[0][0], "keyframes say how much it sees; remove one of the two")
    stated += [((*place, n, name), name) for n, frame in enumerate(frames) for name in LENSES if name in frame]
    other = next((where for where, name in stated if name != stated[0][1]), None)
    if other is not None:
        yield WordFault(other, "must state one lens", " and ".join(LENSES), "fov, or height for parallel light")


def named(camera: Camera) -> Iterator[tuple[Steps, str]]:
    """Yield where keyframes name whom they look at, among the words of the camera, and the name."""
    frames, _, place = _stated(camera)
    for number, frame in enumerate(frames):
        if isinstance(frame.get("target"), str):
            yield (*place, number, "target"), frame["target"]


def _stated(camera: Camera) -> tuple[Any, str, tuple[str, ...]]:
    """Return keyframes, how they repeat, and where they stand among the words of the camera."""
    return stated(camera.model_dump(include={"keyframes"})["keyframes"])


def _said(camera: Camera, frames: Any, name: str) -> list[Any]:
    """Return what keyframes say by a word, each what the one before does where it says nothing; None at first.

    What the first says nothing of is of a lens that of the camera.
    """
    lens = name in LENSES and any(name in frame for frame in frames)
    found: list[Any] = [getattr(camera, name) if lens else None]
    for frame in frames:
        found.append(frame.get(name, found[-1]))
    return found[1:]
