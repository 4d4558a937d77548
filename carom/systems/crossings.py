"""Crossings: when the gap of a sensor and a body on its way changes sign."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from itertools import pairwise
from math import copysign, sqrt
from typing import Any

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.systems.constants import CROSSED, CROSSING_GAP, MOST_PROBES, SENSED

Asking = Generator[float, float, None]  # yields a time (s) and is sent the gap (m) there
Spot = tuple[float, float]  # a time and the gap there


def is_out(gap: Any, inside: Any) -> Any:
    """Tell whether a gap (m) is that of the other side, for one pair or for arrays.

    Who is inside is so until SENSED away, else who only touches would go in and out.
    """
    return (gap > SENSED * inside) == inside


def may_trip(before: Any, after: Any, inside: Any, speed: Any, bend: Any, span: Any) -> Any:
    """Tell whether a gap may change sign between two of one side ``span`` (s) apart, deeper than SENSED.

    It changes by at most ``speed`` (m/s), and with ``bend`` / 2 t^2 (m/s2) added it is convex, as the signed distance
    of convex shapes is on a straight way.
    """
    bulge = 0.125 * bend * span * span
    rises = (before + bulge > SENSED) | (after + bulge > SENSED)
    return (abs(before + after) < speed * span - SENSED) & (inside <= rises)


@dataclass
class Search:
    """Looks for the crossings of one pair within a substep, asking for gaps one at a time.

    ``speed`` and ``bend`` are those of `may_trip` between ``knots`` (s), at which a body was struck; ``bend`` is
    infinite where a shape is not convex. ``found`` are the times and whether the pair came in.
    """

    speed: float
    bend: float
    knots: list[float]
    inside: bool

    def __post_init__(self) -> None:
        self.found: list[tuple[float, bool]] = []
        self._probes = MOST_PROBES

    def run(self, before: float, after: float, span: float) -> Asking:
        """Find all crossings between the gaps at 0 and at ``span`` (s)."""
        if is_out(before, self.inside):
            self._cross(0.0)
        begin = 0.0, before
        for knot in (*self.knots, span):
            end = knot, after if knot == span else (yield knot)
            if not is_out(end[1], self.inside):
                trip = yield from self._trip(begin, end)
                if trip is not None:
                    yield from self._root(begin, trip)
                    begin = trip
            if is_out(end[1], self.inside):
                yield from self._root(begin, end)
            begin = end

    def _cross(self, time: float) -> None:
        self.inside = not self.inside
        self.found.append((time, self.inside))

    def _trip(self, begin: Spot, end: Spot) -> Generator[float, float, Spot | None]:
        """Return a spot on the other side between two on this one, None where there is none."""
        span = end[0] - begin[0]
        if not may_trip(begin[1], end[1], self.inside, self.speed, self.bend, span) or not self._probes:
            return None
        self._probes -= 1
        time = begin[0] + 0.5 * span
        gap = yield time
        if is_out(gap, self.inside):
            return time, gap
        middle, bulge = (time, gap), 0.25 * self.bend * span * span
        for one, other, beyond in ((begin, middle, end), (middle, end, begin)):
            if self.inside or min(gap, 2.0 * gap - beyond[1]) - bulge <= 0.0:  # convex: above the line from beyond
                trip = yield from self._trip(one, other)
                if trip is not None:
                    return trip
        return None

    def _root(self, begin: Spot, end: Spot) -> Asking:
        """Cross where the gap is 0, by the method of Ridders (IEEE Trans. Circuits Syst. 26, 979, 1979)."""
        if begin[1] * end[1] > 0.0:  # it was 0 just before
            end = begin
        while end[0] - begin[0] > CROSSED:
            half, time = 0.5 * (end[0] - begin[0]), 0.5 * (begin[0] + end[0])
            gap = yield time
            if abs(gap) <= CROSSING_GAP:
                begin = end = time, gap
                break
            middle = time, gap
            step = half * gap / sqrt(gap * gap - begin[1] * end[1])
            time += copysign(step, step * (begin[1] - end[1]))
            gap = yield time
            if abs(gap) <= CROSSING_GAP:
                begin = end = time, gap
                break
            spots = sorted((begin, middle, (time, gap), end))
            changes = [(one[1] > 0.0) is not (other[1] > 0.0) for one, other in pairwise(spots)]
            begin, end = spots[changes.index(True)], spots[changes.index(True) + 1]
        self._cross(0.5 * (begin[0] + end[0]))


def carry_out(searches: list[tuple[int, Asking]], gaps: Callable[[Integers, Floats], Floats]) -> None:
    """Run searches, each with the number of its pair, and answer what they ask for together."""
    asked = [(pair, search, send(search, None)) for pair, search in searches]
    while asked := [one for one in asked if one[2] is not None]:
        answers = gaps(np.array([pair for pair, _, _ in asked]), np.array([time for _, _, time in asked]))
        asked = [
            (pair, search, send(search, gap)) for (pair, search, _), gap in zip(asked, answers.tolist(), strict=True)
        ]


def send(search: Asking, gap: float | None) -> float | None:
    """Send a search the gap it asked for; return the next time it asks for, None at its end."""
    try:
        return search.send(gap)  # type: ignore[arg-type]
    except StopIteration:
        return None
