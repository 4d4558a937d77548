"""Thousands of poses of two shapes at once, as FCL's path measures them."""

from __future__ import annotations

import numpy as np
from batches import Answer, Batch

from carom.ecs import ColliderPose
from carom.systems.detection.fcl_pairs import measure_by_fcl
from carom.systems.detection.narrow import Points
from carom.systems.kernels.reduction import MOST_POINTS
from carom.systems.shapes import Shape
from carom.systems.simulation import Simulation


def fcl_batch(a: Shape, b: Shape, batch: Batch, reach: float, *, swapped: bool = False) -> Answer:
    """Return FCL's guarded answers, from the first to the second or the other way round."""
    n = len(batch.position_b)
    simulation = Simulation(checked=False)
    for shape in (a, b):
        body = None if shape.static else {"mass": 1.0}
        simulation.add_many(np.zeros((n, 3)), collider={"shape": shape}, body=body, visual=False)
    with simulation.world.edit(ColliderPose) as pose:
        pose.position[:n], pose.rotation[:n] = 0.0, batch.rotation_a
        pose.position[n : 2 * n], pose.rotation[n : 2 * n] = batch.position_b, batch.rotation_b
    pairs = np.stack([np.arange(n), np.arange(n, 2 * n)], axis=1)
    points = Points(n, MOST_POINTS * n)
    with simulation.world.faces(None):
        taken = measure_by_fcl(
            simulation.world, np.arange(n), pairs[:, ::-1].copy() if swapped else pairs, np.full(n, reach), points
        )
    return Answer(
        points.start, points.count,
        points.feature[:taken], points.normal[:taken], points.depth[:taken], points.point[:taken],
    )  # fmt: skip
