"""Rehearsal: what most steps need is loaded before the first one, so that no game halts where bodies first meet."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

import numba
import numpy as np

from carom.ecs import Collider, Motion
from carom.ecs.components.flight import Flight
from carom.systems.constants import SLEEP_TIME
from carom.systems.detection.apart import Apart
from carom.systems.detection.leaving import detection_holds
from carom.systems.detection.narrow import Found
from carom.systems.detection.recycling import find_balls
from carom.systems.grouping import group_contacts
from carom.systems.kernels.stored import NotStoredError, only_stored
from carom.systems.kernels.swinging import NUMBERS
from carom.systems.passing import seeming, without_seeming
from carom.systems.step import STEP

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation

BALL, BOX, HALF = {"sphere": {"radius": 0.5}}, {"box": {"size": (1.0, 1.0, 1.0)}}, {"box": {"size": (0.5, 1.0, 1.0)}}


class Rehearsal:
    """A small world that is stepped once in a process, where that is still ``due``.

    Each kernel takes a millisecond or two to be loaded when it is first called, and some forty are needed where two
    bodies touch: 20 to 50 ms in the middle of a game. What few worlds need is loaded where they do, and nothing is
    compiled before somebody needs it.
    """

    due = not numba.config.DISABLE_JIT

    @classmethod
    def hold(cls, simulation: Simulation) -> None:
        """Let balls and boxes of an empty simulation rest, strike, be too fast for their size, fall asleep and wake.

        One body has two colliders side by side, two are said to be apart, and some to be many that pass by.
        """
        cls.due = False
        simulation.schedule = STEP  # without what extensions have placed in it, which knows nothing of this
        simulation.add(collider={"box": {"size": (90.0, 1.0, 90.0)}}, transform={"position": (0.0, -0.5, 0.0)})
        for place, speed in enumerate((0.0, -1.0, -90.0)):
            for across, shape in enumerate((BALL, BOX)):
                for above in range(2):
                    simulation.add(
                        collider=shape, body={}, material={"restitution": 0.5 * place},
                        transform={"position": (4.0 * place, 0.5 + above + 0.1 * place, 4.0 * across)},
                        motion={"linear": (0.1, speed, 0.0), "angular": (0.0, 0.0, speed)},
                    )  # fmt: skip
        both = simulation.add(collider=HALF, body={}, transform={"position": (-0.25, 2.5, 4.0)})
        simulation.add(collider=HALF, parent={"entity": both, "position": (0.5, 0.0, 0.0)})
        with only_stored(), suppress(NotStoredError):
            simulation.step(3)
            simulation.step(3, after=lambda system: None)  # system by system, as where somebody looks on
            with simulation.world.faces(None):
                detection_holds(simulation.world, 1.0)  # for somebody it does not
                apart, pair = simulation.world[Apart], simulation.world.row_numbers(Collider)[None, :2]
                none, center = Found.room(0), simulation.world[Flight].center
                find_balls(simulation.world, pair, np.ones(1))
                seeming(simulation.world, none, 1.0, center)
                without_seeming(simulation.world, none, 1.0, center, pair, np.ones((1, NUMBERS)))
                apart.many = True
                apart.note(simulation.world, apart.without(simulation.world, pair, np.ones(1))[0], np.ones(1), 1)
                group_contacts(simulation.world, places=True, same=True)
            for column, value in (("linear", 0.0), ("angular", 0.0), ("still", SLEEP_TIME)):
                with simulation.world.edit(Motion) as motion:
                    getattr(motion, column)[:] = value
                simulation.step()  # at last who rests falls asleep
            simulation.step()
            simulation.wake(both)
            simulation.step()
