"""Bodies in words: those that were stated where they still say the same, else what the body weighs."""

from __future__ import annotations

from collections.abc import Sequence

from carom.ecs import RigidBody
from carom.ecs.components.rigid_body import BodyType
from carom.ecs.errors import DeclarationError
from carom.systems.compound import StatedBodies
from carom.systems.freedom import AXES, LOCKED_BY_DIMENSIONS
from carom.systems.mass import PASSED_ON, Part, rigid_body
from carom.systems.settings import Settings
from carom.worlds.writing.columns import Columns, Words, plain, sayable

SPREAD = ("mass", "inertia", "principal_axes", "center_of_mass")


def body_words(columns: Columns, row: int, parts: Sequence[Part]) -> Words:
    """Return the words of a body that weighs by ``parts``."""
    before = columns.world[StatedBodies].words.get(columns.world.entity(row))
    words: Words = {} if before is None else plain(dict(before))
    if before is not None and says(columns, row, words, parts):
        return words
    words = shared(columns, row)
    return words if says(columns, row, words, parts) else words | spread(columns, row)


def says(columns: Columns, row: int, words: Words, parts: Sequence[Part]) -> bool:
    """Tell whether words make the body of a row, to the bit."""
    dimensions = columns.world[Settings].dimensions
    try:
        return sayable(words) and columns.as_made(row, rigid_body(words, parts, dimensions))
    except (DeclarationError, KeyError):  # words that were stated of another body may mean nothing here
        return False


def shared(columns: Columns, row: int) -> Words:
    """Return what is said of a body beside how its mass is spread."""
    words: Words = {}
    if (kind := BodyType(columns.held(RigidBody, "type", row))) is not BodyType.DYNAMIC:
        words["type"] = kind.name.lower()
    words |= columns.stated(RigidBody, row, PASSED_ON)
    settled = LOCKED_BY_DIMENSIONS[columns.world[Settings].dimensions]
    freedom = columns.held(RigidBody, "freedom", row)
    locked = [axis for axis, free in zip(AXES, freedom, strict=True) if not free and axis not in settled]
    return words | ({"locked": locked} if locked else {})


def spread(columns: Columns, row: int) -> Words:
    """Return how its mass is spread."""
    values = {name: columns.held(RigidBody, name, row) for name in SPREAD}
    if not values["mass"] > 0.0:
        del values["mass"]
    return {name: value for name, value in values.items() if sayable(value)}
