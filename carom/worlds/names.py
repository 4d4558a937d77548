"""Names in world files that stand for something defined elsewhere in it: layers, materials, entities."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from carom.ecs.errors import did_you_mean
from carom.worlds.errors import WordError

COPY = re.compile(r"\[[\d,]*\]$")
NONE_DEFINED = "none is defined"


def known(kind: str, name: str, choices: Collection[str]) -> str:
    """Return ``name`` when it is among the choices; raise WordError with the nearest one otherwise."""
    if name not in choices:
        names = list(choices)
        listed = ", ".join(names[:12]) + (", ..." if len(names) > 12 else "")
        accepted, hint = listed or NONE_DEFINED, did_you_mean(name, names)
        raise WordError(f"unknown {kind}", received=repr(name), accepted=accepted, hint=hint, name=name)
    return name


def whole_of_copy(name: str) -> str:
    """Return the name of what copies of a generator are made of: ``rain`` of ``rain[3,0,1]``."""
    return COPY.sub("", name)


def matching(pattern: str, names: Sequence[str]) -> list[str]:
    """Return the names that a pattern means, in order: itself, all copies, those that fit its ``*``, or all of a group.

    Raises WordError when it means none.
    """
    found = fitting(pattern, names)
    if not found:
        known("entity", pattern, names)
    return found


def fitting(pattern: str, names: Sequence[str]) -> list[str]:
    """Return the names that a pattern means, which may be none."""
    if pattern in names:
        return [pattern]
    first, *inner = map(re.escape, pattern.split("*"))
    last = f".*{inner.pop()}" if inner else ""
    form = first + "".join(f"(?>.*?{part})" for part in inner) + last + r"(?:\[[\d,]+\])?"  # as fnmatch: no way twice
    for fits in (re.compile(form), re.compile(form + r"\..+")):
        if found := [name for name in names if fits.fullmatch(name)]:
            return found
    return []
