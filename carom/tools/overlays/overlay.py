"""Overlays: what a world file or a command asks to be drawn over the bodies, by key."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from carom.ecs import Transform, World
from carom.ecs.column import Floats, Integers
from carom.systems.bodies import centers_of_mass
from carom.systems.registry import Keyed
from carom.systems.simulation import Simulation
from carom.tools.batch import Batch
from carom.tools.marks import Color, Inset, Mark
from carom.tools.panel import Panel, text_size, width_of
from carom.tools.round_numbers import next_round
from carom.tools.view import View

OVERLAYS: dict[str, type[Overlay]] = {}


@dataclass(frozen=True)
class Seen:
    """What a picture shows: a simulation after its last step, its batches, where rows are, when (s), and from where."""

    simulation: Simulation
    batches: Sequence[Batch]
    transform: Transform
    time: float
    view: View

    @property
    def world(self) -> World:
        """The world of the simulation."""
        return self.simulation.world

    def centers(self, rows: Integers) -> Floats:
        """Return where the centres of mass of bodies are drawn (n, 3), m."""
        return centers_of_mass(self.world, rows, self.transform)

    def metres(self, share: float) -> float:
        """Return the length (m) that is this share of the picture's height at the camera's target."""
        return share * self.view.height * self.view.metres_per_pixel


class Overlay(Keyed, ABC, registry=OVERLAYS, kinds="overlays"):
    """One kind of marks; ``key`` is its word in files and commands. An instance belongs to one film or picture."""

    def watch(self, world: World) -> None:
        """See the world at the start and after every step; most overlays only look when a picture is taken."""

    @abstractmethod
    def marks(self, seen: Seen) -> Sequence[Mark]:
        """Return what to draw over the bodies."""


class Scaling:
    """Lengths of arrows: the largest value so far is about ``share`` of the picture's height at the camera's target.

    It is taken for the next of 1, 2 and 5 times a power of ten, so that arrows of a film keep their scale.
    """

    def __init__(self, share: float = 0.25) -> None:
        self._share, self._largest = share, 0.0

    def metres(self, vectors: Floats, seen: Seen) -> Floats:
        """Return vectors (n, 3) in m as long as they are to be drawn."""
        return vectors * self.metres_per_unit(vectors, seen)

    def key(self, title: str, unit: str, color: Color, seen: Seen) -> list[Mark]:
        """Return an inset with an arrow of the length at the camera's target that it stands for; none before any."""
        if not 0.0 < self._largest < math.inf:
            return []
        size, most = text_size(seen.view.height), next_round(self._largest)
        text, length = f"{title} {most:g} {unit}", self._share * seen.view.height
        panel = Panel(round(max(length, width_of(text, size))) + size, round(2.6 * size))
        panel.write((size // 2, size // 3), text, size)
        at = np.array([[size // 2, 2.0 * size], [size // 2 + length, 2.0 * size]])
        panel.curve(at, color)
        panel.curve(at[1] + np.array([[-5.0, -3.0], [0.0, 0.0], [-5.0, 3.0]]), color)
        return [Inset(panel.pixels(), "bottom left")]

    def metres_per_unit(self, vectors: Floats, seen: Seen) -> float:
        """Return the factor of these vectors (n, 3) and of what is compared with them."""
        self._largest = max(self._largest, float(np.linalg.norm(vectors, axis=1).max(initial=0.0)))
        return seen.metres(self._share) / next_round(self._largest) if 0.0 < self._largest < math.inf else 0.0
