"""Forms: words of entities that differ in numbers only, put together as the words of all of them."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import numpy as np

EXACT = 2**53  # from here on not every whole number is also a float, which columns of both kinds would make of it


def form_of(words: Any) -> Hashable:
    """Return what words are but for their numbers: words of one form can be put together by `together`."""
    if isinstance(words, float):
        return float
    if isinstance(words, Mapping):
        return tuple([(key, form_of(value)) for key, value in words.items()])
    if isinstance(words, (list, tuple)):
        return tuple([form_of(value) for value in words]) if _numeric(words) else repr(words)
    if words is None or isinstance(words, (str, bool)):
        return words
    if isinstance(words, int) and abs(words) < EXACT:
        return int
    return id(words)  # a shape or component that is made already


def together(stated: Sequence[Any]) -> Any:
    """Return words of one form as one: each number as it is where all say the same, else with a row for each."""
    first = stated[0]
    if isinstance(first, Mapping):
        return {key: together([words[key] for words in stated]) for key in first}
    if len(stated) == 1 or not _numeric(first):
        return first
    rows = np.array(stated)
    return first if rows.tobytes() == rows[:1].tobytes() * len(rows) else rows


def _numeric(value: Any) -> bool:
    if isinstance(value, (list, tuple)):
        return bool(value) and all(map(_numeric, value))
    return isinstance(value, (int, float)) and not isinstance(value, bool)
