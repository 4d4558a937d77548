"""Paths: from the keyframes that are stated of an entity to those it goes along."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from carom.ecs import Transform, World
from carom.ecs.column import Floats
from carom.ecs.components.path import Path, Repeat
from carom.ecs.errors import DeclarationError
from carom.ecs.relations.keyframe import Keyframe
from carom.ecs.spatial import quaternion
from carom.systems.keyframes import poses_at
from carom.systems.parameters import WordFault, refusal
from carom.systems.settings import Settings, time_of

Words = Mapping[str, Any]
POSE = ("position", "rotation")
FRAME = ("at", *POSE)
REPEATS = tuple(repeat.name.lower() for repeat in Repeat)
SAME_TURN = 1e-12  # how far from 1 the product of two quaternions may be that are the same rotation: rounding


def faults_of_path(words: Words) -> Iterator[WordFault]:
    """Yield what is wrong with the ``keyframes`` among the words of an entity, and with the words beside them."""
    frames, repeat, place = stated(words["keyframes"])
    body = words.get("body")
    if body is None:
        yield WordFault(("keyframes",), "only a kinematic body follows keyframes; give it body: {type: kinematic}")
    elif body.get("type", "dynamic") != "kinematic":
        yield WordFault(("body", "type"), "only a kinematic body follows keyframes", body.get("type", "dynamic"))
    if words.get("motion") is not None:
        yield WordFault(("motion",), "keyframes say how it moves; remove motion or keyframes")
    if (body or {}).get("locked"):
        yield WordFault(("body", "locked"), "keyframes say how it moves; remove locked or keyframes")
    for name in (*POSE, "jitter"):
        first = frames[0] if frames else {}
        if name in (words.get("transform") or {}) and ("position" if name == "jitter" else name) in first:
            yield WordFault(("transform", name), "the first keyframe says where it is; remove one of the two")
    unknown = [(n, key) for n, frame in enumerate(frames) for key in frame if key not in FRAME]
    for n, key in unknown:
        yield WordFault((*place, n, key), f"unknown key; a keyframe has {', '.join(FRAME)}")
    if repeat not in REPEATS:
        yield WordFault(("keyframes", "repeat"), f"must be one of {', '.join(REPEATS)}", repr(repeat))
    yield from faults_of_times(frames, place)
    if repeat == "loop" and frames:
        position, rotation = poses(frames, words.get("transform") or {})
        same_turn = abs(float((rotation[0] * rotation[-1]).sum())) >= 1.0 - SAME_TURN
        if not ((position[0] == position[-1]).all() and same_turn):
            what = "must have the pose of the first, for the path to begin anew there; close it, or state ping_pong"
            yield WordFault((*place, len(frames) - 1), what)


def faults_of_times(frames: Sequence[Words], place: tuple[str, ...]) -> Iterator[WordFault]:
    """Yield what is wrong with how many keyframes there are, and with their times; they stand at ``place``."""
    if len(frames) < 2:
        yield WordFault(("keyframes",), "must be two or more", str(len(frames)))
    untimed = [n for n, frame in enumerate(frames) if not np.isfinite(frame.get("at", np.nan))]
    for n in untimed:
        yield WordFault((*place, n, "at"), "must be a time in s")
    for n in range(1, len(frames)):
        if not {n - 1, n} & set(untimed) and not frames[n]["at"] > frames[n - 1]["at"]:
            what = f"must be later than the keyframe before, {frames[n - 1]['at']:g} s"
            yield WordFault((*place, n, "at"), what, f"{frames[n]['at']:g} s")


def stated(keyframes: Words | Sequence[Words]) -> tuple[Sequence[Words], str, tuple[str, ...]]:
    """Return the keyframes, how they repeat, and where they are stated among the words of an entity.

    A word of None is as good as none.
    """
    frames: Any = keyframes
    repeat: str = REPEATS[0]
    place: tuple[str, ...] = ("keyframes",)
    if isinstance(keyframes, Mapping):
        frames, repeat = keyframes.get("frames", ()), keyframes.get("repeat", REPEATS[0])
        place = ("keyframes", "frames")
    return [{key: value for key, value in frame.items() if value is not None} for frame in frames], repeat, place


def poses(frames: Sequence[Words], transform: Words) -> tuple[Floats, Floats]:
    """Return positions (n, 3) in m and rotations (n, 4); what a keyframe leaves out is as in the one before.

    What the first leaves out is in ``transform``.
    """
    now: dict[str, Any] = {"position": (0.0, 0.0, 0.0), "rotation": quaternion.IDENTITY} | dict(transform)
    position, rotation = np.zeros((len(frames), 3)), np.zeros((len(frames), 4))
    for n, frame in enumerate(frames):
        now |= frame
        position[n], rotation[n] = now["position"], now["rotation"]
    return position, quaternion.unit(rotation)


def path_of(world: World, words: Words) -> tuple[Transform, Path]:
    """Return where an entity is now and its path, whose keyframes are added to the world.

    Raises DeclarationError naming everything that is wrong with its keyframes.
    """
    faults = list(faults_of_path(words))
    if faults:
        raise refusal(faults)
    frames, repeat, _ = stated(words["keyframes"])
    first, count, (position, rotation) = world.count(Keyframe), len(frames), poses(frames, words.get("transform") or {})
    turned = quaternion.multiply(rotation, quaternion.conjugate(rotation[0]))
    leaves = np.ptp(position[:, 2]) > 0.0 or np.abs(turned[:, :2]).max() > SAME_TURN
    if leaves and world[Settings].dimensions == 2:
        raise DeclarationError("keyframes: must keep to one z and turn about z only with dimensions: 2")
    with world.faces(None):
        world.resize(Keyframe, first + count)
        keyframe = world[Keyframe]
        new = slice(first, first + count)
        keyframe.at[new] = [frame["at"] for frame in frames]
        keyframe.position[new], keyframe.rotation[new] = position, rotation
        path = np.array([first]), np.array([count]), np.array([Repeat[repeat.upper()].value])
        now = poses_at(keyframe, np.array([0]), time_of(world), *path)
    return Transform(position=now[0], rotation=now[1]), Path(first=path[0], count=path[1], repeat=path[2])
