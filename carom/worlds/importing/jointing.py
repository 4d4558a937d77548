"""Freedoms of a joint as the words of one of carom's kinds."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.worlds.importing.model import SLIDE, TURN, Connection, Freedom

ACROSS = 1e-6  # cosine below which two axes count as perpendicular
TOGETHER = 1e-9  # m, within which two anchors count as one
LINEAR, ANGULAR = ("x", "y", "z"), ("rotation_x", "rotation_y", "rotation_z")
FREE = dict.fromkeys((*LINEAR, *ANGULAR), "free")


def joint_words(connection: Connection) -> dict[str, Any] | None:
    """Return the words of the joint but for its ends, or None where no single one has these freedoms."""
    free = connection.freedoms
    if connection.apart:
        return {"generic": {"at": connection.at} | FREE}
    if connection.ball:
        swing = {} if connection.swing is None else {"axis": np.array((0.0, 1.0, 0.0)), "swing": connection.swing}
        return {"ball": {"at": connection.at} | swing}
    if not free:
        return {"fixed": {"at": connection.at}}
    if len(free) == 1:
        kind = "slider" if free[0].kind == SLIDE else "hinge"
        return {kind: {"at": free[0].at, "axis": free[0].axis} | way_words(free[0])}
    slides, turns = ([f for f in free if f.kind == kind] for kind in (SLIDE, TURN))
    if not _fits(free, slides, turns):
        return None
    if not slides and len(turns) == 2 and turns[0].friction == turns[1].friction:
        first, second = turns
        words = {"at": first.at, "axis": first.axis, "second_axis": second.axis} | way_words(first)
        more = way_words(second)
        words |= {f"second_{key}": value for key, value in more.items() if key != "friction"}
        return {"universal": words}
    return {"generic": _generic(slides, turns)}


def way_words(freedom: Freedom, sign: float = 1.0) -> dict[str, Any]:
    """Return what bounds and drives a freedom, turned round with ``sign`` -1."""
    words: dict[str, Any] = {}
    if freedom.limits is not None:
        words["limits"] = sorted(sign * x for x in freedom.limits)
    motor: dict[str, float] = {}
    if freedom.stiffness:
        motor |= {"target": sign * freedom.target, "stiffness": freedom.stiffness}
    if freedom.damping:
        motor |= {"damping": freedom.damping}
    if motor and freedom.most is not None:
        motor |= {"most": freedom.most}
    words |= {"motor": motor} if motor else {}
    return words | ({"friction": freedom.friction} if freedom.friction else {})


def _fits(free: list[Freedom], slides: list[Freedom], turns: list[Freedom]) -> bool:
    """Tell whether one joint has these freedoms in their order: slides in a's frame, then turns about one point."""
    if len(slides) > 3 or len(turns) > 3 or any(f.kind == SLIDE for f in free[len(slides) :]):
        return False
    if any(np.abs(turn.at - turns[0].at).max() > TOGETHER for turn in turns):
        return False
    axes: list[Any] = []
    for freedom in free:
        if not any(_cosine(freedom.axis, axis) > 1.0 - ACROSS for axis in axes):
            if any(_cosine(freedom.axis, axis) > ACROSS for axis in axes):
                return False
            axes.append(freedom.axis)
    alike = [sum(_cosine(f.axis, axis) > 1.0 - ACROSS for f in kind) for kind in (slides, turns) for axis in axes]
    return max(alike) == 1


def _cosine(a: Any, b: Any) -> float:
    return abs(float(np.dot(a, b)))


def _generic(slides: list[Freedom], turns: list[Freedom]) -> dict[str, Any]:
    """Return the frame and the ways: turns are about x, y, z in this order, slides along whichever axis is theirs."""
    axes: list[Any] = [turn.axis for turn in turns]
    for slide in slides:
        if len(axes) < 3 and all(_cosine(slide.axis, axis) < 0.5 for axis in axes):
            axes.append(slide.axis)
    if len(axes) == 1:
        axes.append(np.cross((0.0, 0.0, 1.0) if abs(axes[0][2]) < 0.9 else (1.0, 0.0, 0.0), axes[0]))
    x, y = axes[0], axes[1]
    frame = (x, y, np.cross(x, y))
    words: dict[str, Any] = {"at": (turns or slides)[0].at, "axis": x, "second_axis": frame[2]}
    for kinds, names in ((slides, LINEAR), (turns, ANGULAR)):
        for freedom in kinds:
            along = [float(np.dot(freedom.axis, axis)) for axis in frame]
            number = int(np.argmax(np.abs(along)))
            words[names[number]] = way_words(freedom, float(np.sign(along[number]))) or "free"
    return words
