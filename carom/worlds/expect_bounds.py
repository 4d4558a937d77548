"""Expectations of where bodies are, with all of their shapes."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs import Collider, RigidBody, Transform, World
from carom.ecs.column import Integers
from carom.systems.compound import bodies_of
from carom.systems.simulation import Simulation
from carom.worlds.errors import WordError
from carom.worlds.expect_course import among
from carom.worlds.expectation import Expectation
from carom.worlds.measuring import boxes

AXES = ("x", "y", "z")


class Bounds(Expectation):
    """``bounds`` of bodies: the boxes around their colliders lie between these places, at the start and ever after."""

    def __init__(self, words: Any, world: World) -> None:
        stated = {axis: getattr(words, axis) for axis in AXES if getattr(words, axis) is not None}
        if not stated:
            raise WordError("must state one axis at least", received="none", accepted="x, y, z")
        for axis, (low, high) in stated.items():
            if not low < high:
                raise WordError(f"{axis} must go from low to high", received=f"[{low:g}, {high:g}]")
        self.low = np.array([stated.get(axis, (-np.inf,))[0] for axis in AXES])
        self.high = np.array([stated.get(axis, (np.inf,))[-1] for axis in AXES])
        self.among = among(words.entities, world)
        text = ", ".join(f"{axis} in [{low:g}, {high:g}] m" for axis, (low, high) in stated.items())
        super().__init__(f"bounds: {text}", text)
        self.least = np.inf

    def begin(self, simulation: Simulation) -> None:
        """See the world before its first step."""
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Look at the collider that is farthest out."""
        world = simulation.world
        rows, owners = self._colliders(world)
        if not len(rows):
            return
        low, high = boxes(world, rows)
        room = np.concatenate([low - self.low, self.high - high], axis=1)
        index, side = np.unravel_index(int(np.argmin(room)), room.shape)
        axis, place = AXES[side % 3], float((low if side < 3 else high)[index, side % 3])
        owner = world.name(world.entity(int(owners[index])))
        received = f"{owner} reaches {axis} = {place:.6g} m"
        if room[index, side] < self.least:
            self.least, self.worst = float(room[index, side]), received
        if not room[index, side] >= 0.0:
            self.fail(simulation, received, [owner])

    def end(self, simulation: Simulation) -> None:
        """Fail where nobody came of whom it speaks."""
        if self.among is not None and not self.among.known:
            self.fail(simulation, f"never asked, since {self.among.absence(simulation.world)}")

    def _colliders(self, world: World) -> tuple[Integers, Integers]:
        """Return the colliders (rows) of whom it speaks, by default of all bodies, each with the body it belongs to."""
        rows, body = world.row_numbers(Collider, Transform), bodies_of(world)
        owners = np.where(body[rows] < 0, rows, body[rows])
        if self.among is None:
            spoken = world.table(RigidBody).present[owners]
        else:
            meant = self.among.rows(world)
            spoken = np.isin(owners, meant) | np.isin(rows, meant)
        return rows[spoken], owners[spoken]
