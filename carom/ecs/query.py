"""Queries: which rows have these components."""

from __future__ import annotations

import numpy as np

from carom.ecs.column import Booleans, Integers

Rows = slice | Integers


def find_rows(alive: Booleans, present: list[Booleans], absent: list[Booleans]) -> tuple[Rows, Integers]:
    """Return the matching rows as a slice where contiguous (60 times cheaper to index by), and always as an array."""
    match = alive.copy()
    for mask in present:
        match &= mask
    for mask in absent:
        match &= ~mask
    numbers = np.nonzero(match)[0].astype(np.int64)
    if not len(numbers):
        return slice(0, 0), numbers
    first, last = int(numbers[0]), int(numbers[-1])
    contiguous = last - first + 1 == len(numbers)
    return (slice(first, last + 1) if contiguous else numbers), numbers
