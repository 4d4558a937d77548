"""Amounts: how many entities a world asks for, told before any is made, since they would fill the memory."""

from __future__ import annotations

from carom.worlds.generators import GENERATORS, Generator
from carom.worlds.generators.generator import MOST_COPIES
from carom.worlds.sections import ChainWords
from carom.worlds.source import Source
from carom.worlds.unfold import Item

MOST_ENTITIES = 1_000_000


def few_enough(source: Source, items: list[Item]) -> bool:
    """Tell whether a world may have these entities with all their copies and links; report who is beyond that."""
    total = 0
    for item in items:
        copying = [key for key in (*GENERATORS, "chain") if getattr(item.words, key, None) is not None]
        total += max([1, *(amount(getattr(item.words, key)) for key in copying)])
        if total > MOST_ENTITIES:
            what = f"brings the world to {total} entities, more than the {MOST_ENTITIES} it may have"
            source.report((*item.path, *copying[:1]), what, hint="take fewer")
            return False
    return True


def amount(copies: Generator | ChainWords) -> int:
    """Return how many entities words ask for; none where a generator refuses to lay so many."""
    if isinstance(copies, ChainWords):
        return copies.count
    return copies.amount() if copies.amount() <= MOST_COPIES else 0
