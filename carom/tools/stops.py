"""Stops: where a run was stopped by a breakpoint, in words, and a prompt on its world."""

from __future__ import annotations

from code import InteractiveConsole
from collections.abc import Iterable
from typing import Any

import numpy as np

from carom.ecs import Motion, NonFiniteError, Transform, World
from carom.ecs.relations.contact import Contact
from carom.systems.breakpoints import StoppedError, tried
from carom.systems.compound import bodies_of
from carom.systems.ring import Ring
from carom.systems.simulation import Simulation
from carom.systems.touching import touching_rows
from carom.tools.opening import place_of
from carom.worlds.builder import LoadedWorld

MOST = 4  # of those who touch one, in a line
BANNER = """{told}
simulation, world, stopped and ring are here. rewind(10) goes back by frames, step() forward up to a breakpoint, go_on()
takes the step that broke and those after it, with tried(simulation): shows what that step does. Ctrl-D ends."""


def whereabouts(world: World, entity: int) -> str:
    """Return where somebody is, how it moves and whom it touches."""
    row = world.row(entity)
    told = [f"at {_vector(world[Transform].position[row])} m"] if world.table(Transform).present[row] else []
    if world.table(Motion).present[row]:
        told.append(f"moving at {_vector(world[Motion].linear[row])} m/s")
    contact, bodies = world[Contact], bodies_of(world)
    own = bodies[row] if bodies[row] >= 0 else row
    rows = touching_rows(contact)
    pairs = np.stack([contact.row_a[rows], contact.row_b[rows]], axis=1)
    owners = np.where(bodies[pairs] >= 0, bodies[pairs], pairs)
    others = np.unique(np.concatenate([pairs[owners[:, 0] == own, 1], pairs[owners[:, 1] == own, 0]]))
    names = world.names_told(world.entities(others))
    if names:
        told.append(f"touching {', '.join(names[:MOST])}" + (f" and {len(names) - MOST} more" if names[MOST:] else ""))
    return ", ".join(told)


def text(stopped: StoppedError, loaded: LoadedWorld, command: str) -> str:
    """Return what is told of a break: condition, frame, who, in which file, where, and the command that opens it."""
    world = loaded.simulation.world
    lines = [str(stopped)]
    with tried(loaded.simulation):
        lines += [
            f"  {place_of(loaded, name)}: '{name}' {whereabouts(world, entity)}".rstrip()
            for name, entity in zip(stopped.names, stopped.met.entities, strict=True)
            if entity in world
        ]
    return "\n".join([*lines, f"open it with: {command}"])


class Prompt:
    """A Python prompt on the world that a breakpoint or a NaN stopped; ``ring`` goes back in time."""

    def __init__(self, simulation: Simulation, stopped: StoppedError | NonFiniteError, ring: Ring) -> None:
        self._simulation, self._ring, self._broken = simulation, ring, stopped
        simulation.observers = [ring]

    def rewind(self, frames: int) -> None:
        """Go back by a number of frames; raise SnapshotError for more than the ring goes back."""
        self._ring.rewind(self._simulation, frames)

    def step(self, count: int = 1) -> None:
        """Take steps, up to one that meets a breakpoint."""
        try:
            self._simulation.step(count)
        except (StoppedError, NonFiniteError) as stopped:
            print(stopped)

    def go_on(self, count: int = 1) -> None:
        """Take steps, the first of them whatever it meets."""
        breakpoints, self._simulation.breakpoints = self._simulation.breakpoints, []
        try:
            self._simulation.step()
        finally:
            self._simulation.breakpoints = breakpoints
        self.step(count - 1)

    def open(self, told: str) -> None:
        """Read lines of Python until their end."""
        names: dict[str, Any] = {name: getattr(self, name) for name in ("rewind", "step", "go_on")}
        names |= {"simulation": self._simulation, "world": self._simulation.world, "tried": tried}
        names |= {"stopped": self._broken, "ring": self._ring}
        with np.errstate(all="ignore"):  # as in the run: the step itself finds what is not finite
            InteractiveConsole(names).interact(BANNER.format(told=told), exitmsg="")


def _vector(values: Iterable[float]) -> str:
    return f"[{', '.join(f'{value:.6g}' for value in values)}]"
