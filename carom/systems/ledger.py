"""Ledger: where the energy of a world came from and where it went."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.systems.kernels.accounting import ARC

ROUNDING = 1e-12  # of the greatest entry
KINDS = ("contacts", "friction", "impacts")  # entries that pairs of colliders share
NOBODY: Integers = np.zeros(0, np.int64)


class Dissipation(NamedTuple):
    """Work (n,) in J of colliders a and b (n,), handles, on their bodies, below 0 where it was lost.

    It is that along the normals of resting contacts, that of their friction, and that of impacts with theirs.
    """

    a: Integers
    b: Integers
    contacts: Floats
    friction: Floats
    impacts: Floats

    @classmethod
    def of(cls, a: Integers = NOBODY, b: Integers = NOBODY, **work: Floats) -> Dissipation:
        """Return copies of these pairs with what is known of their work; the rest is 0."""
        return cls(+a, +b, *(+work[kind] if kind in work else np.zeros(len(a)) for kind in KINDS))

    @property
    def work(self) -> Floats:
        """All of it (n,), J."""
        return self.contacts + self.friction + self.impacts


class Ledger(Resource):
    """Energy (J) that bodies gained in the last step by each force, impulse and correction, once it is kept.

    Forces, by name, are booked by what they did along the way that bodies took, with what they hold as potential: so
    gravity books nothing. Beside them:

    - ``contacts`` and ``friction``: impulses of resting contacts along normals and across;
    - ``joints``, ``drives`` and ``joint friction``: what joints do by locks and limits, springs and motors, and rub;
    - ``impacts``: those of impacts, friction included;
    - ``integration``: what forces did to velocities less what they did along the way, contacts that bend arcs too;
    - ``turning``: what free turning gained, and ``locks``: velocities along locked axes that were set from outside;
    - ``sleep``: motion of bodies that fell asleep;
    - ``edits``: what was changed between two steps; systems of others that are no forces are booked under their names.

    Their sum is the change of total energy, but for rounding; none of them is found as the rest of it.
    """

    def __init__(self) -> None:
        self.kept = False
        self.entries: Counter[str] = Counter()
        self.since: Counter[str] = Counter()
        self.change = 0.0  # of total energy in the last step, measured
        self.parts: list[Dissipation] = []  # of the last step, a pair as often as it did any work
        self.pull: Floats = np.zeros((0, 3))  # (m/s2) by which forces bend arcs, for the flight to tell contacts from
        self.arc: Floats = np.zeros((0, ARC))  # what arcs did, see `note_arc`; no rows while nothing is kept

    @property
    def dissipation(self) -> Dissipation:
        """What each pair of colliders did in the last step."""
        a, b, *work = (np.concatenate(column) for column in zip(Dissipation.of(), *self.parts, strict=True))
        pairs, place = np.unique(np.stack([a, b], axis=1), axis=0, return_inverse=True)
        summed = [np.asarray(np.bincount(place.ravel(), one, len(pairs)), np.float64) for one in work]
        return Dissipation(pairs[:, 0], pairs[:, 1], *summed)

    def text(self) -> str:
        """Return what was booked since the ledger was opened, the greatest first, as a table; rounding is left out."""
        booked = sorted(self.since.items(), key=lambda entry: -abs(entry[1]))
        least = ROUNDING * max((abs(energy) for _, energy in booked), default=0.0)
        lines = [f"  {name:<22}{energy:>+14.6g} J" for name, energy in booked if abs(energy) > least]
        return "\n".join(["energy given and taken", *lines, f"  {'in all':<22}{sum(self.since.values()):>+14.6g} J"])
