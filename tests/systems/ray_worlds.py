"""Worlds of one collider and rays at it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from solids import first_within

from carom.ecs.column import Booleans, Floats
from carom.ecs.spatial import quaternion
from carom.ecs.spatial.vector import normalise
from carom.systems.queries.rays import Hits
from carom.systems.simulation import Simulation

EXACT = 1e-9  # m
GRAZING = 0.01  # m. A line is clear of or in a solid by more than that, or left out
PLACE, TURN = np.array([0.3, -0.2, 0.1]), quaternion.normalise(np.array([0.3, -0.5, 0.2, 0.7]))


def alone(collider: dict[str, Any], **pose: Any) -> Simulation:
    """Return one collider."""
    simulation = Simulation()
    simulation.add(name="one", collider=collider, transform=pose, visual=False)
    return simulation


def rays_at(seed: int, count: int, far: float = 3.0, spread: float = 0.6) -> tuple[Floats, Floats]:
    """Return origins so far from the origin, and directions that pass it within ``spread`` (m) along each axis."""
    generator = np.random.default_rng(seed)
    origin = far * normalise(generator.normal(size=(count, 3)))
    return origin, normalise(generator.uniform(-spread, spread, (count, 3)) - origin)


def searched(
    outside: Callable[[Floats], Floats], origin: Floats, direction: Floats, skipped: float
) -> tuple[Floats, Booleans]:
    """Return at which distances rays come to a solid at PLACE turned by TURN, and which do not graze or begin in it.

    The search is over 8 m beyond those that are ``skipped``: from afar it would be rounded away.
    """
    back = quaternion.conjugate(TURN)
    begin, along = quaternion.rotate(back, origin + skipped * direction - PLACE), quaternion.rotate(back, direction)
    expected = first_within(outside, begin, along, 8.0) + skipped
    deepest = np.array([outside(begin + s * along) for s in np.linspace(0.0, 8.0, 2001)]).min(axis=0)
    before = np.minimum(outside(begin), outside(quaternion.rotate(back, origin - PLACE)))
    return expected, (np.abs(deepest) > GRAZING) & (before > 0.0)


def finite(hits: Hits) -> bool:
    """Tell whether nothing in hits is a NaN, and only the distance of no hit is infinite."""
    numbers = hits.point, hits.normal, np.where(hits.hit, hits.distance, 0.0)
    return all(bool(np.isfinite(column).all()) for column in numbers)
