"""How long a run takes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import Motion, World
from carom.ecs.column import Floats, Integers
from carom.ecs.errors import DeclarationError
from carom.systems.bodies import dynamic_rows
from carom.systems.compound import reaches
from carom.systems.simulation import Simulation

if TYPE_CHECKING:
    from carom.worlds.sections import Run

DEFAULT_DURATION = 5.0
MOST_FRAMES = 1_000_000_000  # above, nobody sees the end


@dataclass(frozen=True)
class RunPlan:
    """A run ends after ``frames`` steps, or before, once nothing is faster than ``rest_speed`` (m/s)."""

    frames: int
    rest_speed: float | None = None

    def finished(self, simulation: Simulation) -> bool:
        """Tell whether the run is over."""
        resting = self.rest_speed is not None and simulation.frame > 0 and at_rest(simulation, self.rest_speed)
        return simulation.frame >= self.frames or resting


def plan(run: Run | None, dt: float) -> RunPlan:
    """Return the plan of the file's words for steps of ``dt``."""
    if run is None:
        return RunPlan(frames_of(DEFAULT_DURATION, dt))
    if run.frames is not None:
        return RunPlan(run.frames)
    if run.duration is not None:
        return RunPlan(frames_of(run.duration, dt))
    return RunPlan(frames_of(run.at_most, dt), run.rest_speed)


def frames_of(seconds: float, dt: float) -> int:
    """Return how many steps reach ``seconds``, whole ones being whole in spite of rounding.

    Raises DeclarationError for more than a run may have.
    """
    if not seconds / dt <= MOST_FRAMES:
        raise DeclarationError(
            f"{seconds:g} s take more steps of {dt:g} s than a run may have, {MOST_FRAMES:,}; "
            "state a shorter time, or a longer step.dt"
        )
    return math.ceil(seconds / dt * (1.0 - 1e-12) - 1e-9)


def at_rest(simulation: Simulation, speed: float) -> bool:
    """Tell whether no dynamic body moves as fast as ``speed`` (m/s), nor any point of its bounds by its rotation."""
    return bool((speeds(simulation.world, dynamic_rows(simulation.world)) < speed).all())


def speeds(world: World, rows: Integers) -> Floats:
    """Return the speeds (n,) of bodies (rows), m/s: of their centres, or of points of them by rotation if faster."""
    motion = world[Motion]
    turning = np.linalg.norm(motion.angular[rows], axis=1) * reaches(world)[rows]
    return np.asarray(np.maximum(np.linalg.norm(motion.linear[rows], axis=1), turning))
