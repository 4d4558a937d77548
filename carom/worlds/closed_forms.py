"""Closed forms: where bodies are after any time, by formulas of mechanics; for who looks on, never for the step."""

from __future__ import annotations

import math

import numpy as np

from carom.ecs.column import Floats

MOST_STEPS = 100
ROUNDING = 1e-15
NEARLY_PARABOLIC = 1e-3  # of a squared angle: below, series are nearer than quotients of small differences


def ballistic(position: Floats, velocity: Floats, acceleration: Floats, time: float) -> Floats:
    """Return x + v t + a t^2 / 2 (m)."""
    return np.asarray(position + velocity * time + 0.5 * acceleration * time**2)


def kepler(strength: float, position: Floats, velocity: Floats, time: float) -> Floats:
    """Return where a body is (m) that began at ``position`` from a centre which pulls it by G M / r^2.

    ``strength`` is G M in m3/s2. Ellipses, parabolas and hyperbolas alike, by universal variables: R. Bate, D. Mueller
    and J. White, Fundamentals of Astrodynamics, 1971, section 4.4.
    """
    root, distance = math.sqrt(strength), float(np.linalg.norm(position))
    inverse = 2.0 / distance - float(velocity @ velocity) / strength  # of the semi-major axis, 0 of a parabola
    if inverse > 0.0:
        time = math.remainder(time, 2.0 * math.pi / (root * inverse**1.5))
    if time < 0.0:  # back in time is forth with the velocity turned round
        time, velocity = -time, -velocity
    along = float(position @ velocity) / root

    def late(x: float) -> tuple[float, float]:
        """Return by how much x comes too late, times the root, and the distance there, which is its slope."""
        c, s = stumpff(inverse * x * x)
        rest = 1.0 - inverse * distance
        when = along * x * x * c + rest * x**3 * s + distance * x
        return when - root * time, along * x * (1.0 - inverse * x * x * s) + rest * x * x * c + distance

    low, high = 0.0, math.sqrt(distance)
    while late(high)[0] < 0.0:
        low, high = high, 2.0 * high
    x = 0.5 * (low + high)
    for _ in range(MOST_STEPS):  # Newton's, halving where they would leave what is known to hold it
        value, slope = late(x)
        low, high = (low, x) if value > 0.0 else (x, high)
        nearer = x - value / slope
        nearer = nearer if low <= nearer <= high else 0.5 * (low + high)
        if abs(nearer - x) <= ROUNDING * x:
            break
        x = nearer
    c, s = stumpff(inverse * x * x)
    return np.asarray((1.0 - x * x * c / distance) * position + (time - x**3 * s / root) * velocity)


def stumpff(z: float) -> tuple[float, float]:
    """Return Stumpff's functions C = (1 - cos sqrt z) / z and S = (sqrt z - sin sqrt z) / sqrt z^3, also below 0."""
    if abs(z) < NEARLY_PARABOLIC:
        return (
            1.0 / 2 - z / 24 + z**2 / 720 - z**3 / 40320 + z**4 / 3628800,
            1.0 / 6 - z / 120 + z**2 / 5040 - z**3 / 362880 + z**4 / 39916800,
        )
    y = math.sqrt(abs(z))
    if z > 0.0:
        return (1.0 - math.cos(y)) / z, (y - math.sin(y)) / y**3
    return (1.0 - math.cosh(y)) / z, (math.sinh(y) - y) / y**3
