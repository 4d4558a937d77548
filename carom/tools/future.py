"""Future: one of several runs of a world, a ghost of its own colour in what shows the first."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from carom.ecs import Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.errors import NonFiniteError
from carom.systems.bodies import dynamic_rows
from carom.systems.energy import total_energy
from carom.systems.interpolation import EarlierPoses
from carom.systems.simulation import Simulation
from carom.tools.coloring import FEW
from carom.tools.ghosts import Ghost, owners
from carom.tools.moments import ROUNDING as SAME_TIME

MOST_PATHS = 100  # bodies: of more nobody could tell the paths apart, and only where they are now is kept


class Parting(NamedTuple):
    """Where a future is first elsewhere than the one that is shown: who is farthest then, by how much (m).

    ``metres`` is None of a body that lives in one of both only: in the future, if ``lives``, or else in the one shown.
    """

    frame: int
    time: float
    entity: str
    metres: float | None
    lives: bool = True

    def __str__(self) -> str:
        by = "lives only there" if self.lives else "does not live there"
        by = by if self.metres is None else f"by {self.metres:.3g} m"
        return f"frame {self.frame} at {self.time:.6g} s: '{self.entity}' {by}"


class Future(Ghost):
    """One of several runs; the first of them is the one that is shown, and casts no ghost but its path."""

    def __init__(self, name: str, number: int, simulation: Simulation) -> None:
        self.name, self.simulation, self.first = name, simulation, number == 0
        red, green, blue = FEW[number % len(FEW)].tolist()
        self.color = red, green, blue
        self.energy_before = total_energy(simulation.world)
        self.ended: NonFiniteError | None = None
        self.parting: Parting | None = None
        self._earlier = EarlierPoses()
        self._path: list[Floats] = []

    def follow(self, shown: World, time: float, before: Callable[[Simulation], object] | None = None) -> None:
        """Take the steps that lead to a time (s), and note where bodies are then; one that explodes stays behind."""
        simulation = self.simulation
        while not self.first and self.ended is None and simulation.time < time - SAME_TIME:
            self._earlier.keep(simulation.world)
            if before is not None:
                before(simulation)
            try:
                simulation.step()
            except NonFiniteError as fault:
                self.ended = fault
        bodies, poses = dynamic_rows(shown), self.poses(shown, shown[Transform], time)
        self._path = self._path if len(bodies) <= MOST_PATHS else []
        self._path.append(poses.position[bodies])
        if self.parting is None and self.ended is None:
            self._look(shown, bodies, poses, time)

    def _look(self, shown: World, bodies: Integers, poses: Transform, time: float) -> None:
        """Note where any body is elsewhere, or turned otherwise, for the first time."""
        here, other = shown[Transform], self.simulation.world
        handles, theirs = shown.entities(bodies), other.entities(dynamic_rows(other))
        for world, alone, lives in (
            (shown, handles[~other.slots.live(handles)], False),
            (other, theirs[~shown.slots.live(theirs)], True),
        ):
            if len(alone):
                self.parting = Parting(shown.frame, time, world.name(int(alone[0])), None, lives)
                return
        moved, turned = poses.position[bodies] != here.position[bodies], poses.rotation[bodies] != here.rotation[bodies]
        apart = moved.any(axis=1) | turned.any(axis=1)
        if apart.any():
            away = np.linalg.norm(poses.position[bodies] - here.position[bodies], axis=1)
            worst = int(np.where(apart, away, -1.0).argmax())
            name = shown.name(shown.entity(int(bodies[worst])))
            self.parting = Parting(shown.frame, time, name, float(away[worst]))

    def rows(self, world: World) -> Integers:
        """Return the bodies that obey forces, and what belongs to them."""
        moving = np.isin(owners(world), dynamic_rows(world))
        return np.nonzero(moving & (not self.first))[0]

    def poses(self, world: World, shown: Transform, time: float) -> Transform:
        """Return the poses of this run, by the rows of the world that is drawn; who is not here is nowhere."""
        poses = Transform()
        poses.position, poses.rotation = np.full((world.used(), 3), np.nan), shown.rotation[: world.used()].copy()
        if self.ended is None:
            own, other = self._then(time), self.simulation.world
            handles = world.handles()
            here = np.nonzero(world.table(Transform).present[: world.used()] & other.slots.live(handles))[0]
            there = other.slots.rows(handles[here])
            poses.position[here], poses.rotation[here] = own.position[there], own.rotation[there]
        return poses

    def places(self, world: World, time: float) -> Floats:
        """Return where all rows of the world that is drawn are in this run (n, 3), m."""
        return self.poses(world, world[Transform], time).position

    def path(self, since: int = 0) -> Floats:
        """Return where the bodies that obey forces have been, from a time on."""
        return np.array(self._path[since:])

    def _then(self, time: float) -> Transform:
        simulation = self.simulation
        before = simulation.time - simulation.settings.dt
        if self.first or not before < time < simulation.time - SAME_TIME:
            return simulation.world[Transform]
        return self._earlier.between(simulation.world, (time - before) / simulation.settings.dt)
