"""Bodies in words: those that were stated where they still say the same, else what the body weighs."""

from __future__ import annotations

from collections.abc import Sequence

from carom.ecs import RigidBody, World
from carom.ecs.components.rigid_body import BodyType
from carom.ecs.errors import DeclarationError
from carom.systems.compound import StatedBodies
from carom.systems.freedom import AXES, LOCKED_BY_DIMENSIONS
from carom.systems.mass import PASSED_ON, Part, rigid_body
from carom.systems.settings import Settings
from carom.worlds.writing.columns import Words, as_made, held, plain, sayable, stated

SPREAD = ("mass", "inertia", "principal_axes", "center_of_mass")


def body_words(world: World, row: int, parts: Sequence[Part]) -> Words:
    """Return the words of a body that weighs by ``parts``."""
    before = world[StatedBodies].words.get(world.entity(row))
    forms = [] if before is None else [plain(dict(before))]
    forms += [shared(world, row), shared(world, row) | spread(world, row)]
    return next((words for words in forms if says(world, row, words, parts)), forms[-1])


def says(world: World, row: int, words: Words, parts: Sequence[Part]) -> bool:
    """Tell whether words make the body of a row, to the bit."""
    try:
        return sayable(words) and as_made(world, row, rigid_body(words, parts, world[Settings].dimensions))
    except (DeclarationError, KeyError):  # words that were stated of another body may mean nothing here
        return False


def shared(world: World, row: int) -> Words:
    """Return what is said of a body beside how its mass is spread."""
    words: Words = {}
    if (kind := BodyType(held(world, RigidBody, "type", row))) is not BodyType.DYNAMIC:
        words["type"] = kind.name.lower()
    words |= stated(world, RigidBody, row, PASSED_ON)
    settled = LOCKED_BY_DIMENSIONS[world[Settings].dimensions]
    freedom = held(world, RigidBody, "freedom", row)
    locked = [axis for axis, free in zip(AXES, freedom, strict=True) if not free and axis not in settled]
    return words | ({"locked": locked} if locked else {})


def spread(world: World, row: int) -> Words:
    """Return how its mass is spread."""
    values = {name: held(world, RigidBody, name, row) for name in SPREAD}
    if not values["mass"] > 0.0:
        del values["mass"]
    return {name: value for name, value in values.items() if sayable(value)}
