"""Paths of cameras: keyframes that say when it is where, and what it looks at then."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from carom.ecs.column import Floats
from carom.ecs.components.path import Repeat
from carom.systems.curves import Curve
from carom.systems.parameters import WordFault
from carom.systems.paths import REPEATS, faults_of_times, stated
from carom.worlds.sections import Time
from carom.worlds.values import Lengths, Words, either, word_of

if TYPE_CHECKING:
    from carom.worlds.camera import Camera

POINTS = ("position", "target")


class CameraKeyframe(Words):
    """Where a camera is at a time; what it leaves out is as in the keyframe before."""

    at: Time = Field(description="simulated time (s)")
    position: Lengths | None = Field(None, description="where it is (m)")
    target: Lengths | None = Field(None, description="point it looks at (m)")


class CameraPath(Words):
    """Keyframes of a camera, and what follows the last."""

    frames: list[CameraKeyframe] = Field(description="two or more, in order of their times")
    repeat: word_of(*REPEATS) = Field(REPEATS[0], description="once, loop, or ping_pong: there and back")  # type: ignore[valid-type]


CameraKeyframes: Any = either(list[CameraKeyframe], CameraPath)


def faults_of_camera(camera: Camera) -> Iterator[WordFault]:
    """Yield what is wrong with the keyframes of a camera."""
    frames, repeat, place = _stated(camera)
    untimely = list(faults_of_times(frames, place))
    yield from untimely
    if untimely:
        return
    looks = any("target" in frame for frame in frames)
    for name in POINTS if looks else POINTS[:1]:
        if name not in frames[0]:
            yield WordFault((*place, 0, name), "is missing; the first keyframe says where the path begins")
        elif repeat == "loop" and not np.array_equal(*_points(frames, name)[[0, -1]]):
            what = f"must have the {name} of the first, for the path to begin anew there; close it, or state ping_pong"
            yield WordFault((*place, len(frames) - 1), what)
    if looks and camera.target is not None:
        yield WordFault(("target",), "keyframes say what it looks at; remove one of the two")
    elif not isinstance(camera.target, str):
        aim = _points(frames, "target") if looks else np.array(camera.target or (0.0, 0.0, 0.0))
        for number in np.nonzero((_points(frames, "position") == aim).all(axis=1))[0].tolist():
            yield WordFault((*place, number), "looks at where it stands", accepted="a target elsewhere")


def curves_of(camera: Camera) -> dict[str, Curve]:
    """Return the ways along which a camera is led: of its position and, where keyframes state it, of its target."""
    frames, repeat, _ = _stated(camera)
    at = np.array([frame["at"] for frame in frames])
    led = [name for name in POINTS if name in frames[0]]
    return {name: Curve(at, _points(frames, name), Repeat[repeat.upper()]) for name in led}


def _stated(camera: Camera) -> tuple[Any, str, tuple[str, ...]]:
    """Return keyframes, how they repeat, and where they stand among the words of the camera."""
    return stated(camera.model_dump(include={"keyframes"})["keyframes"])


def _points(frames: Any, name: str) -> Floats:
    """Return the points (n, 3), m, of keyframes, each as in the one before where it states none."""
    found, now = np.zeros((len(frames), 3)), (0.0, 0.0, 0.0)
    for number, frame in enumerate(frames):
        found[number] = now = frame.get(name, now)
    return found
