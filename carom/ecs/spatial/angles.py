"""Trigonometry over arrays from + - * / sqrt alone, so that its last bit is the same on every machine.

``trigonometry`` holds what kernels compile, one number at a time; these are for whole columns.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats
from carom.ecs.spatial.checks import refuse
from carom.ecs.spatial.trigonometry import QUARTER_TURN, QUARTER_TURN_REST, series, sine_cosine

LARGEST_ANGLE = 1e9  # rad; above it the reduced angle holds no digit worth having
PI_REST = 1.2246467991473532e-16  # pi beyond float64

# Arc tangents of 0, 1/8, ..., 1 to twice the digits of float64.
KNOTS = np.array(
    [
        0.0,
        0.12435499454676144,
        0.24497866312686414,
        0.35877067027057225,
        0.4636476090008061,
        0.5585993153435624,
        0.6435011087932844,
        0.7188299996216245,
        0.7853981633974483,
    ]
)
KNOTS_REST = np.array(
    [
        0.0,
        -3.1253241424539383e-18,
        1.0698755618734451e-17,
        -2.4623815582638635e-17,
        2.2698777452961687e-17,
        -5.4556305485916264e-18,
        1.5834785051444286e-17,
        -2.1478388444456983e-17,
        3.061616997868383e-17,
    ]
)


def sines_cosines(angle: npt.ArrayLike) -> tuple[Floats, Floats]:
    """Return sines and cosines of angles (...) in rad, bit for bit those of ``trigonometry.sine_cosine``.

    Accuracy and source are its own: 2 units in the last place below 1e6 rad. An angle beyond 1e9 rad or not finite is
    a GeometryError.
    """
    angle = np.asarray(angle, np.float64)
    refuse(~(np.abs(angle) <= LARGEST_ANGLE), f"an angle is not within {LARGEST_ANGLE:g} rad")
    if angle.ndim == 0:  # a world file's rotations come one by one, and forty ufuncs take longer than plain numbers
        one_sine, one_cosine = sine_cosine(float(angle))
        return np.asarray(one_sine), np.asarray(one_cosine)
    turns = np.floor(angle / QUARTER_TURN + 0.5)
    x = (angle - turns * QUARTER_TURN) - turns * QUARTER_TURN_REST
    s, c = series(x)
    quadrant = turns - 4.0 * np.floor(turns / 4.0)
    odd, half = (quadrant == 1.0) | (quadrant == 3.0), quadrant >= 2.0
    sine, cosine = np.where(odd, c, s), np.where(odd, -s, c)
    return np.where(half, -sine, sine), np.where(half, -cosine, cosine)


def arc_tangent(y: npt.ArrayLike, x: npt.ArrayLike = 1.0) -> Floats:
    """Return the angles (...) in rad, within -pi..pi, from the direction +x to the points (x, y); 0 where both are 0.

    Within 3 units in the last place. The smaller over the larger coordinate is t in [0, 1]; with the knot c = k/8 next
    to it, arctan t = arctan c + arctan((t - c) / (1 + t c)) (Abramowitz and Stegun, Handbook of Mathematical Functions,
    1964, 4.4.34), and the last by its Taylor series (4.4.42) to the term below 1e-19. A coordinate that is not finite
    is a GeometryError.
    """
    y, x = np.asarray(y, np.float64), np.asarray(x, np.float64)
    refuse(~(np.isfinite(y) & np.isfinite(x)), "an arc tangent is asked of a number that is not finite")
    tall, wide = np.abs(y), np.abs(x)
    larger = np.maximum(tall, wide)
    t = np.minimum(tall, wide) / np.where(larger == 0.0, 1.0, larger)
    k = np.floor(8.0 * t + 0.5)
    r = (t - k / 8.0) / (1.0 + t * (k / 8.0))
    z = r * r
    series = 1.0 / 11.0 - z * (1.0 / 13.0 - z / 15.0)
    series = 1.0 / 3.0 - z * (1.0 / 5.0 - z * (1.0 / 7.0 - z * (1.0 / 9.0 - z * series)))
    knot = k.astype(np.int64)
    angle = KNOTS[knot] + (r + (KNOTS_REST[knot] - r * z * series))
    angle = np.where(tall > wide, 0.5 * math.pi - (angle - 0.5 * PI_REST), angle)
    angle = np.where(x < 0.0, math.pi - (angle - PI_REST), angle)
    signed: Floats = np.copysign(angle, y)
    return signed


def arc_sine(x: npt.ArrayLike) -> Floats:
    """Return the angles (...) in rad, within -pi/2..pi/2, whose sines are x, within 3 units in the last place.

    An x beyond -1..1 is a GeometryError, as rounding that leads there should be cut off where it is understood.
    """
    x = _fraction(x, "sine")
    return arc_tangent(x, np.sqrt((1.0 - x) * (1.0 + x)))


def arc_cosine(x: npt.ArrayLike) -> Floats:
    """Return the angles (...) in rad, within 0..pi, whose cosines are x, within 3 units in the last place.

    An x beyond -1..1 is a GeometryError. The angle between two vectors is better had from ``vector.angle``: next to
    x = 1 a cosine knows its angle to half of the digits only.
    """
    x = _fraction(x, "cosine")
    return arc_tangent(np.sqrt((1.0 - x) * (1.0 + x)), x)


def _fraction(x: npt.ArrayLike, what: str) -> Floats:
    x = np.asarray(x, np.float64)
    refuse(~(np.abs(x) <= 1.0), f"a {what} is not within -1..1")
    return x
