"""Mending: what is wrong in a world file and can be put right without guessing, in its tree, so that comments stay."""

from __future__ import annotations

import difflib
from collections.abc import Iterator
from pathlib import Path

from carom.worlds.builder import load_text
from carom.worlds.errors import Fault, WorldError
from carom.worlds.layout import Collection, Entry, Scalar, grown, printed
from carom.worlds.lint import unused_names

ROUNDS = 16  # a fault may hide others; each round mends at least one


def mended(text: str, name: str, folder: Path) -> tuple[str, list[str]]:
    """Return the text of a file in form without what could be mended, and a line for each thing that was done.

    Words of which exactly one is near are spelt so; materials, prefabs, layers and variables that a file with entities
    defines and nobody uses are taken out. Raises WorldError when the text is not YAML.
    """
    done: list[str] = []
    for _ in range(ROUNDS):
        try:
            source = load_text(text, name, folder).source
            root = grown(text)
            lines = [] if "entities" not in source.data else list(_unused(root, [*unused_names(source)]))
        except WorldError as fault:
            if not any(it.hint for it in fault.faults):
                break
            root = grown(text)
            lines = [line for it in fault.faults if it.file == name for line in _respelt(root, it)]
        if not lines:
            break
        done += lines
        text = printed(root)
    return text, done


def _unused(root: Collection, paths: list[tuple[str, str]]) -> Iterator[str]:
    for section, name in paths:
        try:
            whole, entry = root.entry((section,)), root.entry((section, name))
        except KeyError:  # in an alias
            continue
        if isinstance(whole.node, Collection):
            whole.node.remove(entry)
            yield f"{section}.{name}: taken out, it was used nowhere"
            if not whole.node.entries and not whole.node.tail:
                root.remove(whole)


def _respelt(root: Collection, fault: Fault) -> Iterator[str]:
    """Spell a key or a name as the only one near it; yield what was done."""
    word, accepted = fault.received[1:-1], fault.accepted.split(", ")
    near = difflib.get_close_matches(word, accepted, 2)
    if fault.hint != f"did you mean {near[0] if near else ''!r}?" or len(near) != 1 or accepted[-1] == "...":
        return
    for parent, entry in _at(root, (fault.line, fault.column)):
        keys = [other.key.value for other in parent.entries if other.key is not None]
        if entry.key is not None and entry.key.value == word and near[0] not in keys:
            entry.key = Scalar(near[0], near[0], plain=True)
        elif isinstance(entry.node, Scalar) and entry.node.value == word and not entry.node.text.startswith(("&", "*")):
            entry.node = Scalar(near[0], near[0], plain=True)
        else:
            continue
        yield f"{fault.path}: {word!r} is now {near[0]!r}"
        return


def _at(node: Collection, place: tuple[int, int]) -> Iterator[tuple[Collection, Entry]]:
    """Yield the entries that begin at a place, each with what holds it: an item and its first key begin together."""
    for entry in node.entries:
        if entry.place == place:
            yield node, entry
        if isinstance(entry.node, Collection):
            yield from _at(entry.node, place)
