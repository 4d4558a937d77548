"""Yielding: how soft contacts are, and how often they are swept, by how long a substep is."""

from __future__ import annotations

from math import pi

from carom.systems.constants import (
    CONTACT_DAMPING,
    CONTACT_PERIODS,
    LOADED,
    LOADED_RIGID,
    LOADED_RIGID_YIELD,
    LOADED_YIELD,
    RELAX_SWEEPS,
    RIGID_RATE,
    STEP_SWEEPS,
)

Yielding = tuple[float, float, float, float]
HARD: Yielding = (0.0, 1.0, 0.0, 0.0)  # does not yield, and no overlap leaves


def yielding(h: float) -> tuple[Yielding, Yielding]:
    """Return how contacts of two moving bodies, and of one, yield in a substep of h seconds.

    Each is (rate at which overlap leaves, in 1/s, part of the mass and of the impulse that stays; how fast, in m/s, the
    impulse of a point that is loaded parts the mass there, and which part of it goes beyond that): Catto, Soft
    Constraints, GDC 2011. A spring is as stiff as substeps can follow: finer ones make contacts stiffer.
    """
    circle = 2.0 * pi * (CONTACT_PERIODS / h)
    one = 2.0 * CONTACT_DAMPING + h * circle
    two = h * circle * one
    soft = circle / one, two / (1.0 + two), LOADED * h, LOADED_YIELD
    return soft, (RIGID_RATE / h, 1.0, LOADED_RIGID * h, LOADED_RIGID_YIELD)


def relax_sweeps(substeps: int) -> int:
    """Return how many sweeps come after the drift of each of so many substeps: in coarse ones more."""
    return max(RELAX_SWEEPS, STEP_SWEEPS // substeps)
