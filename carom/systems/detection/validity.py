"""Validity: points that cannot be contacts are kept from the solver, counted, and named in checked mode."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import Collider, World
from carom.ecs.access import GUARDED
from carom.ecs.column import Floats, Integers
from carom.ecs.errors import CaromError
from carom.systems.constants import UNIT_NORMAL
from carom.systems.detection.answered import Answered
from carom.systems.kernels.validity import NOT_FINITE, NOT_UNIT, SOUND, TOO_DEEP, TOO_FAR
from carom.systems.shapes.shape import BY_NUMBER

if TYPE_CHECKING:
    from carom.systems.detection.narrow import Found

FAULTS = {
    NOT_FINITE: "its numbers are not finite",
    NOT_UNIT: f"its normal has the length {{value:.9g}}; accepted: 1 within {UNIT_NORMAL:g}",
    TOO_DEEP: "its depth is {value:.6g} m; accepted: at most {limit:.6g} m, which the two sizes allow",
    TOO_FAR: "its gap is {value:.6g} m; accepted: at most {limit:.6g} m, which the step can close",
}


class ContactError(CaromError):
    """A pair was measured to have a contact that cannot be."""


def without_faulty(world: World, pairs: Integers, found: Found, told: Integers, received: Floats) -> Found:
    """Return what `collect_points` has found and ``told`` of, without gaps where it left points out; these are counted.

    Raises ContactError when checked.
    """
    parts, total = told.tolist(), len(found.row_a)
    refused = total - sum(end - begin for begin, end, _, _ in parts)
    if not refused:
        return found
    world[Answered].refused += refused
    if GUARDED.get():
        part = next(part for part, (_, _, _, fault) in enumerate(parts) if fault != SOUND)
        pair, fault = parts[part][2:]
        one, other = (described(world, int(row)) for row in pairs[pair])
        what = FAULTS[fault].format(value=received[part, 0], limit=received[part, 1])
        raise ContactError(
            f"a contact of {one} and {other} cannot be: {what}; please report it with the world file, "
            "unchecked runs leave it out"
        )
    gaps = np.ones(total, np.bool_)
    for begin, end, _, _ in parts:
        gaps[begin:end] = False
    return found.without(gaps, refused)


def described(world: World, row: int) -> str:
    """Return the shape and name of a collider for messages."""
    return f"{BY_NUMBER[int(world[Collider].shape[row])].key} '{world.name(int(world.entities(row)))}'"
