"""Session: a world run to its end under observation, and the summary of it."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.ecs import RigidBody
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.particle import Particle
from carom.systems.detection.answered import Answered
from carom.systems.energy import total_energy
from carom.systems.observer import Observer, observed
from carom.systems.simulation import Simulation
from carom.tools.interrupt import deferred_interrupt
from carom.tools.witness import Witness
from carom.worlds.builder import LoadedWorld
from carom.worlds.expectation import Outcome

if TYPE_CHECKING:
    from carom.tools.opening import Opening


@dataclass
class Watch:
    """The observer behind the summary: the deepest overlap so far (m)."""

    deepest: float = 0.0

    def begin(self, simulation: Simulation) -> None:
        """See the world before its first step."""

    def observe(self, simulation: Simulation) -> None:
        """Keep the deepest overlap."""
        contact = simulation.world[Contact]
        if contact.count:
            self.deepest = max(self.deepest, float(np.max(contact.depth[: contact.count])))

    def end(self, simulation: Simulation) -> None:
        """Have nothing to finish."""


@dataclass
class Summary:
    """What a run was: counts, seconds, energies in J, the deepest overlap in m, expectations."""

    world: str
    frames: int = 0
    bodies: int = 0
    simulated_seconds: float = 0.0
    real_seconds: float = 0.0
    energy_before: float = 0.0
    energy_after: float = 0.0
    deepest_overlap: float = 0.0
    pairs_by_fcl: int = 0
    pairs_by_kernels: int = 0
    points_refused: int = 0
    impacts_cut: int = 0
    looks_cut: int = 0
    particles: int = 0  # at the end
    expectations: int = 0
    judged: bool = True
    failures: list[Outcome] = field(default_factory=list)
    outputs: dict[str, str] = field(default_factory=dict)

    def text(self, opening: Opening | None = None) -> str:
        """Return the summary for people, with the commands that open what failed."""
        speed = f"{self.simulated_seconds / self.real_seconds:.1f} x real time" if self.real_seconds else "no time"
        particles = f", {self.particles} particles" if self.particles else ""
        held = f"{self.expectations - len(self.failures)} of {self.expectations} held"
        lines = [
            f"{self.world}: {self.frames} frames, {self.bodies} bodies{particles}",
            f"  time          {self.simulated_seconds:.2f} s simulated in {self.real_seconds:.2f} s, {speed}",
            f"  energy        {self.energy_before:.6g} J before, {self.energy_after:.6g} J after",
            f"  overlap       {1e3 * self.deepest_overlap:.3g} mm at the deepest",
            f"  pairs         {self.pairs_by_fcl} answered by FCL, {self.pairs_by_kernels} by kernels",
            f"  expectations  {held if self.judged else 'not asked of this run'}",
            *(f"    {line}" for failed in self.failures for line in (opening.lines(failed) if opening else [failed])),
        ]
        if self.points_refused:
            lines.append(
                f"  warning       {self.points_refused} contact points were impossible and left out; "
                "--check names their pair"
            )
        if self.impacts_cut:
            lines.append(
                f"  warning       {self.impacts_cut} impacts beyond the limit of a step were put off to the next"
            )
        if self.looks_cut:
            lines.append(
                f"  warning       {self.looks_cut} times somebody fast was no longer looked after and may have passed "
                "through a wall; a smaller dt helps"
            )
        lines += [f"  {kind:<13} {path}" for kind, path in self.outputs.items()]
        if "recording" in self.outputs:
            lines.append(f"open it with: carom view {self.outputs['recording']}")
        return "\n".join(lines)


def run(
    loaded: LoadedWorld, observers: Sequence[Observer] = (), *, frames: int | None = None, judged: bool = True
) -> Summary:
    """Run a world to its end, or for ``frames`` steps, with a progress bar when stderr is a terminal.

    Observers are begun in order, and all ended in whatever way the run ends; Ctrl-C ends it between two steps. What the
    world expects is judged only of a whole run, and not where it is not to be ``judged``.
    """
    with np.errstate(all="ignore"):  # the step itself finds what is not finite, and says where
        return _run(loaded, observers, frames, judged and frames is None)


def _run(loaded: LoadedWorld, observers: Sequence[Observer], frames: int | None, judged: bool) -> Summary:
    simulation = loaded.simulation
    watch = Watch()
    summary = Summary(loaded.name or loaded.path, bodies=simulation.world.count(RigidBody), judged=judged)
    summary.energy_before = total_energy(simulation.world)
    expectations = loaded.expectations if summary.judged else []
    simulation.watched = True
    everyone: list[Observer] = [watch, Witness(loaded), *expectations, *observers]
    start = perf_counter()
    planned = loaded.run.frames if frames is None else frames
    with deferred_interrupt() as check, progress_bar(planned) as bar, observed(simulation, *everyone):
        while not (loaded.run.finished(simulation) if frames is None else simulation.frame >= frames):
            simulation.step()
            bar.update()
            check()
    summary.frames, summary.simulated_seconds = simulation.frame, simulation.time
    summary.real_seconds = perf_counter() - start
    summary.energy_after = total_energy(simulation.world)
    summary.deepest_overlap = watch.deepest
    answered = simulation.world[Answered]
    summary.pairs_by_fcl, summary.pairs_by_kernels = answered.fcl, answered.kernels
    summary.points_refused = answered.refused
    summary.impacts_cut, summary.looks_cut = answered.impacts_cut, answered.looks_cut
    summary.particles = simulation.world.count(Particle)
    summary.expectations = len(expectations)
    summary.failures = [outcome for item in expectations if not (outcome := item.outcome()).held]
    return summary


def progress_bar(total: int, unit: str = "frame") -> Any:
    """Return a bar for as many steps, or others of a kind, a context, which is drawn when stderr is a terminal."""
    from tqdm import tqdm

    return tqdm(total=total, unit=unit, leave=False, disable=not sys.stderr.isatty())
