"""Components stated column by column under their key, in Python and in files: a user's own, and some of carom."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from carom.ecs.component import Component, Record
from carom.ecs.components.parent import Parent
from carom.ecs.components.spring import Spring
from carom.ecs.errors import DeclarationError, did_you_mean
from carom.systems.extensions import load_extensions

OF_CAROM = (Parent, Spring)


def is_own(kind: type[Record]) -> bool:
    """Tell whether a kind is declared outside carom."""
    return kind.__module__.partition(".")[0] != "carom"


def components_of_files() -> dict[str, type[Component]]:
    """Return by key what files may state: those of carom, and what extensions declare with state or without columns.

    Those a script declares are not among them, so that a file means the same to every command.
    """
    packages = {extension.package for extension in load_extensions()}
    return {
        key: kind
        for key, kind in sorted(Record.registry.items())
        if issubclass(kind, Component)
        if kind in OF_CAROM or kind.__module__.partition(".")[0] in packages
        if not kind.columns or any(column.role == "state" for column in kind.columns.values())
    }


def own_component(key: str, words: Any, others: Iterable[str]) -> Component:
    """Return the bundle of a component from a mapping of its columns; ``others`` are an entity's further words.

    Raises DeclarationError for a key that none of these components has.
    """
    own = {
        key: kind
        for key, kind in Record.registry.items()
        if issubclass(kind, Component) and (kind in OF_CAROM or is_own(kind))
    }
    if key not in own:
        words_there = [*others, *sorted(own)]
        hint = did_you_mean(key, words_there) or f"its words are {', '.join(words_there)}"
        raise DeclarationError(f"an entity has no word '{key}'; {hint}")
    if not isinstance(words, Mapping):
        columns = ", ".join(own[key].columns) or "nothing"
        raise DeclarationError(f"{key}: must be a mapping of {columns}; received {words!r}")
    return own[key](**words)
