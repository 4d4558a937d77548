"""Sorted lists of pairs that threads merge: contacts recycled and found anew, and what is known to be apart."""

from __future__ import annotations

import numpy as np
import pytest
from crews import gathered

from carom.ecs.column import Integers
from carom.systems.constants import APART_MARGIN
from carom.systems.detection.narrow import Found
from carom.systems.kernels.apart import keep_apart, note_apart
from carom.systems.kernels.merging import merge_contacts

PARTS = pytest.mark.parametrize("parts", [1, 2, 3, 7])


def random_pairs(random: np.random.Generator, count: int) -> Integers:
    """Return sorted pairs (count, 2), each once."""
    chosen = np.sort(random.choice(30 * 30, count, replace=False))
    return np.stack(np.divmod(chosen, 30), axis=1)


def random_contacts(random: np.random.Generator, pairs: Integers) -> Found:
    """Return up to four contacts of each pair, each with numbers of its own."""
    number = random.integers(1, 5, len(pairs))
    a, b = np.repeat(pairs, number, axis=0).T
    n = len(a)
    return Found(
        np.ascontiguousarray(a), np.ascontiguousarray(b), np.arange(n), random.normal(size=(n, 3)),
        random.normal(size=n), random.normal(size=(n, 3)), random.integers(0, 2, n).astype(np.bool_), np.full(n, -1),
    )  # fmt: skip


@PARTS
@pytest.mark.parametrize(("old", "fresh", "dropped"), [(200, 300, 0.3), (1, 400, 0.0), (1, 0, 0.0), (300, 5, 0.9)])
def test_contacts_are_merged_in_order_of_their_pairs(parts: int, old: int, fresh: int, dropped: float) -> None:
    """Those that are kept say where in the table they were; by however many threads, also where some have none."""
    random = np.random.default_rng(7)
    pairs = random_pairs(random, old + fresh)
    is_old = np.zeros(len(pairs), np.bool_)
    is_old[random.choice(len(pairs), old, replace=False)] = True
    table, found = random_contacts(random, pairs[is_old]), random_contacts(random, pairs[~is_old])
    kept = np.nonzero(random.random(len(table.row_a)) >= dropped)[0]
    merged = Found.room(len(kept) + len(found.row_a))
    with gathered(parts) as crew:
        merge_contacts(crew, kept, *table[:-1], *found, *merged)
    stay = table.take(kept)._replace(old=kept)
    both = Found(*(np.concatenate(columns) for columns in zip(stay, found, strict=True)))
    order = np.lexsort((both.feature, both.row_b, both.row_a))
    for column, wanted in zip(merged, both.take(order), strict=True):
        assert np.array_equal(column, wanted)


@PARTS
def test_what_is_known_apart_goes_on_being_known(parts: int) -> None:
    """Of pairs that were there before until when they stay apart, and of those measured with a gap it is found."""
    random = np.random.default_rng(8)
    old, pairs = random_pairs(random, 300), random_pairs(random, 400)
    old_until, until, way = random.normal(size=300), np.empty(400), random.random(30)
    measured = pairs[np.sort(random.choice(400, 150, replace=False))]
    gaps = random.normal(size=150)
    with gathered(parts) as crew:
        keep_apart(crew, old, old_until, pairs, until)
        known = dict(zip(map(tuple, old.tolist()), old_until.tolist(), strict=True))
        wanted = [known.get((i, j), -np.inf) for i, j in pairs.tolist()]
        assert until.tolist() == wanted
        note_apart(crew, measured, gaps, pairs, way, until)
    found = dict(zip(map(tuple, measured.tolist()), gaps.tolist(), strict=True))
    for p, (i, j) in enumerate(pairs.tolist()):
        gap = found.get((i, j), 0.0)
        assert until[p] == ((1.0 - APART_MARGIN) * gap + way[i] + way[j] if gap > 0.0 else wanted[p])
