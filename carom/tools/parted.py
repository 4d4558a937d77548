"""Parted: two runs held against each other: where they part, how, and how far apart they come to be."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from carom.ecs import Difference, Snapshot, Transform


@dataclass
class Apart:
    """How far (m) who is elsewhere at the most in a frame."""

    frame: int
    metres: float
    entity: str

    @classmethod
    def of(cls, a: Snapshot, b: Snapshot) -> Apart:
        """Return it of the bodies that both hold."""
        rows_a, rows_b = a.numbers(Transform), b.numbers(Transform)
        shared, in_a, in_b = np.intersect1d(
            a.handles(rows_a), b.handles(rows_b), assume_unique=True, return_indices=True
        )
        if not len(shared):
            return Apart(a.frame, 0.0, "nobody")
        away = a.tables[Transform][1]["position"][in_a] - b.tables[Transform][1]["position"][in_b]
        farthest = np.sqrt((away * away).sum(axis=1))
        worst = int(farthest.argmax())
        return Apart(a.frame, float(farthest[worst]), a.name(int(shared[worst])))

    def __str__(self) -> str:
        return f"{self.metres:.3g} m in frame {self.frame} ('{self.entity}')"


@dataclass
class Comparison:
    """Two runs held against each other over the frames ``first`` to ``last``.

    ``good`` is a frame up to which all is the same, None for none, ``difference`` what differs first, None for nothing,
    and ``start`` a frame from which both were simulated again; ``how`` tells in words whether it came in once and grew
    or comes in again, ``reproduced`` whether both part here at all, ``apart`` how far they come to be.
    """

    a: str
    b: str
    dt: float
    first: int
    last: int
    good: int | None = None
    start: int = 0
    difference: Difference | None = None
    how: str = ""
    reproduced: bool = True
    apart: list[Apart] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    @property
    def same(self) -> bool:
        """Tell whether every bit is the same."""
        return self.difference is None

    def text(self) -> str:
        """Return it in words."""
        lines = [f"{self.a} and {self.b}: frames {self.first} to {self.last}: {'the same' if self.same else 'differ'}"]
        shared = "they begin otherwise" if self.good is None else f"the same up to frame {self.good}"
        lines[0] += ", bit for bit" if self.same else f"; {shared}"
        if self.difference is not None:
            lines += [f"  first    {self.difference}", f"  how      {self.how}"]
            moved = [str(apart) for apart in self.apart if apart.metres]
            lines += [f"  apart    {', '.join(moved)}"] if moved else []
        return "\n".join([*lines, *(f"  note     {note}" for note in self.notes)])

    def values(self) -> dict[str, Any]:
        """Return it for programs."""
        return asdict(self) | {"same": self.same}
