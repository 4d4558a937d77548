"""Worlds of one collider and rays at it."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial.vector import normalise
from carom.systems.queries.rays import Hits
from carom.systems.simulation import Simulation

EXACT = 1e-9  # m


def alone(collider: dict[str, Any], **pose: Any) -> Simulation:
    """Return one collider."""
    simulation = Simulation()
    simulation.add(name="one", collider=collider, transform=pose, visual=False)
    return simulation


def rays_at(seed: int, count: int, far: float = 3.0) -> tuple[Floats, Floats]:
    """Return origins so far from the origin, and directions that pass near it."""
    generator = np.random.default_rng(seed)
    origin = far * normalise(generator.normal(size=(count, 3)))
    return origin, normalise(generator.uniform(-0.6, 0.6, (count, 3)) - origin)


def finite(hits: Hits) -> bool:
    """Tell whether nothing in hits is a NaN, and only the distance of no hit is infinite."""
    numbers = hits.point, hits.normal, np.where(hits.hit, hits.distance, 0.0)
    return all(bool(np.isfinite(column).all()) for column in numbers)
