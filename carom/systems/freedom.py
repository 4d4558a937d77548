"""Freedom: along and about which axes of the world a body may move, as stated of it and of the world."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from carom.ecs.errors import DeclarationError, did_you_mean

AXES = ("x", "y", "z", "rotation_x", "rotation_y", "rotation_z")
LOCKED_BY_DIMENSIONS: dict[int, tuple[str, ...]] = {2: ("z", "rotation_x", "rotation_y"), 3: ()}
SENSES = (("linear", "along", "m/s"), ("angular", "about", "rad/s"))


def freedom_of(locked: Iterable[str], dimensions: int) -> tuple[float, ...]:
    """Return 1 for each free axis and 0 for each that is locked; raise DeclarationError for a word that is none."""
    stated = tuple(locked)
    for word in stated:
        if word not in AXES:
            known = f"the axes are {', '.join(AXES)}"
            raise DeclarationError(f"body.locked: unknown axis {word!r}; {known}{_hint(word)}")
    return tuple(float(axis not in stated + LOCKED_BY_DIMENSIONS[dimensions]) for axis in AXES)


def refuse_locked_motion(motion: Mapping[str, Any], locked: Iterable[str], dimensions: int) -> None:
    """Raise DeclarationError for a velocity along or about an axis that is locked."""
    stated = tuple(locked)
    for index, axis in enumerate(AXES):
        word, sense, unit = SENSES[index // 3]
        velocity = np.atleast_2d(np.asarray(motion.get(word, (0.0, 0.0, 0.0)), np.float64))[:, index % 3]
        moving = velocity[velocity != 0.0]
        if not moving.size:
            continue
        if axis in LOCKED_BY_DIMENSIONS[dimensions]:
            why, mend = f" with dimensions: {dimensions}", "bodies keep to the plane z = const"
        elif axis in stated:
            why, mend = ", which is locked", f"take {axis} out of body.locked, or the velocity out of motion"
        else:
            continue
        raise DeclarationError(
            f"motion.{word}: must be 0 {sense} {axis[-1]}{why}, received {moving[0]:g} {unit}; {mend}"
        )


def _hint(word: str) -> str:
    hint = did_you_mean(word, AXES)
    return f"; {hint}" if hint else ""
