"""Futures: runs of one world side by side, and what became of each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from carom.ecs import Transform
from carom.systems.bodies import dynamic_rows
from carom.systems.energy import total_energy
from carom.systems.simulation import Simulation
from carom.tools.future import Future
from carom.tools.ghosts import Ghosts
from carom.worlds.oracle import Oracle, errors

ROUNDING = 1e-12  # of an energy: a smaller change is none


@dataclass(frozen=True)
class Outcome:
    """What became of a future: its energies (J), how far who is from the first (m), and from the oracle."""

    name: str
    energy_before: float
    energy_after: float
    difference: float
    whose: str
    error: float | None


class Futures:
    """The observer that lets further futures follow the first; it comes before all who look at them.

    ``before`` is done to each of these before each of its steps.
    """

    def __init__(
        self, named: Sequence[tuple[str, Simulation]], before: Callable[[Simulation], object] | None = None
    ) -> None:
        self._before = before
        self.futures = [Future(name, number, simulation) for number, (name, simulation) in enumerate(named)]
        self.futures[0].simulation.world.add(Ghosts(self.futures))

    def begin(self, simulation: Simulation) -> None:
        """Note the start."""
        self.observe(simulation)

    def observe(self, simulation: Simulation) -> None:
        """Let the others come as far."""
        for future in self.futures:
            future.follow(simulation.world, simulation.time, self._before)

    def end(self, simulation: Simulation) -> None:
        """Have nothing to finish."""

    def outcomes(self) -> list[Outcome]:
        """Return what became of each, the first against itself."""
        return [self._outcome(future) for future in self.futures]

    def text(self) -> str:
        """Return a table for people."""
        first = self.futures[0].name
        rows = [("future", "energy", "since the start", f"farthest from {first}", "from the oracle")]
        for future, outcome in zip(self.futures, self.outcomes(), strict=True):
            if future.ended is not None:
                rows.append((future.name, str(future.ended).split(";")[0], "", "", ""))
                continue
            change = outcome.energy_after - outcome.energy_before
            change = 0.0 if abs(change) < ROUNDING * abs(outcome.energy_after) else change
            far = f"{outcome.difference:.4g} m, {outcome.whose}" if outcome.whose else "-"
            off = "" if outcome.error is None else f"{outcome.error:.4g} m"
            rows.append((future.name, f"{outcome.energy_after:.6g} J", f"{change:+.3g} J", far, off))
        kept = [column for column in range(5) if any(row[column] for row in rows[1:])]
        widths = [max(len(row[column]) for row in rows if row[2] or row is rows[0]) for column in range(5)]
        return "\n".join("  ".join(row[column].ljust(widths[column]) for column in kept).rstrip() for row in rows)

    def _outcome(self, future: Future) -> Outcome:
        shown, world = self.futures[0].simulation, future.simulation.world
        rows = dynamic_rows(shown.world)
        away = np.linalg.norm(
            future.places(shown.world, shown.time)[rows] - shown.world[Transform].position[rows], axis=1
        )
        apart = not future.first and future.ended is None and len(rows) > 0
        worst = int(np.nanargmax(away)) if apart and np.isfinite(away).any() else -1
        foretold = world[Oracle].rows(world) if Oracle in world else np.zeros(0, np.int64)
        return Outcome(
            future.name,
            future.energy_before,
            total_energy(world),
            float(away[worst]) if worst >= 0 else 0.0,
            shown.world.name(shown.world.entity(int(rows[worst]))) if worst >= 0 else "",
            float(errors(world, foretold).max()) if len(foretold) else None,
        )
