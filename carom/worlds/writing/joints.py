"""Joints in words: of the kind that makes the same columns again."""

from __future__ import annotations

from carom.ecs.components.joint import Joint
from carom.ecs.errors import DeclarationError
from carom.systems.joints.framed import Framed
from carom.systems.joints.kind import JOINTS
from carom.systems.joints.stating import joint_of
from carom.systems.parameters import words_of
from carom.worlds.writing.columns import Columns, Words, plain, sayable
from carom.worlds.writing.names import Callings

ENDS = ("a", "b")


def joint_words(columns: Columns, row: int, callings: Callings) -> Words | None:
    """Return the words of the joint of a row, None where no kind can hold what it does."""
    world = columns.world
    held = {name: values for name, values in vars(world[Joint]).items() if name in Joint.columns}
    joint = Joint(**{name: held[name][row] for name, column in Joint.columns.items() if column.role == "state"})
    ends = {side: int(getattr(joint, side)) for side in ENDS}
    ends = {side: entity for side, entity in ends.items() if entity >= 0}
    if not all(world.slots.lives(entity) for entity in ends.values()):
        return None
    names = {side: callings.of(entity) for side, entity in ends.items()}
    closest: Words | None = None
    for key, kind in sorted(JOINTS.items(), key=lambda item: item[1] is Framed):
        stated = kind.of(joint)
        if stated is None:
            continue
        words = plain(words_of(stated))
        try:
            made = joint_of(world, {key: words | ends}) if sayable(words) else None
        except DeclarationError:
            continue
        if made is None:
            continue
        closest = {key: names | words}
        if columns.as_made(row, made):
            return closest
    return closest
