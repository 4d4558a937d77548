"""Reach: whom a law acts on, where, and when."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from carom.ecs import Collider, RigidBody, World
from carom.ecs.column import Integers
from carom.ecs.errors import did_you_mean
from carom.systems.bodies import centers_of_mass
from carom.systems.compound import bodies_of
from carom.systems.declared import read_words
from carom.systems.forces.region import Region
from carom.systems.layers import Layers
from carom.systems.parameters import WordFault

NOBODY: Integers = np.zeros(0, np.int64)
END = "end"  # of a time window: for good
WINDOW = "(0.5, 2) in s, or (0.5, 'end') for good"


@dataclass(frozen=True)
class Reach:
    """Whom a law acts on: these entities (None: every body), in a region, on layers (bits), in a time window (s)."""

    entities: tuple[int, ...] | None = None
    region: Region | None = None
    layers: tuple[int, ...] | None = None
    during: tuple[float, float] | None = None

    @property
    def limited(self) -> bool:
        """Whether whom it acts on may differ from substep to substep."""
        return self.region is not None or self.layers is not None or self.during is not None

    @property
    def conserves(self) -> bool:
        """Whether what a force holds as potential energy is still there later, and elsewhere."""
        return self.region is None and self.during is None

    def acts_at(self, time: float) -> bool:
        """Tell whether a time (s) is in the window, its start included."""
        return self.during is None or self.during[0] <= time < self.during[1]

    def turns_within(self, begin: float, end: float) -> bool:
        """Tell whether the window begins or ends after ``begin`` (s) and not after ``end``."""
        return self.during is not None and any(begin < edge <= end for edge in self.during)

    def rows(self, world: World) -> Integers:
        """Return the rows of the bodies it acts on within the window, by where centres of mass are now."""
        rows = world.row_numbers(RigidBody)
        if self.entities is not None:
            handles = np.array(self.entities, np.int64)
            rows = world.slots.rows(handles[world.slots.live(handles)])  # of who is despawned, forces went as well
            rows = rows[world.table(RigidBody).present[rows]]  # of an emitter it means the particles
        if self.layers is not None:
            colliders = world.row_numbers(Collider)
            on = colliders[np.isin(world[Collider].layer[colliders], self.layers)]
            rows = rows[np.isin(rows, bodies_of(world)[on])]
        if self.region is not None:
            rows = rows[self.region.contains(centers_of_mass(world, rows))]
        return rows


def read_reach(
    known: Layers,
    faults: list[WordFault],
    entities: Iterable[int] | None = None,
    region: Any = None,
    layers: Sequence[str] | None = None,
    during: Any = None,
) -> Reach:
    """Return what these words state; what is wrong with them is added to ``faults``."""
    if region is not None and not isinstance(region, Region):
        region = read_words(Region, region, ("region",), faults)
    for place, name in enumerate(layers or ()):
        if name not in known.bits:
            accepted, hint = ", ".join(known.bits), did_you_mean(str(name), known.bits)
            faults.append(WordFault(("layers", place), "unknown layer", repr(name), accepted, hint, str(name)))
    return Reach(
        entities=None if entities is None else tuple(entities),
        region=region,
        layers=None if layers is None else tuple(known.bits[name] for name in layers if name in known.bits),
        during=None if during is None else _window(during, faults),
    )


def _window(during: Any, faults: list[WordFault]) -> tuple[float, float] | None:
    times = [math.inf if time == END else time for time in during] if isinstance(during, (list, tuple)) else []
    if len(times) != 2 or not all(isinstance(time, (int, float)) for time in times):
        faults.append(WordFault(("during",), "is no time window", repr(during), WINDOW))
    elif not 0.0 <= times[0] < times[1]:
        faults.append(WordFault(("during",), "must start at 0 s or later and end after that", repr(during), WINDOW))
    else:
        return float(times[0]), float(times[1])
    return None
