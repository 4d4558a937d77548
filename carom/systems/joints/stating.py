"""Stating joints: from the words of an entity that is one to its component."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from carom.ecs import World
from carom.ecs.components.joint import Joint
from carom.ecs.errors import did_you_mean
from carom.systems.declared import read_words
from carom.systems.joints.held import WORLD, Held, find_held
from carom.systems.joints.kind import JOINTS, JointKind
from carom.systems.parameters import WordFault, refusal

IMMOVABLE = "holds nobody whom a force could move; a or b must have a dynamic body"


def joint_of(world: World, words: Mapping[str, Any]) -> Joint:
    """Return the component that the words of a joint state, ``{"hinge": {"a": post, ...}}``, at the poses of now.

    Raises DeclarationError naming everything that is wrong with them.
    """
    faults: list[WordFault] = []
    made = read_joint(world, words, faults)
    if made is None:
        raise refusal(faults)
    return made


def read_joint(world: World, words: Any, faults: list[WordFault]) -> Joint | None:
    """Return the component that words state; None where anything is wrong, all of which is added to ``faults``."""
    stated = list(words) if isinstance(words, Mapping) else []
    known = [key for key in stated if key in JOINTS]
    unknown = [key for key in stated if key not in JOINTS]
    for key in unknown:
        accepted, hint = ", ".join(sorted(JOINTS)), did_you_mean(str(key), JOINTS)
        faults.append(WordFault(("joint", str(key)), "unknown kind of joint", repr(key), accepted, hint))
    if len(known) != 1 and not unknown:
        received = ", ".join(known) or "none"
        faults.append(WordFault(("joint",), "must state one kind", received, ", ".join(sorted(JOINTS))))
    if len(known) != 1 or unknown:
        return None
    (key,) = known
    steps, before = ("joint", key), len(faults)
    kind = read_words(JOINTS[key], words[key], steps, faults)
    both = [_whom(world, words[key], side, steps, faults) for side in ("a", "b")]
    if kind is None or len(faults) > before:
        return None
    faults += [WordFault((*steps, *further), what) for further, what in misplaced(kind, *both)]
    return kind.joint(*both) if len(faults) == before else None


def _whom(world: World, words: Any, side: str, steps: tuple[str, ...], faults: list[WordFault]) -> Held:
    found = find_held(world, words.get(side) if isinstance(words, Mapping) else None)
    if isinstance(found, Held):
        return found
    faults.append(found._replace(steps=(*steps, side)))
    return Held()


def misplaced(kind: JointKind, a: Held, b: Held) -> list[tuple[tuple[str, ...], str]]:
    """Return what is wrong with a joint for those whom it holds."""
    if a.entity == b.entity != WORLD:
        return [((), "holds a body to itself; a and b must be two")]
    if not a.inverse_mass + b.inverse_mass > 0.0:
        return [((), IMMOVABLE)]
    return list(kind.misplaced(a, b))
