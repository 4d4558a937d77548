"""Stating: the shapes that words of a world file, in SI, stand for."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from inspect import Parameter, signature
from typing import Any, TypeVar

import numpy as np

from carom.ecs.errors import DeclarationError
from carom.systems.parameters import WordFault, refusal, unknown_keys
from carom.systems.shapes import SHAPES, Shape

Words = Mapping[str, Any]
Found = TypeVar("Found", bound=tuple[Any, ...])  # a NamedTuple


def shape_of(words: Words, *, seen: bool = False) -> Shape:
    """Return the shape that the words of a collider state, or those of a visual, which is only ``seen``."""
    return shapes_of(words, seen=seen)[0]


def shapes_of(words: Words, *, seen: bool = False) -> Sequence[Shape]:
    """Return the shape that words state, or, where its numbers are rows (n, ...), one per entity, n shapes of a kind.

    Raises DeclarationError for no shape, for several, and for what is wrong with one.
    """
    if isinstance(words.get("shape"), Shape):
        return [words["shape"]]
    keys = [key for key in words if key in SHAPES]
    if len(keys) != 1:
        found = f"received {', '.join(keys)}" if keys else "received none"
        raise DeclarationError(f"state exactly one shape of {', '.join(sorted(SHAPES))}; {found}")
    stated = words[keys[0]]
    if isinstance(stated, Shape):
        return [stated]
    kind = SHAPES[keys[0]]
    if wrong := list(shape_faults((keys[0],), kind, stated)):
        raise refusal(wrong)
    shapes = [kind.seen(**row) if seen else kind.stated(**row) for row in _rows(kind, stated)]
    for note in getattr(getattr(shapes[0], "geometry", None), "notes", ()):
        warnings.warn(note, stacklevel=2)
    return shapes


def shape_faults(path: tuple[str, ...], kind: type[Shape], words: Words) -> Iterator[WordFault]:
    """Yield which words a kind of shape does not take, and which it lacks."""
    takes = _takes(kind)
    yield from unknown_keys(path, words, takes)
    missing = [name for name, one in takes.items() if one.default is Parameter.empty and name not in words]
    yield from (WordFault((*path, name), "is missing") for name in missing)


@cache
def _takes(kind: type[Shape]) -> Mapping[str, Parameter]:
    """Return the words of a shape: its fields, or what it takes in their place."""
    takes = signature(kind.stated).parameters
    anything = any(one.kind is Parameter.VAR_KEYWORD for one in takes.values())
    return signature(kind).parameters if anything else takes


def _rows(kind: type[Shape], stated: Words) -> Sequence[Words]:
    """Return the words of each entity."""
    widths = {field.name: int("width" in field.metadata) for field in kind.parameters()}
    each = [key for key in stated if key in widths and np.ndim(stated[key]) > widths[key]]
    rows = zip(*(np.asarray(stated[key]).tolist() for key in each), strict=True)
    return [{**stated, **dict(zip(each, row, strict=True))} for row in rows] if each else [stated]


def stacked(found: Sequence[Found]) -> Found:
    """Return what was found of one shape as it is, and of several with a row of each in every field."""
    return found[0] if len(found) == 1 else type(found[0])(*map(np.array, zip(*found, strict=True)))
