"""Particle: a point that flies, one row each."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Relation

Singles = npt.NDArray[np.float32]
PLACE, VELOCITY = ("x", "y", "z"), ("velocity_x", "velocity_y", "velocity_z")


class Particle(Relation):
    """Points that emitters bring forth; those of one emitter are rows in one piece, pieces in order of handles.

    Axes are columns of their own, so that eight particles fill a register. Within a piece rows have no order that
    means anything: the last takes the place of one that dies.
    """

    emitter: Integers = column(unit="1", doc="whose it is", holds="entities")
    number: Integers = column(unit="1", doc="how many its emitter had brought forth before it", dtype="int64")
    dies: Floats = column(unit="s", doc="simulated time at which its life is over")
    life: Singles = column(unit="s", doc="how long it lives", dtype="float32")
    x: Singles = column(unit="m", doc="position along x, world frame", dtype="float32")
    y: Singles = column(unit="m", doc="position along y, world frame", dtype="float32")
    z: Singles = column(unit="m", doc="position along z, world frame", dtype="float32")
    velocity_x: Singles = column(unit="m/s", doc="velocity along x", dtype="float32")
    velocity_y: Singles = column(unit="m/s", doc="velocity along y", dtype="float32")
    velocity_z: Singles = column(unit="m/s", doc="velocity along z", dtype="float32")

    def position(self, rows: slice | Integers) -> Floats:
        """Return where particles are (n, 3), m."""
        return np.stack([getattr(self, name)[rows] for name in PLACE], axis=1, dtype=np.float64)

    def velocity(self, rows: slice | Integers) -> Floats:
        """Return how fast they are (n, 3), m/s."""
        return np.stack([getattr(self, name)[rows] for name in VELOCITY], axis=1, dtype=np.float64)

    def spent(self, rows: slice, time: float) -> Floats:
        """Return which share of their life is over at a simulated time (n,), 0 at birth and 1 at the end."""
        left = (self.dies[rows] - time) / self.life[rows]
        return np.asarray(np.clip(1.0 - left, 0.0, 1.0))
