"""Rehearsal: what most steps need is loaded before the first one, so that no game halts where bodies first meet."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

import numba

from carom.ecs import Motion
from carom.systems.constants import SLEEP_TIME
from carom.systems.detection.leaving import detection_holds
from carom.systems.kernels.stored import NotStoredError, only_stored
from carom.systems.step import STEP

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation

BALL, BOX = {"sphere": {"radius": 0.5}}, {"box": {"size": (1.0, 1.0, 1.0)}}


class Rehearsal:
    """A small world that is stepped once in a process, where that is still ``due``.

    Each kernel takes a millisecond or two to be loaded when it is first called, and some forty are needed where two
    bodies touch: 20 to 50 ms in the middle of a game. What few worlds need is loaded where they do, and nothing is
    compiled before somebody needs it.
    """

    due = not numba.config.DISABLE_JIT

    @classmethod
    def hold(cls, simulation: Simulation) -> None:
        """Let balls and boxes of an empty simulation rest, strike, be too fast for their size, and fall asleep."""
        cls.due = False
        simulation.schedule = STEP  # without what extensions have placed in it, which knows nothing of this
        simulation.add(collider={"box": {"size": (90.0, 1.0, 90.0)}}, transform={"position": (0.0, -0.5, 0.0)})
        for place, speed in enumerate((0.0, -1.0, -90.0)):
            for across, shape in enumerate((BALL, BOX)):
                for above in range(2):
                    simulation.add(
                        collider=shape, body={}, material={"restitution": 0.5 * place},
                        transform={"position": (4.0 * place, 0.5 + above, 4.0 * across)},
                        motion={"linear": (0.1, speed, 0.0)},
                    )  # fmt: skip
        with only_stored(), suppress(NotStoredError):
            simulation.step(3)
            simulation.step(3, after=lambda system: None)  # system by system, as where somebody looks on
            with simulation.world.faces(None):
                detection_holds(simulation.world, 1.0)  # for somebody it does not
            with simulation.world.edit(Motion) as motion:
                motion.still[:] = SLEEP_TIME
            simulation.step(2)  # who rests falls asleep, and others go on
