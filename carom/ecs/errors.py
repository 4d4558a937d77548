"""Errors of the table: each says what, where, what was received, what is accepted and how to mend it."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from functools import lru_cache
from itertools import islice

MOST_COMPARED, LONGEST_WORD = 1000, 100  # choices, and characters of a word that is compared with them


class CaromError(Exception):
    """Base of every error carom raises on purpose; the command line prints it without a traceback and exits 2."""


class DeclarationError(CaromError):
    """A component, system or schedule is declared wrongly."""


class AccessError(CaromError):
    """A system touched what it does not declare, or something outside the step wrote to a column."""


class EntityError(CaromError):
    """An entity handle or name does not lead to a living entity with the wanted component."""


class SnapshotError(CaromError):
    """A snapshot does not fit the world it is restored into."""


class NonFiniteError(CaromError):
    """A NaN or an infinity appeared in a column of ``entity``, or of a contact of two; ``by`` says what wrote it."""

    def __init__(self, frame: int, column: str, entity: str, value: str, by: str) -> None:
        super().__init__(f"frame {frame}: {column} of entity '{entity}' is {value}, {by}")
        self.frame, self.column, self.entity, self.value, self.by = frame, column, entity, value, by


def did_you_mean(word: str, choices: Iterable[str], most: int = 1) -> str:
    """Return a question that names the ``most`` nearest choices, or nothing when none is near.

    Only the first thousand are compared, and no long word: a thousand faults among a million names shall be told soon.
    """
    near = _nearest(word, tuple(islice(choices, MOST_COMPARED)), most) if len(word) <= LONGEST_WORD else []
    return f"did you mean {' or '.join(map(repr, near))}?" if near else ""


@lru_cache(64)
def _nearest(word: str, choices: tuple[str, ...], most: int) -> list[str]:
    return difflib.get_close_matches(word, choices, most)
